// The objects that a plan was checked against: predicted hulls per interval, separating planes, nodes of the search.
import * as THREE from 'three';
import { ConvexHull } from 'three/addons/math/ConvexHull.js';
import { numbers, point } from './form.js';
import { palette } from './palette.js';

const PATCH = 0.9; // half the side of a drawn plane, m
const CREASE = Math.cos(0.35); // edges between two faces at a smaller angle, rad, are not drawn

/** Appends the edges of a convex hull to `out`, two points each; not those between triangles of one face or of a curved one. */
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
      new THREE.BufferGeometry(), new THREE.LineBasicMaterial({ color: palette.hull, transparent: true, opacity: 0.6, depthWrite: false }));
    this.hulls.name = 'hulls';
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

  fill(mesh, positions) {
    mesh.geometry.dispose();
    mesh.geometry = new THREE.BufferGeometry();
    mesh.geometry.setAttribute('position', new THREE.Float32BufferAttribute(positions, 3));
  }

  /** Draws an outline per track, around its hulls. @param message  {hulls: [{track, interval, points}]}; points flat; null: none */
  takeHulls(message) {
    const byTrack = new Map();
    for (const { track, points } of message?.hulls ?? []) {
      numbers(points, 3);
      if (!byTrack.has(track)) byTrack.set(track, []);
      for (let k = 0; k < points.length; k += 3) byTrack.get(track).push(new THREE.Vector3().fromArray(points, k));
    }
    const positions = [];
    for (const points of byTrack.values()) if (points.length >= 4) outline(points, positions);
    this.counts.hulls = byTrack.size;
    this.fill(this.hulls, positions);
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
