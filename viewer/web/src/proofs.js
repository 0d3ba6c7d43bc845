// The objects that a plan was checked against: predicted hulls per interval, separating planes, nodes of the search.
import * as THREE from 'three';
import { ConvexHull } from 'three/addons/math/ConvexHull.js';
import { numbers, point } from './form.js';
import { palette } from './palette.js';

const PATCH = 0.9; // half the side of a drawn plane, m
const CREASE = 0.999; // cosine of the smallest angle between two faces whose common edge is drawn
const SOON = new THREE.Color(palette.hull);
const LATER = new THREE.Color(palette.hullLater);

/** Appends the edges of a convex hull to `out`, two points each; not those between triangles of one face. */
export function outline(points, out) {
  const hull = new ConvexHull().setFromPoints(points);
  for (const face of hull.faces) {
    let edge = face.edge;
    do {
      const [from, to] = [edge.tail().point, edge.head().point];
      const isOnce = from.x - to.x || from.y - to.y || from.z - to.z; // the other face has it the other way round
      if (isOnce > 0 && face.normal.dot(edge.twin.face.normal) < CREASE) out.push(...from.toArray(), ...to.toArray());
      edge = edge.next;
    } while (edge !== face.edge);
  }
}

function translucent(color, opacity) {
  return new THREE.MeshBasicMaterial({
    color, transparent: true, opacity, side: THREE.DoubleSide, depthWrite: false });
}

export class Proofs {
  constructor(scene) {
    // Outlines: many translucent faces, seen from within, would be fog.
    this.hulls = new THREE.LineSegments(
      new THREE.BufferGeometry(), new THREE.LineBasicMaterial({ vertexColors: true, transparent: true, opacity: 0.7, depthWrite: false }));
    this.planes = new THREE.Group();
    this.patches = new THREE.Mesh(new THREE.BufferGeometry(), translucent(palette.plane, 0.18));
    this.frames = new THREE.LineSegments(
      new THREE.BufferGeometry(), new THREE.LineBasicMaterial({ color: palette.plane, transparent: true, opacity: 0.8 }));
    this.planes.add(this.patches, this.frames);
    this.nodes = new THREE.LineSegments(
      new THREE.BufferGeometry(), new THREE.LineBasicMaterial({ color: palette.search, transparent: true, opacity: 0.35 }));
    for (const mesh of [this.hulls, this.patches, this.frames, this.nodes]) mesh.frustumCulled = false;
    scene.add(this.hulls, this.planes, this.nodes);
    this.clear();
  }

  clear() {
    this.counts = { hulls: 0, planes: 0, search: 0 }; // number of drawn objects
    for (const mesh of [this.hulls, this.patches, this.frames, this.nodes]) this.fill(mesh, []);
  }

  fill(mesh, positions, colors = null) {
    mesh.geometry.dispose();
    mesh.geometry = new THREE.BufferGeometry();
    mesh.geometry.setAttribute('position', new THREE.Float32BufferAttribute(positions, 3));
    if (colors) mesh.geometry.setAttribute('color', new THREE.Float32BufferAttribute(colors, 3));
  }

  /** @param message  {hulls: [{track, interval, points}]}; points flat; null: none */
  takeHulls(message) {
    const positions = [];
    const colors = [];
    const color = new THREE.Color();
    const last = (message?.hulls ?? []).reduce((most, { interval }) => Math.max(most, interval), 1);
    for (const hull of message?.hulls ?? []) {
      const points = [];
      numbers(hull.points, 3);
      for (let k = 0; k < hull.points.length; k += 3) points.push(new THREE.Vector3().fromArray(hull.points, k));
      if (points.length < 4) continue;
      outline(points, positions);
      color.copy(SOON).lerp(LATER, hull.interval / last);
      while (colors.length < positions.length) colors.push(color.r, color.g, color.b);
    }
    this.counts.hulls = message?.hulls?.length ?? 0;
    this.fill(this.hulls, positions, colors);
  }

  /**
   * Draws a patch of each plane between the interval's part and the obstacle.
   * @param plan  with planes; only those of the picked obstacle, if there is one
   */
  takePlanes(plan, picked) {
    const patches = [];
    const frames = [];
    const planes = (plan?.planes ?? []).filter((plane) => picked === undefined || plane.track === picked);
    for (const plane of planes) this.patch(plane, new THREE.Vector3(...point(plane.at)), patches, frames);
    this.counts.planes = planes.length;
    this.fill(this.patches, patches);
    this.fill(this.frames, frames);
  }

  patch(plane, from, patches, frames) {
    const n = new THREE.Vector3(...plane.n);
    const centre = from.clone().addScaledVector(n, -(n.dot(from) + plane.d));
    const u = new THREE.Vector3(-n.y, n.x, 0);
    if (u.lengthSq() < 1e-6) u.set(1, 0, 0);
    u.normalize().multiplyScalar(PATCH);
    const v = new THREE.Vector3().crossVectors(n, u);
    const corner = (a, b) => centre.clone().addScaledVector(u, a).addScaledVector(v, b).toArray();
    const c = [corner(-1, -1), corner(1, -1), corner(1, 1), corner(-1, 1)];
    patches.push(...c[0], ...c[1], ...c[2], ...c[0], ...c[2], ...c[3]);
    frames.push(...c[0], ...c[1], ...c[1], ...c[2], ...c[2], ...c[3], ...c[3], ...c[0]);
  }

  /** @param message  {nodes, edges}: number of nodes, and six numbers per edge of the search tree; null: none */
  takeSearch(message) {
    this.fill(this.nodes, numbers(message?.edges ?? [], 6));
    this.counts.search = message?.nodes ?? 0;
  }

  show(layer, on) {
    if (layer === 'hulls') this.hulls.visible = on;
    if (layer === 'planes') this.planes.visible = on;
    if (layer === 'search') this.nodes.visible = on;
  }
}
