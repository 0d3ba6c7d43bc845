// Renderer, light, ground and cameras. W is ENU: x and y horizontal, z up, metres.
import * as THREE from 'three';
import { OrbitControls } from 'three/addons/controls/OrbitControls.js';
import { palette } from './palette.js';

/** Of the camera from the vehicle that it follows: behind, to the right, above, m. */
const FOLLOW = { behind: 8, right: 6.8, above: 7.4 };
const AHEAD = 3.6; // of the vehicle, what the camera looks at, m
const TOP_HEIGHT = 26;

const SLOW_MS = 45;
const FAST_MS = 18;
const FEWEST_PIXELS = 0.4; // of the window's, per axis

/** What a camera that follows shows around what it looks at, in window heights: the vehicle is within, 0.3 off the middle. */
const SHOWN = { width: 0.72, height: 0.5 };

/** Whether WebGL draws on the CPU: then it gets no more pixels than it can pay for. */
function isSoftware() {
  const gl = document.createElement('canvas').getContext('webgl2');
  const info = gl?.getExtension('WEBGL_debug_renderer_info');
  const name = info ? gl.getParameter(info.UNMASKED_RENDERER_WEBGL) : '';
  gl?.getExtension('WEBGL_lose_context')?.loseContext();
  return /swiftshader|llvmpipe|software/i.test(name);
}

/** A hint of a horizon. */
function sky() {
  const canvas = Object.assign(document.createElement('canvas'), { width: 2, height: 256 });
  const context = canvas.getContext('2d');
  const gradient = context.createLinearGradient(0, 0, 0, 256);
  gradient.addColorStop(0, palette.sky);
  gradient.addColorStop(0.3, '#101b28');
  gradient.addColorStop(0.5, palette.back);
  gradient.addColorStop(1, palette.back);
  context.fillStyle = gradient;
  context.fillRect(0, 0, 2, 256);
  const texture = new THREE.CanvasTexture(canvas);
  texture.colorSpace = THREE.SRGBColorSpace;
  return texture;
}

export class World {
  constructor(canvas) {
    THREE.Object3D.DEFAULT_UP.set(0, 0, 1);
    // ?quality=high: every pixel, whatever it costs (for pictures); low: few (for tests).
    const quality = new URLSearchParams(location.search).get('quality');
    this.thrifty = quality === 'low' || (isSoftware() && quality !== 'high');
    this.renderer = new THREE.WebGLRenderer({ canvas, antialias: !this.thrifty, powerPreference: 'high-performance' });
    this.pixels = quality === 'low' ? FEWEST_PIXELS : this.thrifty ? 0.7 : Math.min(window.devicePixelRatio, 2);
    this.renderer.setPixelRatio(this.pixels);
    this.frameMs = 30;
    this.settle = 0;
    this.scene = new THREE.Scene();
    this.scene.background = sky();
    this.scene.fog = new THREE.Fog(palette.back, 26, 80);
    this.camera = new THREE.PerspectiveCamera(46, 1, 0.05, 400);
    this.controls = new OrbitControls(this.camera, canvas);
    this.controls.target.set(2.5, 0, 1);
    this.controls.enableDamping = true;
    this.controls.dampingFactor = 0.12;
    this.controls.maxDistance = 150;
    this.followed = null; // where the camera's vehicle was
    this.mode = 'follow';
    this.heading = new THREE.Vector3(1, 0, 0); // horizontal, towards the goal
    this.camera.position.copy(this.controls.target).add(this.offset());
    this.light();
    this.floor = this.thrifty ? this.lineGround() : this.shadedGround();
    this.floor.renderOrder = -2;
    this.scene.add(this.floor);
    this.setFree({ left: 0, right: window.innerWidth, top: 0, bottom: window.innerHeight });
  }

  light() {
    const sky = new THREE.HemisphereLight('#cfe2f7', '#2a2f38', 1.75);
    const sun = new THREE.DirectionalLight('#fff1de', 2.3);
    sun.position.set(-7, -8, 12);
    const rim = new THREE.DirectionalLight('#5aa7ff', 0.7);
    rim.position.set(8, 10, 4);
    this.lights = { sky, lamps: [sun, rim] };
    this.scene.add(sky, sun, rim);
  }

  /** What these lights make of a white matt face with that normal: what MeshLambertMaterial would. */
  lightOn(normal) {
    const { sky, lamps } = this.lights;
    const color = new THREE.Color().lerpColors(sky.groundColor, sky.color, 0.5 + 0.5 * normal.z);
    color.multiplyScalar(sky.intensity);
    for (const { color: own, intensity, position } of lamps) {
      const share = Math.max(normal.dot(position) / position.length(), 0);
      color.add(own.clone().multiplyScalar(share * intensity));
    }
    return color.multiplyScalar(1 / Math.PI);
  }

