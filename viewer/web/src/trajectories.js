// The flown path by speed, the committed trajectory, the newest plan with its MINVO simplices, local goal and sphere.
import * as THREE from 'three';
import { LineMaterial } from 'three/addons/lines/LineMaterial.js';
import { LineSegments2 } from 'three/addons/lines/LineSegments2.js';
import { LineSegmentsGeometry } from 'three/addons/lines/LineSegmentsGeometry.js';
import { repeated, touch } from './copies.js';
import { numbers, point } from './form.js';
import { palette, speedColor } from './palette.js';
import { countUpTo } from './time_rows.js';

const RING = 0.35; // m, radius of the goal's ring
const RING_PX = 14; // its least radius in the window
const EDGES = [0, 1, 0, 2, 0, 3, 1, 2, 1, 3, 2, 3];
const FACES = [0, 1, 2, 0, 1, 3, 0, 2, 3, 1, 2, 3];

/** One segment, for LineMaterial: x is the side, y is along it, and beyond its ends for round caps. */
const SEGMENT = new LineSegmentsGeometry();
const CORNERS = SEGMENT.attributes.position.count;

/**
 * A line of changing length, `width` pixels wide. Its buffers grow and are reused. They contain every corner of a segment,
 * since instances cost a renderer without a GPU as much as meshes.
 */
export class Ribbon {
  constructor(scene, options) {
    this.material = new LineMaterial({ linewidth: 3, transparent: true, ...options });
    this.line = new LineSegments2(new THREE.BufferGeometry(), this.material);
    this.line.frustumCulled = false;
    this.line.visible = false;
    this.room = 0; // segments
    scene.add(this.line);
  }
  /** @param positions, colors  flat, three numbers per point */
  set(positions, colors = null) {
    const segments = positions.length / 3 - 1;
    this.line.visible = segments >= 1;
    if (!this.line.visible) return;
    if (segments > this.room) this.grow(2 * segments);
    this.write('instanceStart', positions, 0);
    this.write('instanceEnd', positions, 3);
    if (colors) this.write('instanceColorStart', colors, 0);
    if (colors) this.write('instanceColorEnd', colors, 3);
    this.line.geometry.setDrawRange(0, segments * SEGMENT.index.count);
  }
  grow(segments) {
    this.room = segments;
    this.line.geometry.dispose();
    const geometry = (this.line.geometry = repeated(SEGMENT, segments));
    for (const name of ['instanceStart', 'instanceEnd', 'instanceColorStart', 'instanceColorEnd']) {
      const all = new Float32Array(3 * CORNERS * segments);
      geometry.setAttribute(name, new THREE.BufferAttribute(all, 3).setUsage(THREE.DynamicDrawUsage));
    }
  }
  /** Writes one end of every segment to each of its corners. @param rows  three numbers per point  @param skip  of them */
  write(name, rows, skip) {
    const attribute = this.line.geometry.attributes[name];
    let to = 0;
    for (let from = skip; from + 3 <= rows.length - 3 + skip; from += 3) {
      for (let corner = 0; corner < CORNERS; ++corner) {
        for (let k = 0; k < 3; ++k) attribute.array[to++] = rows[from + k];
      }
    }
    touch(attribute, to / 3);
  }
}

