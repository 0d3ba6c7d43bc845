// Obstacles as instanced boxes, with a soft dark spot below each, so that one sees where it hovers.
import * as THREE from 'three';
import { numbers } from './form.js';
import { palette } from './palette.js';

const MOST = 4096; // what is drawn at most
const LONGEST_GUESS_S = 0.25; // positions are carried on by velocity no longer than this

function spotTexture() {
  const size = 64;
  const canvas = document.createElement('canvas');
  canvas.width = canvas.height = size;
  const context = canvas.getContext('2d');
  const gradient = context.createRadialGradient(32, 32, 4, 32, 32, 32);
  gradient.addColorStop(0, 'rgba(0,0,0,0.62)');
  gradient.addColorStop(1, 'rgba(0,0,0,0)');
  context.fillStyle = gradient;
  context.fillRect(0, 0, size, size);
  return new THREE.CanvasTexture(canvas);
}

/** Faces a little darker within than at their edges: boxes keep their outline without lines. */
function faceTexture() {
  const size = 128;
  const canvas = document.createElement('canvas');
  canvas.width = canvas.height = size;
  const context = canvas.getContext('2d');
  context.fillStyle = '#fff';
  context.fillRect(0, 0, size, size);
  context.fillStyle = '#d2d2d2';
  context.fillRect(4, 4, size - 8, size - 8);
  const texture = new THREE.CanvasTexture(canvas);
  texture.colorSpace = THREE.SRGBColorSpace;
  texture.generateMipmaps = true;
  texture.anisotropy = 4;
  return texture;
}

/** Nothing hides the vehicle: what stands before it, as seen from the camera, is drawn as a sieve. */
function cutaway(material, vehicle) {
  material.onBeforeCompile = (shader) => {
    shader.uniforms.vehicle = { value: vehicle };
    shader.vertexShader = shader.vertexShader
      .replace('#include <common>', '#include <common>\nvarying vec3 seen;')
      .replace('#include <project_vertex>', '#include <project_vertex>\nseen = mvPosition.xyz;');
    shader.fragmentShader = shader.fragmentShader
      .replace('#include <common>', '#include <common>\nvarying vec3 seen; uniform vec3 vehicle;')
      .replace('#include <clipping_planes_fragment>', `
        vec3 target = (viewMatrix * vec4(vehicle, 1.0)).xyz;
        float along = dot(seen, target) / dot(target, target);
        float aside = length(seen - along * target) / (0.35 + 0.65 * along);
        if (along < 0.97 && aside < 1.5) {
          float keep = mix(0.12, 1.0, smoothstep(0.7, 1.5, aside));
          float sieve = fract(52.9829189 * fract(dot(floor(gl_FragCoord.xy), vec2(0.06711056, 0.00583715))));
          if (sieve > keep) discard;
        }`);
  };
  return material;
}

export class Obstacles {
  /** @param vehicle  where it is; kept */
  constructor(scene, vehicle) {
    const material = cutaway(new THREE.MeshLambertMaterial({ map: faceTexture() }), vehicle);
    this.boxes = new THREE.InstancedMesh(new THREE.BoxGeometry(1, 1, 1), material, MOST);
    this.spots = new THREE.InstancedMesh(
      new THREE.PlaneGeometry(1, 1),
      new THREE.MeshBasicMaterial({ map: spotTexture(), transparent: true, depthWrite: false }), MOST);
    this.spots.renderOrder = -1;
    for (const mesh of [this.boxes, this.spots]) {
      mesh.frustumCulled = false;
      mesh.count = 0;
      mesh.instanceMatrix.setUsage(THREE.DynamicDrawUsage);
      scene.add(mesh);
    }
    this.colors = { 0: new THREE.Color(palette.pillar), 1: new THREE.Color(palette.mover) };
    this.picked = new THREE.Color('#ffffff');
    this.clear();
  }

  clear() {
    this.set = null;
    this.boxes.count = this.spots.count = 0;
  }

  get count() {
    return this.boxes.count;
  }

  /**
   * @param set  {at_us, id, moves, p, v, h}: a row per obstacle; p, v, h are flat, three numbers each
   * @throws RangeError when the lists are not of one length
   */
  take(set) {
    const n = numbers(set.id, 1).length;
    numbers(set.moves, 1, n);
    for (const list of [set.p, set.v, set.h]) numbers(list, 3, n);
    this.set = set;
    this.boxes.count = this.spots.count = Math.min(n, MOST);
    this.recolor();
  }

  pick(id) {
    this.pickedId = id;
    this.recolor();
  }

  recolor() {
    for (let k = 0; k < this.boxes.count; ++k) {
      const color = this.set.id[k] === this.pickedId ? this.picked : this.colors[this.set.moves[k]];
      this.boxes.setColorAt(k, color);
    }
    if (this.boxes.instanceColor) this.boxes.instanceColor.needsUpdate = true;
  }

  /** @param now_us  the vehicle's clock */
  draw(now_us) {
    if (!this.set) return;
    const dt = Math.min(Math.max((now_us - this.set.at_us) * 1e-6, 0), LONGEST_GUESS_S);
    const { p, v, h } = this.set;
    const box = this.boxes.instanceMatrix.array;
    const spot = this.spots.instanceMatrix.array;
    for (let k = 0; k < this.boxes.count; ++k) {
      const i = 3 * k;
      const m = 16 * k;
      const x = p[i] + v[i] * dt;
      const y = p[i + 1] + v[i + 1] * dt;
      const z = p[i + 2] + v[i + 2] * dt;
      box[m] = 2 * h[i];
      box[m + 5] = 2 * h[i + 1];
      box[m + 10] = 2 * h[i + 2];
      box[m + 12] = x;
      box[m + 13] = y;
      box[m + 14] = z;
      box[m + 15] = 1;
      const spread = 2.6 + 0.25 * Math.max(z - h[i + 2], 0);
      spot[m] = spread * h[i];
      spot[m + 5] = spread * h[i + 1];
      spot[m + 10] = 1;
      spot[m + 12] = x;
      spot[m + 13] = y;
      spot[m + 14] = 0.02;
      spot[m + 15] = 1;
    }
    this.boxes.instanceMatrix.needsUpdate = true;
    this.spots.instanceMatrix.needsUpdate = true;
  }

  /** The obstacle under a ray, {id, distance}, or nothing. */
  hit(raycaster) {
    if (!this.set) return null;
    this.boxes.computeBoundingSphere();
    const [first] = raycaster.intersectObject(this.boxes);
    return first ? { id: this.set.id[first.instanceId], distance: first.distance } : null;
  }
}
