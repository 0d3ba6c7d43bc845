// Obstacles as boxes, each with a soft dark spot below that shows where it hovers. Only obstacles in view are given to the
// renderer: without a GPU it pays for every corner.
import * as THREE from 'three';
import { repeated, touch } from './copies.js';
import { cutaway, SIEVE_RADIUS } from './cutaway.js';
import { numbers } from './form.js';
import { palette } from './palette.js';
import { placeInWindow } from './tags.js';

const MOST = 4096; // most boxes that are drawn
const SIEVE_FAR = 40; // m from the vehicle towards the camera
const THRIFTY_SPOTS = 15; // m; a renderer without a GPU skips spots farther away
const NAMED = 30; // m from the vehicle: names of obstacles farther away are not shown
const LONGEST_GUESS_S = 0.25; // positions are extrapolated by velocity for at most this long

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

const RIM = 0.031; // of a face's width
const WITHIN = 0.65; // brightness of a face inside its rim

/**
 * Faces that are a little darker inside than at their edges, so boxes have an outline without lines or texture.
 * Vertices carry light and fog; alpha is the part that the fog leaves.
 */
function rimmed(within) {
  const material = new THREE.MeshBasicMaterial({ vertexColors: true, fog: false });
  material.defines = { USE_UV: '' };
  material.onBeforeCompile = (shader) => {
    shader.fragmentShader = shader.fragmentShader.replace('#include <map_fragment>', `
      float inset = 0.5 - max(abs(vUv.x - 0.5), abs(vUv.y - 0.5));
      float soft = fwidth(inset);
      diffuseColor.rgb *= 1.0 - ${(1 - within).toFixed(2)} * vColor.a * smoothstep(${RIM} - soft, ${RIM} + soft, inset);`);
  };
  return material;
}

/** A box with constant lighting of its faces: boxes do not turn. */
function litBox(world) {
  const geometry = new THREE.BoxGeometry(1, 1, 1);
  const { normal } = geometry.attributes;
  const colors = [];
  for (let k = 0; k < normal.count; ++k) {
    colors.push(...world.lightOn(new THREE.Vector3().fromBufferAttribute(normal, k)).toArray(), 1);
  }
  return geometry.setAttribute('color', new THREE.Float32BufferAttribute(colors, 4));
}

/** The boxes of one material. */
class Boxes {
  /** @param shape  unit box; its colours, if any, are those of white in the light */
  constructor(scene, shape, material) {
    this.shape = shape;
    this.mesh = new THREE.Mesh(repeated(shape, MOST), material);
    this.mesh.frustumCulled = false;
    this.rows = new Int32Array(MOST); // in the set
    this.count = 0;
    scene.add(this.mesh);
  }

  /** @param paint  [r, g, b] for a shape with colours @param clear  the part that fog leaves  @param fog  [r, g, b] */
  add(row, at, size, paint, clear, fog) {
    const { position, color: light } = this.shape.attributes;
    const all = this.mesh.geometry.attributes;
    const first = this.count * position.array.length;
    for (let k = 0; k < position.array.length; ++k) {
      all.position.array[first + k] = at[k % 3] + size[k % 3] * position.array[k];
    }
    if (light) this.paint(this.count * light.array.length, paint, clear, fog);
    this.rows[this.count++] = row;
  }

  paint(first, paint, clear, fog) {
    const { array: light } = this.shape.attributes.color;
    const { array } = this.mesh.geometry.attributes.color;
    for (let k = 0; k < light.length; k += 4) {
      for (let c = 0; c < 3; ++c) array[first + k + c] = clear * paint[c] * light[k + c] + (1 - clear) * fog[c];
      array[first + k + 3] = clear;
    }
  }

  done() {
    const { position, color } = this.mesh.geometry.attributes;
    const vertices = this.count * this.shape.attributes.position.count;
    for (const attribute of [position, color]) if (attribute) touch(attribute, vertices);
    this.mesh.geometry.setDrawRange(0, this.count * this.shape.index.count);
  }

  /** Returns {row, distance} of the first box under a ray, or null. */
  hit(raycaster) {
    this.mesh.geometry.computeBoundingSphere();
    const [first] = raycaster.intersectObject(this.mesh);
    return first ? { row: this.rows[Math.floor((3 * first.faceIndex) / this.shape.index.count)], distance: first.distance } : null;
  }
}

