// Obstacles as instanced boxes, with a soft dark spot below each, so that one sees where it hovers. Only those in view
// are given to the renderer: without a GPU it pays for every corner.
import * as THREE from 'three';
import { cutaway } from './cutaway.js';
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
  gradient.addColorStop(0, palette.shadow);
  gradient.addColorStop(1, 'transparent');
  context.fillStyle = gradient;
  context.fillRect(0, 0, size, size);
  return new THREE.CanvasTexture(canvas);
}

/** Faces a little darker within than at their edges: boxes keep their outline without lines. */
function faceTexture(anisotropy) {
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
  texture.anisotropy = anisotropy;
  return texture;
}

/** A box whose faces are lit as they will always be: boxes do not turn. */
function litBox(world) {
  const geometry = new THREE.BoxGeometry(1, 1, 1);
  const { normal } = geometry.attributes;
  const colors = [];
  for (let k = 0; k < normal.count; ++k) {
    colors.push(...world.lightOn(new THREE.Vector3().fromBufferAttribute(normal, k)).toArray());
  }
  return geometry.setAttribute('color', new THREE.Float32BufferAttribute(colors, 3));
}

/** Tells the renderer that the first `count` instances have changed. */
function touch(attribute, count) {
  attribute.clearUpdateRanges();
  attribute.addUpdateRange(0, count * attribute.itemSize);
  attribute.needsUpdate = true;
}

export class Obstacles {
  /** @param vehicle  where it is; kept */
  constructor(world, vehicle) {
    const faces = faceTexture(world.thrifty ? 1 : 4);
    const material = cutaway(new THREE.MeshBasicMaterial({ map: faces, vertexColors: true }), vehicle);
    this.boxes = new THREE.InstancedMesh(litBox(world), material, MOST);
    this.boxes.instanceColor = new THREE.InstancedBufferAttribute(new Float32Array(3 * MOST), 3);
    this.spots = new THREE.InstancedMesh(
      new THREE.PlaneGeometry(1, 1),
      new THREE.MeshBasicMaterial({ map: spotTexture(), transparent: true, depthWrite: false }), MOST);
    this.spots.renderOrder = -1;
    for (const mesh of [this.boxes, this.spots]) {
      mesh.frustumCulled = false;
      mesh.instanceMatrix.setUsage(THREE.DynamicDrawUsage);
      world.scene.add(mesh);
    }
    this.boxes.instanceColor.setUsage(THREE.DynamicDrawUsage);
    this.colors = { 0: new THREE.Color(palette.pillar), 1: new THREE.Color(palette.mover) };
    this.picked = new THREE.Color(palette.picked);
    this.frustum = new THREE.Frustum();
    this.sphere = new THREE.Sphere();
    this.drawn = new Int32Array(MOST); // row in the set of each box that is drawn
    this.clear();
  }

  clear() {
    this.set = null;
    this.count = this.boxes.count = this.spots.count = 0;
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
    this.count = Math.min(n, MOST);
  }

  pick(id) {
    this.pickedId = id;
  }

  /** Where the obstacle's middle is now, or null if there is no such. @param now_us  the vehicle's clock */
  where(id, now_us) {
    const k = this.set?.id.indexOf(id) ?? -1;
    if (k < 0) return null;
    const { p, v } = this.set;
    const dt = this.guess(now_us);
    return new THREE.Vector3(...[0, 1, 2].map((axis) => p[3 * k + axis] + v[3 * k + axis] * dt));
  }

  /** Seconds from the set to now, as far as one may guess. */
  guess(now_us) {
    return Math.min(Math.max((now_us - this.set.at_us) * 1e-6, 0), LONGEST_GUESS_S);
  }

  /** @param now_us  the vehicle's clock */
  draw(now_us, camera) {
    if (!this.set) return;
    const dt = this.guess(now_us);
    camera.updateMatrixWorld();
    this.frustum.setFromProjectionMatrix(camera.matrixWorldInverse.clone().premultiply(camera.projectionMatrix));
    this.boxes.count = this.spots.count = 0;
    const { p, v } = this.set;
    for (let k = 0; k < this.count; ++k) {
      const i = 3 * k;
      this.place(k, p[i] + v[i] * dt, p[i + 1] + v[i + 1] * dt, p[i + 2] + v[i + 2] * dt);
    }
    touch(this.boxes.instanceMatrix, this.boxes.count);
    touch(this.boxes.instanceColor, this.boxes.count);
    touch(this.spots.instanceMatrix, this.spots.count);
  }

  place(k, x, y, z) {
    const [hx, hy, hz] = this.set.h.slice(3 * k, 3 * k + 3);
    if (this.isSeen(x, y, z, Math.hypot(hx, hy, hz))) {
      const color = this.set.id[k] === this.pickedId ? this.picked : this.colors[this.set.moves[k]];
      color.toArray(this.boxes.instanceColor.array, 3 * this.boxes.count);
      this.drawn[this.boxes.count] = k;
      this.add(this.boxes, x, y, z, 2 * hx, 2 * hy, 2 * hz);
    }
    const spread = 2.6 + 0.25 * Math.max(z - hz, 0);
    if (this.isSeen(x, y, 0.02, 0.5 * spread * Math.hypot(hx, hy))) {
      this.add(this.spots, x, y, 0.02, spread * hx, spread * hy, 1);
    }
  }

  isSeen(x, y, z, radius) {
    this.sphere.center.set(x, y, z);
    this.sphere.radius = radius;
    return this.frustum.intersectsSphere(this.sphere);
  }

  add(mesh, x, y, z, width, depth, height) {
    const matrix = mesh.instanceMatrix.array;
    const m = 16 * mesh.count++;
    matrix[m] = width;
    matrix[m + 5] = depth;
    matrix[m + 10] = height;
    matrix[m + 12] = x;
    matrix[m + 13] = y;
    matrix[m + 14] = z;
    matrix[m + 15] = 1;
  }

  show(on) {
    this.boxes.visible = this.spots.visible = on;
  }

  /** The obstacle under a ray, {id, distance}, or nothing. */
  hit(raycaster) {
    if (!this.set || !this.boxes.visible) return null;
    this.boxes.computeBoundingSphere();
    const [first] = raycaster.intersectObject(this.boxes);
    return first ? { id: this.set.id[this.drawn[first.instanceId]], distance: first.distance } : null;
  }
}