/** Tetrahedra, four points each, with faint faces, edges and corners, since they are slivers at speed. */
class Simplices {
  constructor(scene, color) {
    this.group = new THREE.Group();
    this.edges = new THREE.LineSegments(
      new THREE.BufferGeometry(), new THREE.LineBasicMaterial({ color, transparent: true, opacity: 0.3, depthWrite: false }));
    this.faces = new THREE.Mesh(
      new THREE.BufferGeometry(),
      new THREE.MeshBasicMaterial({ color, transparent: true, opacity: 0.05, side: THREE.DoubleSide, depthWrite: false }));
    this.corners = new THREE.Points(
      new THREE.BufferGeometry(),
      new THREE.PointsMaterial({ color, size: 4, sizeAttenuation: false, transparent: true, opacity: 0.75, depthWrite: false }));
    for (const mesh of [this.edges, this.faces, this.corners]) mesh.frustumCulled = false;
    this.group.add(this.edges, this.faces, this.corners);
    scene.add(this.group);
  }
  set(points) {
    if (this.positions?.array.length !== points.length) this.resize(points.length / 12);
    this.positions.array.set(points);
    this.positions.needsUpdate = true;
  }
  resize(simplices) {
    const index = (pattern) => Array.from({ length: simplices }, (_, j) => pattern.map((k) => 4 * j + k)).flat();
    this.positions = new THREE.Float32BufferAttribute(12 * simplices, 3);
    for (const [mesh, pattern] of [[this.edges, EDGES], [this.faces, FACES], [this.corners, [0, 1, 2, 3]]]) {
      mesh.geometry.dispose();
      mesh.geometry = new THREE.BufferGeometry().setAttribute('position', this.positions).setIndex(index(pattern));
    }
  }
}

/** The unit sphere as its equator and two meridians. */
function circles(color, opacity) {
  const segments = 72;
  const points = [];
  for (let axis = 0; axis < 3; ++axis) {
    for (let k = 0; k < segments; ++k) {
      for (const end of [k, k + 1]) {
        const angle = (2 * Math.PI * end) / segments;
        const p = [0, 0, 0];
        p[(axis + 1) % 3] = Math.cos(angle);
        p[(axis + 2) % 3] = Math.sin(angle);
        points.push(...p);
      }
    }
  }
  return new THREE.LineSegments(
    new THREE.BufferGeometry().setAttribute('position', new THREE.Float32BufferAttribute(points, 3)),
    new THREE.LineBasicMaterial({ color, transparent: true, opacity, depthWrite: false }));
}

/** [x, y, z, speed, …] → positions, and colours by speed. */
function split(curve, top, target = new THREE.Color()) {
  numbers(curve, 4);
  const positions = [];
  const colors = [];
  for (let k = 0; k < curve.length; k += 4) {
    positions.push(curve[k], curve[k + 1], curve[k + 2]);
    speedColor(curve[k + 3] / top, target);
    colors.push(target.r, target.g, target.b);
  }
  return { positions, colors };
}

export class Trajectories {
  constructor(scene) {
    this.top = 6; // m/s, the speed of the last colour
    this.path = new Ribbon(scene, { linewidth: 4, vertexColors: true });
    this.tail = new Ribbon(scene, { linewidth: 4, vertexColors: true });
    this.committed = new Ribbon(scene, { color: palette.committed, linewidth: 2, opacity: 0.85 });
    this.plan = new Ribbon(scene, { color: palette.plan, linewidth: 4 });
    this.minvo = new Simplices(scene, palette.plan);
    this.sphere = circles(palette.sphere, 0.22);
    this.localGoal = new THREE.Mesh(
      new THREE.OctahedronGeometry(0.13), new THREE.MeshLambertMaterial({ color: palette.goal, emissive: '#6b4d00' }));
    this.goal = new THREE.Group();
    const ring = new THREE.Mesh(
      new THREE.TorusGeometry(RING, RING / 14, 10, 48), new THREE.MeshBasicMaterial({ color: palette.goal }));
    const stem = new THREE.Mesh(
      new THREE.CylinderGeometry(0.012, 0.012, 1, 8), new THREE.MeshBasicMaterial({ color: palette.goal, transparent: true, opacity: 0.5 }));
    stem.rotation.x = Math.PI / 2;
    this.goal.add(ring, stem);
    this.goal.stem = stem;
    scene.add(this.sphere, this.localGoal, this.goal);
    this.clear();
  }

