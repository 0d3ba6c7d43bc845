// Renderer, light, ground, and the number of pixels. W is ENU: x and y horizontal, z up, metres.
import * as THREE from 'three';
import { Cameras } from './camera.js';
import { palette } from './palette.js';
import { Quality, Stillness } from './quality.js';

const FOG_BEGIN = 26; // m
const FOG_END = 80; // m: everything beyond is fog
const FOG_NEAR = 20; // m: a camera farther from its target has proportionally thinner fog
const GAMMA = 2.2; // of displays, nearly
const TURNED = 1e-5; // change of a view's matrix between two pictures: less than a hundredth of a pixel
const FEWEST_PIXELS = 0.3; // of the window's, per axis

/** Returns true if WebGL draws on the CPU; the number of pixels is then limited to what it can draw. */
function isSoftware() {
  const gl = document.createElement('canvas').getContext('webgl2');
  const info = gl?.getExtension('WEBGL_debug_renderer_info');
  const name = info ? gl.getParameter(info.UNMASKED_RENDERER_WEBGL) : '';
  gl?.getExtension('WEBGL_lose_context')?.loseContext();
  return /swiftshader|llvmpipe|software/i.test(name);
}

/** A faint horizon. */
function sky() {
  const canvas = Object.assign(document.createElement('canvas'), { width: 2, height: 256 });
  const context = canvas.getContext('2d');
  const gradient = context.createLinearGradient(0, 0, 0, 256);
  gradient.addColorStop(0, palette.sky);
  gradient.addColorStop(0.3, palette.horizon);
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
    // ?quality=high: every pixel at any cost (for pictures); low: few (for tests).
    const asked = new URLSearchParams(location.search).get('quality');
    this.thrifty = asked === 'low' || (asked !== 'high' && isSoftware());
    this.renderer = new THREE.WebGLRenderer({ canvas, antialias: !this.thrifty, powerPreference: 'high-performance' });
    const pixels = asked === 'low' ? 0.4 : this.thrifty ? 0.7 : Math.min(window.devicePixelRatio, 2);
    this.quality = new Quality({ pixels, fewest: FEWEST_PIXELS, most: 1 });
    this.stillness = asked === 'low' || !this.thrifty ? null : new Stillness();
    this.view = new THREE.Matrix4();
    this.renderer.setPixelRatio(pixels);
    this.scene = new THREE.Scene();
    this.light();
    if (this.thrifty) this.countColoursAsSeen();
    this.scene.background = this.thrifty ? new THREE.Color(palette.back) : sky();
    this.fog = new THREE.Fog(palette.back, FOG_BEGIN, FOG_END);
    this.cameras = new Cameras(canvas);
    this.floor = this.thrifty ? this.lineGround() : this.shadedGround();
    this.floor.renderOrder = -2;
    this.scene.add(this.floor);
    this.setFree({ left: 0, right: window.innerWidth, top: 0, bottom: window.innerHeight });
  }

  get camera() {
    return this.cameras.camera;
  }

  get pixels() {
    return this.quality.pixels;
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

  /** Colours are added in display space, which saves two powers of three channels per pixel. */
  countColoursAsSeen() {
    THREE.ColorManagement.enabled = false;
    this.renderer.outputColorSpace = THREE.LinearSRGBColorSpace;
  }

  /** A share of light, in display space. */
  shade(share) {
    return this.thrifty ? share ** (1 / GAMMA) : share;
  }

  /** Returns how many times thinner the fog is than near the ground. */
  thinness() {
    if (this.camera.isOrthographicCamera) return 1;
    return Math.max(this.camera.position.distanceTo(this.cameras.controls.target) / FOG_NEAR, 1);
  }

  /** Returns the distance at which the fog is opaque, m. */
  sight() {
    return this.camera.isOrthographicCamera ? Infinity : FOG_END * this.thinness(); // an orthographic camera is far from everything
  }

  /** Returns the part of an object's colour that the fog leaves, 0 … 1. @param distance  m */
  clear(distance) {
    if (this.camera.isOrthographicCamera) return 1;
    return 1 - THREE.MathUtils.smoothstep(distance / this.thinness(), FOG_BEGIN, FOG_END);
  }

  /** Returns the colour of a white matt face with that normal in this light, as MeshLambertMaterial would. */
  lightOn(normal) {
    const { sky, lamps } = this.lights;
    const color = new THREE.Color().lerpColors(sky.groundColor, sky.color, 0.5 + 0.5 * normal.z);
    color.multiplyScalar(sky.intensity);
    for (const { color: own, intensity, position } of lamps) {
      const share = Math.max(normal.dot(position) / position.length(), 0);
      color.add(own.clone().multiplyScalar(share * intensity));
    }
    return color.setRGB(...color.toArray().map((light) => this.shade(light / Math.PI)));
  }

  /** A ground with lines every metre and every five, which fade with distance. */
  shadedGround() {
    const material = new THREE.ShaderMaterial({
      uniforms: {
        base: { value: new THREE.Color(palette.ground) },
        line: { value: new THREE.Color(palette.grid) },
        back: { value: new THREE.Color(palette.back) },
        eye: { value: new THREE.Vector2() },
        thinness: { value: 1 },
      },
      vertexShader: `varying vec2 at; void main() {
        vec4 p = modelMatrix * vec4(position, 1.0); at = p.xy; gl_Position = projectionMatrix * viewMatrix * p; }`,
      fragmentShader: `varying vec2 at; uniform vec3 base, line, back; uniform vec2 eye; uniform float thinness;
        float grid(float step) {
          vec2 q = at / step; vec2 w = fwidth(q); vec2 d = abs(fract(q - 0.5) - 0.5) / max(w, 1e-5);
          return (1.0 - min(min(d.x, d.y), 1.0)) * clamp(0.6 - 1.2 * max(w.x, w.y), 0.0, 1.0);
        }
        void main() {
          float far = smoothstep(10.0, 75.0, distance(at, eye) / thinness);
          vec3 c = mix(base, line, 0.55 * grid(1.0) + 0.9 * grid(5.0));
          gl_FragColor = vec4(mix(c, back, far), 1.0);
          #include <colorspace_fragment>
        }`,
    });
    return new THREE.Mesh(new THREE.PlaneGeometry(320, 320), material);
  }

  /** The ground of a renderer without a GPU: lines every five metres, and near by every metre. */
  lineGround() {
    const grid = new THREE.GridHelper(160, 32, palette.grid, palette.faint);
    grid.add(new THREE.GridHelper(30, 30, palette.grid, palette.faint));
    grid.rotation.x = Math.PI / 2;
    return grid;
  }

  /** The part of the window that no panel covers, CSS pixels. */
  setFree(area) {
    this.free = area;
    this.resize();
  }

  resize() {
    const { innerWidth: width, innerHeight: height } = window;
    this.renderer.setSize(width, height, false);
    this.cameras.setFree(this.free, width, height);
  }

  /**
   * Reduces pixels when frames take long, raises them when they do not, and uses all of them for a still picture.
   * @param now  ms @param flies  the flight goes on @param news  something else may look different
   * @return true if the picture must be drawn
   */
  adapt(now, flies, news) {
    if (!this.thrifty) return true;
    const due = !this.stillness || this.stillness.isDue(now, this.hasTurned() || flies, news);
    const still = this.stillness?.still ?? false;
    if (still) this.quality.pause();
    else this.quality.frame(now);
    const pixels = still ? this.quality.most : this.pixels;
    if (pixels !== this.renderer.getPixelRatio()) {
      this.renderer.setPixelRatio(pixels);
      this.resize();
    }
    return due;
  }

  /** Returns true if the camera's view has changed since the last call. */
  hasTurned() {
    this.camera.updateMatrixWorld();
    const view = new THREE.Matrix4().multiplyMatrices(this.camera.projectionMatrix, this.camera.matrixWorldInverse);
    const turned = view.elements.some((x, k) => Math.abs(x - this.view.elements[k]) > TURNED);
    this.view = view;
    return turned;
  }

  render() {
    const { target } = this.cameras.controls;
    const isFlat = this.camera.isOrthographicCamera;
    const thinness = this.thinness();
    this.scene.fog = isFlat ? null : Object.assign(this.fog, { near: FOG_BEGIN * thinness, far: FOG_END * thinness });
    this.floor.position.set(Math.round(target.x / 5) * 5, Math.round(target.y / 5) * 5, -0.02); // below the objects that stand on it
    const { x, y } = isFlat ? target : this.camera.position;
    const { uniforms } = this.floor.material;
    uniforms?.eye.value.set((x + target.x) / 2, (y + target.y) / 2);
    if (uniforms) uniforms.thinness.value = thinness;
    this.renderer.render(this.scene, this.camera);
  }
}
