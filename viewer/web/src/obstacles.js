// Obstacles as instanced boxes, with a soft dark spot below each, so that one sees where it hovers. Only those in view
// are given to the renderer: without a GPU it pays for every corner.
import * as THREE from 'three';
import { cutaway, SIEVE_RADIUS } from './cutaway.js';
import { numbers } from './form.js';
import { palette } from './palette.js';
import { FOG_END } from './world.js';

const MOST = 4096; // what is drawn at most
const SIEVE_FAR = 40; // m from the vehicle towards the camera
const THRIFTY_SPOTS = 15; // m: spots farther away are not drawn by a renderer without a GPU
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
function faceTexture(thrifty) {
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
  texture.anisotropy = thrifty ? 1 : 4;
  if (thrifty) texture.minFilter = THREE.LinearMipmapNearestFilter;
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

/** Boxes of one material, as many as are drawn this time. */
class Boxes {
  constructor(scene, geometry, material) {
    this.mesh = new THREE.InstancedMesh(geometry, material, MOST);
    this.mesh.instanceColor = new THREE.InstancedBufferAttribute(new Float32Array(3 * MOST), 3);
    this.mesh.instanceColor.setUsage(THREE.DynamicDrawUsage);
    this.mesh.instanceMatrix.setUsage(THREE.DynamicDrawUsage);
    this.mesh.frustumCulled = false;
    this.rows = new Int32Array(MOST); // in the set
    scene.add(this.mesh);
  }

  add(row, [x, y, z], [width, depth, height], color) {
    color?.toArray(this.mesh.instanceColor.array, 3 * this.mesh.count);
    this.rows[this.mesh.count] = row;
    const matrix = this.mesh.instanceMatrix.array;
    const m = 16 * this.mesh.count++;
    matrix[m] = width;
    matrix[m + 5] = depth;
    matrix[m + 10] = height;
    matrix[m + 12] = x;
    matrix[m + 13] = y;
    matrix[m + 14] = z;
    matrix[m + 15] = 1;
  }

  done() {
    touch(this.mesh.instanceMatrix, this.mesh.count);
    if (this.mesh.instanceColor) touch(this.mesh.instanceColor, this.mesh.count);
  }

  /** {row, distance} of the first under a ray, or null. */
  hit(raycaster) {
    this.mesh.computeBoundingSphere();
    const [first] = raycaster.intersectObject(this.mesh);
    return first ? { row: this.rows[first.instanceId], distance: first.distance } : null;
  }
}

export class Obstacles {
  /** @param vehicle  where it is; kept */
  constructor(world, vehicle) {
    const faces = faceTexture(world.thrifty);
    const look = { map: faces, vertexColors: true };
    const box = litBox(world);
    this.boxes = new Boxes(world.scene, box, new THREE.MeshBasicMaterial(look));
    // What may stand before the vehicle: a sieve, whose every pixel costs more.
    this.sieves = new Boxes(world.scene, box, cutaway(new THREE.MeshBasicMaterial(look), vehicle));
    this.spots = new Boxes(world.scene, new THREE.PlaneGeometry(1, 1), new THREE.MeshBasicMaterial({
      map: spotTexture(), transparent: true, depthWrite: false }));
    this.spots.mesh.renderOrder = -1;
    this.spots.mesh.instanceColor = null;
    this.vehicle = vehicle;
    this.spotReach = world.thrifty ? THRIFTY_SPOTS : Infinity;
    this.colors = { 0: new THREE.Color(palette.pillar), 1: new THREE.Color(palette.mover) };
    this.picked = new THREE.Color(palette.picked);
    this.frustum = new THREE.Frustum();
    this.sphere = new THREE.Sphere();
    this.clear();
  }

  clear() {
    this.set = null;
    this.count = 0;
    for (const boxes of this.all()) boxes.mesh.count = 0;
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

  /** What is in view, the nearest first: what they hide costs nothing then. @param now_us  the vehicle's clock */
  draw(now_us, camera) {
    if (!this.set) return;
    const dt = this.guess(now_us);
    camera.updateMatrixWorld();
    this.frustum.setFromProjectionMatrix(camera.matrixWorldInverse.clone().premultiply(camera.projectionMatrix));
    const eye = camera.position;
    const { p, v } = this.set;
    const rows = [];
    for (let k = 0; k < this.count; ++k) {
      const i = 3 * k;
      const at = new THREE.Vector3(p[i] + v[i] * dt, p[i + 1] + v[i + 1] * dt, p[i + 2] + v[i + 2] * dt);
      rows.push({ k, at, away: at.distanceToSquared(eye) });
    }
    rows.sort((a, b) => a.away - b.away);
    for (const boxes of this.all()) boxes.mesh.count = 0;
    const before = this.before(camera);
    for (const row of rows) this.place(row, before, camera.isOrthographicCamera ? Infinity : FOG_END);
    for (const boxes of this.all()) boxes.done();
  }

  all() {
    return [this.boxes, this.sieves, this.spots];
  }

  place({ k, at, away }, before, reach) {
    const half = this.set.h.slice(3 * k, 3 * k + 3);
    const [hx, hy, hz] = half;
    const radius = Math.hypot(hx, hy, hz);
    if (away > (reach + radius) ** 2) return;
    if (this.isSeen(at.x, at.y, at.z, radius)) {
      const color = this.set.id[k] === this.pickedId ? this.picked : this.colors[this.set.moves[k]];
      (before(at, half) ? this.sieves : this.boxes).add(k, at.toArray(), half.map((h) => 2 * h), color);
    }
    const spread = 2.6 + 0.25 * Math.max(at.z - hz, 0);
    if (away < this.spotReach ** 2 && this.isSeen(at.x, at.y, 0.02, 0.5 * spread * Math.hypot(hx, hy))) {
      this.spots.add(k, [at.x, at.y, 0.02], [spread * hx, spread * hy, 1]);
    }
  }

  /** Whether a box may hide the vehicle, or what is near it, from this camera: it is near the line between them. */
  before(camera) {
    const back = camera.isOrthographicCamera
      ? camera.getWorldDirection(new THREE.Vector3()).multiplyScalar(-SIEVE_FAR)
      : camera.position.clone().sub(this.vehicle).clampLength(0, SIEVE_FAR);
    const steps = Math.max(Math.ceil(back.length()), 1); // a metre each
    const line = Array.from({ length: steps + 1 }, (_, k) => back.clone().multiplyScalar(k / steps).add(this.vehicle));
    return (at, [hx, hy, hz]) => line.some((p) => {
      const x = Math.max(Math.abs(p.x - at.x) - hx, 0);
      const y = Math.max(Math.abs(p.y - at.y) - hy, 0);
      const z = Math.max(Math.abs(p.z - at.z) - hz, 0);
      return x * x + y * y + z * z < (SIEVE_RADIUS + 0.5) ** 2;
    });
  }

  isSeen(x, y, z, radius) {
    this.sphere.center.set(x, y, z);
    this.sphere.radius = radius;
    return this.frustum.intersectsSphere(this.sphere);
  }

  show(on) {
    for (const { mesh } of this.all()) mesh.visible = on;
  }

  /** The obstacle under a ray, {id, distance}, or nothing. */
  hit(raycaster) {
    if (!this.set || !this.boxes.mesh.visible) return null;
    const hits = [this.boxes.hit(raycaster), this.sieves.hit(raycaster)].filter((hit) => hit);
    hits.sort((a, b) => a.distance - b.distance);
    return hits.length ? { id: this.set.id[hits[0].row], distance: hits[0].distance } : null;
  }
}