  clear() {
    for (const ribbon of [this.path, this.tail, this.committed, this.plan]) ribbon.line.visible = false;
    this.minvo.set([]);
    this.sphere.visible = this.localGoal.visible = this.goal.visible = false;
    this.recent = []; // [t, x, y, z, speed]
    this.flown = { t: [], curve: [] };
    this.drawnPoints = -1;
  }

  /** @param path  {t, curve}: the known flight, [x, y, z, speed, …], t in its seconds */
  takePath(path) {
    numbers(path.curve, 4, numbers(path.t, 1).length);
    this.flown = path;
    this.drawnPoints = -1;
  }

  /**
   * Draws the path up to the vehicle. The path is sent twice a second; its end is made of the states.
   * @param t  of the state, s
   */
  takeState(state, t) {
    const { t: times, curve } = this.flown;
    const known = countUpTo(times, t);
    if (known !== this.drawnPoints) {
      const { positions, colors } = split(curve.slice(0, 4 * known), this.top);
      this.path.set(positions, colors);
      this.drawnPoints = known;
    }
    const from = known > 0 ? times[known - 1] : -Infinity;
    this.recent = this.recent.filter(([at]) => at > from && at < t);
    this.recent.push([t, ...state.p, Math.hypot(...state.v)]);
    const last = known > 0 ? curve.slice(4 * known - 4, 4 * known) : [];
    const { positions, colors } = split([...last, ...this.recent.flatMap((row) => row.slice(1))], this.top);
    this.tail.set(positions, colors);
  }

  /** Draws the path up to the present, and the goal. */
  extent(box) {
    const { curve } = this.flown;
    for (let k = 0; k < curve.length; k += 4) box.expandByPoint(new THREE.Vector3(curve[k], curve[k + 1], curve[k + 2]));
    if (this.goal.visible) box.expandByPoint(this.goal.position);
    return box;
  }

  takeRequest(request) {
    point(request.v_max);
    this.top = Math.max(Math.hypot(request.v_max[0], request.v_max[1]) * 0.85, 0.1);
    this.committed.set(split(request.curve, this.top).positions);
    this.sphere.position.set(...point(request.p));
  }

  /** @param plan  null: none yet */
  takePlan(plan) {
    this.plan.set(plan?.curve ? split(plan.curve, this.top).positions : []);
    this.minvo.set(numbers(plan?.minvo ?? [], 12));
    this.sphere.visible = this.wantSphere && plan?.radius > 0;
    this.localGoal.visible = Boolean(plan);
    if (!plan) return;
    this.sphere.scale.setScalar(Math.max(plan.radius, 0.01));
    this.localGoal.position.set(...point(plan.local_goal));
  }

  takeGoal(goal) {
    this.goal.visible = Boolean(goal?.p); // hold and stop have no position
    if (!this.goal.visible) return;
    this.goal.position.set(...point(goal.p));
    this.goal.stem.scale.y = Math.max(goal.p[2], 0.01);
    this.goal.stem.position.z = -goal.p[2] / 2;
  }

  /** Turns the goal's ring to the camera, so it is a circle from any side, and one that is seen from afar. @param height  px */
  draw(seconds, camera, height) {
    this.localGoal.rotation.z = 1.2 * seconds;
    const [ring] = this.goal.children;
    const metres = camera.isOrthographicCamera
      ? (camera.top - camera.bottom) / camera.zoom
      : (2 * this.goal.position.distanceTo(camera.position) * Math.tan(THREE.MathUtils.degToRad(camera.fov / 2))) / camera.zoom;
    ring.scale.setScalar(Math.max((RING_PX * metres) / height / RING, 1));
    ring.quaternion.copy(camera.quaternion);
  }

  show(layer, on) {
    if (layer === 'path') this.path.material.visible = this.tail.material.visible = on;
    if (layer === 'plan') this.plan.material.visible = this.localGoal.material.visible = on;
    if (layer === 'minvo') this.minvo.group.visible = on;
    if (layer === 'committed') this.committed.material.visible = on;
    if (layer === 'sphere') this.wantSphere = this.sphere.visible = on;
  }
}
