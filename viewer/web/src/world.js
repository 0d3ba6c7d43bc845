// Renderer, light, ground and cameras. W is ENU: x and y horizontal, z up, metres.
import * as THREE from 'three';
import { OrbitControls } from 'three/addons/controls/OrbitControls.js';
import { palette } from './palette.js';

const FOLLOW_OFFSET = new THREE.Vector3(-6.5, -6.2, 5.2);
const TOP_HEIGHT = 26;

const SLOW_MS = 45;
const FAST_MS = 18;
const FEWEST_PIXELS = 0.4; // of the window's, per axis

/** Whether WebGL draws on the CPU: then it gets no more pixels than it can pay for. */
function isSoftware() {
  const gl = document.createElement('canvas').getContext('webgl2');
  const info = gl?.getExtension('WEBGL_debug_renderer_info');
  const name = info ? gl.getParameter(info.UNMASKED_RENDERER_WEBGL) : '';
  gl?.getExtension('WEBGL_lose_context')?.loseContext();
  return /swiftshader|llvmpipe|software/i.test(name);
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
    this.scene.background = new THREE.Color(palette.back);
    this.scene.fog = new THREE.Fog(palette.back, 28, 85);
    this.camera = new THREE.PerspectiveCamera(46, 1, 0.05, 400);
    this.camera.position.copy(FOLLOW_OFFSET).add(new THREE.Vector3(2.5, 0, 1));
    this.controls = new OrbitControls(this.camera, canvas);
    this.controls.target.set(2.5, 0, 1);
    this.controls.enableDamping = true;
    this.controls.dampingFactor = 0.12;
    this.controls.maxDistance = 150;
    this.followed = null; // where the camera's vehicle was
    this.mode = 'follow';
    this.light();
    this.floor = this.thrifty ? this.lineGround() : this.shadedGround();
    this.floor.renderOrder = -2;
    this.scene.add(this.floor);
    this.resize();
    window.addEventListener('resize', () => this.resize());
  }

  light() {
    this.scene.add(new THREE.HemisphereLight('#bcd6f5', '#1a2028', 1.5));
    const sun = new THREE.DirectionalLight('#fff1de', 2.1);
    sun.position.set(-6, -9, 14);
    const rim = new THREE.DirectionalLight('#5aa7ff', 0.7);
    rim.position.set(8, 10, 4);
    this.scene.add(sun, rim);
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

  resize() {
    this.renderer.setSize(window.innerWidth, window.innerHeight, false);
    this.camera.aspect = window.innerWidth / window.innerHeight;
    this.camera.updateProjectionMatrix();
    this.resized?.(window.innerWidth, window.innerHeight);
  }

  /** 'follow', 'top' (both go with the vehicle) or 'free'. */
  setCamera(mode) {
    this.mode = mode;
    const target = this.controls.target;
    if (this.followed && mode !== 'free') target.copy(this.followed);
    this.controls.maxPolarAngle = mode === 'top' ? 0.02 : Math.PI * 0.495;
    this.controls.enableRotate = mode !== 'top';
    if (mode === 'top') this.camera.position.copy(target).add(new THREE.Vector3(0, -0.01, TOP_HEIGHT));
    if (mode === 'follow') this.camera.position.copy(target).add(FOLLOW_OFFSET);
    this.controls.update();
  }

  /** The vehicle is at p: the camera goes the same way, softly; after a jump, at once. */
  follow(p, seconds) {
    const ahead = new THREE.Vector3(p.x + (this.mode === 'follow' ? 2.2 : 0), p.y, p.z);
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

  render(seconds) {
    this.adapt(seconds);
    this.controls.update();
    const { target } = this.controls;
    this.floor.position.set(Math.round(target.x / 5) * 5, Math.round(target.y / 5) * 5, 0);
    const { x, y } = this.camera.position;
    this.floor.material.uniforms?.eye.value.set((x + target.x) / 2, (y + target.y) / 2);
    this.renderer.render(this.scene, this.camera);
  }
}
