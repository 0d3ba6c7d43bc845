// What sensors report and what the predictor makes of it: detections as boxes, tracks as boxes grown by α, with id, age and α.
import * as THREE from 'three';
import { numbers } from './form.js';
import { palette } from './palette.js';
import { placeInWindow } from './tags.js';

const LEAST_HALF = 0.05; // m: a detection without an extent is drawn this large
const MOST_TAGS = 12; // of the tracks nearest to the vehicle
const LONGEST_GUESS_S = 0.25; // positions are extrapolated by velocity for at most this long
const CORNERS = [0, 1, 2, 3, 4, 5, 6, 7].map((k) => [k & 1 ? 1 : -1, k & 2 ? 1 : -1, k & 4 ? 1 : -1]);
const EDGES = [0, 1, 2, 3, 4, 5, 6, 7, 0, 2, 1, 3, 4, 6, 5, 7, 0, 4, 1, 5, 2, 6, 3, 7];

/** Appends the edges of a box to `out`, two points each. */
function boxEdges(at, half, out) {
  for (const corner of EDGES) CORNERS[corner].forEach((side, axis) => out.push(at[axis] + side * half[axis]));
}

const row = (list, k) => list.slice(3 * k, 3 * k + 3);

/** "7, 1.2 s, α 0.34 m". @param tracks  of take() @param k  the row */
export function trackInWords(tracks, k) {
  const age = tracks.age_s[k] === null ? '' : `, ${tracks.age_s[k].toFixed(1)} s`;
  return `${tracks.id[k]}${age}, α ${Math.max(...row(tracks.alpha, k)).toFixed(2)} m`;
}

export class Tracks {
  /** @param vehicle  its position; the reference is stored */
  constructor(scene, vehicle) {
    const lines = (color, opacity) => Object.assign(
      new THREE.LineSegments(new THREE.BufferGeometry(), new THREE.LineBasicMaterial({ color, transparent: true, opacity })),
      { frustumCulled: false });
    this.boxes = lines(palette.track, 0.75);
    this.detections = lines(palette.detection, 1);
    this.group = new THREE.Group();
    this.group.add(this.boxes, this.detections);
    scene.add(this.group);
    this.vehicle = vehicle;
    this.clear();
  }

  clear() {
    this.take(null);
  }

  /**
   * @param message  {detections: {id, p, h}, tracks: {at_us, id, age_s, p, v, h, alpha}}: p, v, h, alpha are flat, three numbers
   * per row; age_s is null where it is unknown; null: none
   */
  take(message) {
    const { detections, tracks } = message ?? {};
    const found = [];
    for (let k = 0; k < numbers(detections?.p ?? [], 3).length / 3; ++k) {
      boxEdges(row(detections.p, k), row(detections.h, k).map((h) => Math.max(h, LEAST_HALF)), found);
    }
    this.fill(this.detections, found);
    for (const list of tracks ? [tracks.p, tracks.v, tracks.h, tracks.alpha] : []) numbers(list, 3, tracks.id.length);
    this.tracks = tracks ?? null;
    this.count = tracks?.id.length ?? 0;
    if (this.count === 0) this.fill(this.boxes, []);
  }

  fill(mesh, positions) {
    if (mesh.geometry.attributes.position?.array.length !== positions.length) {
      mesh.geometry.dispose();
      mesh.geometry = new THREE.BufferGeometry().setAttribute('position', new THREE.Float32BufferAttribute(positions, 3));
    } else {
      mesh.geometry.attributes.position.array.set(positions);
      mesh.geometry.attributes.position.needsUpdate = true;
    }
  }

  /**
   * Moves the tracks to the present. @param now_us  the vehicle's clock @param window  its size, CSS pixels
   * @return the tags of the nearest ones
   */
  draw(now_us, camera, window) {
    if (!this.group.visible || !this.tracks) return [];
    const { at_us, p, v, h, alpha } = this.tracks;
    const dt = Math.min(Math.max((now_us - at_us) * 1e-6, 0), LONGEST_GUESS_S);
    const positions = [];
    const tags = [];
    for (let k = 0; k < this.count; ++k) {
      const at = row(p, k).map((x, axis) => x + dt * v[3 * k + axis]);
      const half = row(h, k).map((x, axis) => x + alpha[3 * k + axis]);
      boxEdges(at, half, positions);
      const place = placeInWindow(at, camera, window);
      const away = Math.hypot(at[0] - this.vehicle.x, at[1] - this.vehicle.y, at[2] - this.vehicle.z);
      if (place) tags.push({ ...place, away, text: trackInWords(this.tracks, k) });
    }
    this.fill(this.boxes, positions);
    return tags.sort((a, b) => a.away - b.away).slice(0, MOST_TAGS);
  }

  show(layer, on) {
    if (layer === 'tracks') this.group.visible = on;
  }
}