export class Obstacles {
  /** @param vehicle  its position; the reference is stored */
  constructor(world, vehicle) {
    const faces = () => rimmed(world.shade(WITHIN));
    const box = litBox(world);
    this.boxes = new Boxes(world.scene, box, faces());
    // Boxes that may hide the vehicle are sieves, whose every pixel costs more.
    this.sieves = new Boxes(world.scene, box, cutaway(faces(), vehicle));
    this.spots = new Boxes(world.scene, new THREE.PlaneGeometry(1, 1), new THREE.MeshBasicMaterial({
      map: spotTexture(), transparent: true, depthWrite: false }));
    this.spots.mesh.renderOrder = -1;
    this.vehicle = vehicle;
    this.spotReach = world.thrifty ? THRIFTY_SPOTS : Infinity;
    const rgb = (color) => new THREE.Color(color).toArray();
    this.colors = { 0: rgb(palette.pillar), 1: rgb(palette.mover), picked: rgb(palette.picked), fog: rgb(palette.back) };
    this.world = world;
    this.frustum = new THREE.Frustum();
    this.sphere = new THREE.Sphere();
    this.clear();
  }

  clear() {
    this.set = null;
    this.count = 0;
    for (const boxes of this.all()) {
      boxes.count = 0;
      boxes.done();
    }
  }

  /**
   * @param set  {at_us, id, moves, p, v, h, names}: a row per obstacle; p, v, h are flat, three numbers each; names by id
   * @throws RangeError if the lists differ in length
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

  /** Returns the obstacle's present centre, or null if it does not exist. @param now_us  the vehicle's clock */
  where(id, now_us) {
    const k = this.set?.id.indexOf(id) ?? -1;
    if (k < 0) return null;
    const { p, v } = this.set;
    const dt = this.guess(now_us);
    return new THREE.Vector3(...[0, 1, 2].map((axis) => p[3 * k + axis] + v[3 * k + axis] * dt));
  }

  /** Returns the tags of the obstacles that have a name. @param window  its size, CSS pixels */
  tags(now_us, camera, window) {
    if (!this.set?.names || !this.boxes.mesh.visible) return [];
    return Object.entries(this.set.names).flatMap(([id, text]) => {
      const at = this.where(Number(id), now_us);
      if (!at || at.distanceTo(this.vehicle) > NAMED) return [];
      const half = this.set.h[3 * this.set.id.indexOf(Number(id)) + 2];
      const place = placeInWindow([at.x, at.y, at.z + half], camera, window);
      return place ? [{ ...place, text }] : [];
    });
  }

  /** Returns the seconds from the set to now, limited to LONGEST_GUESS_S. */
  guess(now_us) {
    return Math.min(Math.max((now_us - this.set.at_us) * 1e-6, 0), LONGEST_GUESS_S);
  }

  /** Sorts the obstacles in view, nearest first, so that hidden pixels cost nothing. @param now_us  the vehicle's clock */
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
    for (const boxes of this.all()) boxes.count = 0;
    const before = this.before(camera);
    const sight = this.world.sight();
    for (const row of rows) this.place(row, before, sight);
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
      const paint = this.colors[this.set.id[k] === this.pickedId ? 'picked' : this.set.moves[k]];
      const boxes = before(at, half) ? this.sieves : this.boxes;
      boxes.add(k, at.toArray(), half.map((h) => 2 * h), paint, this.world.clear(Math.sqrt(away)), this.colors.fog);
    }
    const spread = 2.6 + 0.25 * Math.max(at.z - hz, 0);
    if (away < this.spotReach ** 2 && this.isSeen(at.x, at.y, 0.02, 0.5 * spread * Math.hypot(hx, hy))) {
      this.spots.add(k, [at.x, at.y, 0.02], [spread * hx, spread * hy, 1]);
    }
  }

  /** Returns true if a box may hide the vehicle from this camera: it is near the line between them. */
  before(camera) {
    const back = camera.isOrthographicCamera
      ? camera.getWorldDirection(new THREE.Vector3()).multiplyScalar(-SIEVE_FAR)
      : camera.position.clone().sub(this.vehicle).clampLength(0, SIEVE_FAR);
    const steps = Math.max(Math.ceil(back.length()), 1); // one metre each
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

  /** Returns the obstacle under a ray, {id, distance}, or nothing. */
  hit(raycaster) {
    if (!this.set || !this.boxes.mesh.visible) return null;
    const hits = [this.boxes.hit(raycaster), this.sieves.hit(raycaster)].filter((hit) => hit);
    hits.sort((a, b) => a.distance - b.distance);
    return hits.length ? { id: this.set.id[hits[0].row], distance: hits[0].distance } : null;
  }
}