  /** A plane with lines every metre and every five, which fade with distance. */
  shadedGround() {
    const material = new THREE.ShaderMaterial({
      uniforms: {
        base: { value: new THREE.Color(palette.ground) },
        line: { value: new THREE.Color(palette.grid) },
        back: { value: new THREE.Color(palette.back) },
        eye: { value: new THREE.Vector2() },
      },
      vertexShader: `varying vec2 at; void main() {
        vec4 p = modelMatrix * vec4(position, 1.0); at = p.xy; gl_Position = projectionMatrix * viewMatrix * p; }`,
      fragmentShader: `varying vec2 at; uniform vec3 base, line, back; uniform vec2 eye;
        float grid(float step) {
          vec2 q = at / step; vec2 w = fwidth(q); vec2 d = abs(fract(q - 0.5) - 0.5) / max(w, 1e-5);
          return (1.0 - min(min(d.x, d.y), 1.0)) * clamp(0.6 - 1.2 * max(w.x, w.y), 0.0, 1.0);
        }
        void main() {
          float far = smoothstep(10.0, 75.0, distance(at, eye));
          vec3 c = mix(base, line, 0.55 * grid(1.0) + 0.9 * grid(5.0));
          gl_FragColor = vec4(mix(c, back, far), 1.0);
          #include <colorspace_fragment>
        }`,
    });
    return new THREE.Mesh(new THREE.PlaneGeometry(320, 320), material);
  }

  /** The same for a renderer that pays for every pixel: nothing but lines. */
  lineGround() {
    const grid = new THREE.GridHelper(160, 160, palette.grid, '#18222c');
    grid.rotation.x = Math.PI / 2;
    return grid;
  }

  /** The part of the window that no panel covers, CSS pixels: what the camera looks at is in its middle. */
  setFree(area) {
    this.free = area;
    this.resize();
  }

  resize() {
    const { innerWidth: width, innerHeight: height } = window;
    const { left, right, top, bottom } = this.free;
    this.renderer.setSize(width, height, false);
    this.camera.zoom = Math.min(1, (right - left) / (SHOWN.width * height), (bottom - top) / (SHOWN.height * height));
    this.camera.setViewOffset(width, height, (width - left - right) / 2, (height - top - bottom) / 2, width, height);
  }

  /** 'follow', 'top' (both go with the vehicle) or 'free'. */
  setCamera(mode) {
    this.mode = mode;
    const target = this.controls.target;
    if (this.followed && mode !== 'free') target.copy(this.followed);
    this.controls.maxPolarAngle = mode === 'top' ? 0.02 : Math.PI * 0.495;
    this.controls.enableRotate = mode !== 'top';
    if (mode === 'top') this.camera.position.copy(target).add(new THREE.Vector3(0, -0.01, TOP_HEIGHT));
    if (mode === 'follow') this.camera.position.copy(target).add(this.offset());
    this.controls.update();
  }

  offset() {
    const { x, y } = this.heading;
    const { behind, right, above } = FOLLOW;
    return new THREE.Vector3(-behind * x + right * y, -behind * y - right * x, above);
  }

  /** The flight goes that way: a camera that follows looks along it from the start. */
  head(from, to) {
    const heading = new THREE.Vector3(to[0] - from[0], to[1] - from[1], 0);
    if (this.followed || heading.length() < 1) return;
    this.heading.copy(heading.normalize());
    if (this.mode === 'follow') this.camera.position.copy(this.controls.target).add(this.offset());
  }

  /** The vehicle is at p: the camera goes the same way, softly; after a jump, at once. */
  follow(p, seconds) {
    const ahead = p.clone().addScaledVector(this.heading, this.mode === 'follow' ? AHEAD : 0);
    if (!this.followed) this.followed = this.controls.target.clone();
    const gap = ahead.distanceTo(this.followed);
    const share = gap > 12 ? 1 : 1 - Math.exp(-seconds * 7);
    const move = ahead.sub(this.followed).multiplyScalar(share);
    this.followed.add(move);
    if (this.mode === 'free') return;
    this.controls.target.add(move);
    this.camera.position.add(move);
  }

  /** Fewer pixels when frames take long, more when they do not. */
  adapt(seconds) {
    this.frameMs += 0.1 * (Math.min(1e3 * seconds, 200) - this.frameMs);
    if (!this.thrifty || ++this.settle < 25) return;
    this.settle = 0;
    const wanted = this.frameMs > SLOW_MS ? this.pixels * 0.85 : this.frameMs < FAST_MS ? this.pixels * 1.1 : this.pixels;
    const pixels = Math.min(Math.max(wanted, FEWEST_PIXELS), 1);
    if (pixels === this.pixels) return;
    this.pixels = pixels;
    this.renderer.setPixelRatio(pixels);
    this.resize();
  }

  /** The camera is where this frame sees from. */
  aim(seconds) {
    this.adapt(seconds);
    this.controls.update();
  }

  render() {
    const { target } = this.controls;
    this.floor.position.set(Math.round(target.x / 5) * 5, Math.round(target.y / 5) * 5, -0.02); // below what stands on it
    const { x, y } = this.camera.position;
    this.floor.material.uniforms?.eye.value.set((x + target.x) / 2, (y + target.y) / 2);
    this.renderer.render(this.scene, this.camera);
  }
}
