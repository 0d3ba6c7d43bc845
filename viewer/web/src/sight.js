// What sensors with a view have seen: the boxes of their sightings, and the ground under what no sensor has seen lately.
import * as THREE from 'three';
import { numbers } from './form.js';
import { palette } from './palette.js';
import { BOUNDS, boxEdges } from './projection.js';

const OLD_US = 500_000; // boxes of older frames are not drawn
const HEIGHT = 0.02; // m, of the shade above the ground

const row = (list, k, width) => list.slice(width * k, width * (k + 1));

/** Two triangles for each run of cells, [x, y, count, …]. */
export function shade(runs, cell) {
  const triangles = [];
  for (let k = 0; k < numbers(runs, 3).length / 3; ++k) {
    const [x, y, count] = row(runs, k, 3);
    const [left, right, low, high] = [x, x + count, y, y + 1].map((c) => c * cell);
    for (const corner of [[left, low], [right, low], [right, high], [left, low], [right, high], [left, high]]) triangles.push(...corner, HEIGHT);
  }
  return triangles;
}

export class Sight {
  constructor(scene) {
    this.boxes = new THREE.LineSegments(new THREE.BufferGeometry(), new THREE.LineBasicMaterial({ vertexColors: true }));
    this.shade = new THREE.Mesh(new THREE.BufferGeometry(), new THREE.MeshBasicMaterial({
      color: palette.unseen, transparent: true, opacity: palette.unseenOpacity, depthWrite: false }));
    this.shade.renderOrder = -1;
    this.colors = BOUNDS.map(({ color }) => new THREE.Color(color));
    this.on = { sightings: true, unseen: true };
    for (const object of [this.boxes, this.shade]) object.frustumCulled = false;
    scene.add(this.boxes, this.shade);
    this.clear();
  }

  clear() {
    this.take(null);
  }

  /** @param message  {at_us, sensors: [{at_us, lower, upper, bounds, …}], unseen: {cell, runs}}: flat lists; null: none */
  take(message) {
    const positions = [];
    const colors = [];
    this.count = 0;
    for (const { at_us: seen_us, lower, upper, bounds } of message?.sensors ?? []) {
      const boxes = numbers(lower, 3).length / 3;
      numbers(upper, 3, boxes);
      numbers(bounds, 6, boxes);
      if (message.at_us - seen_us > OLD_US) continue;
      for (let k = 0; k < boxes; ++k) {
        for (const { from, to, state } of boxEdges(row(lower, k, 3), row(upper, k, 3), row(bounds, k, 6))) {
          positions.push(...from, ...to);
          for (const _ of [from, to]) colors.push(...this.colors[state].toArray());
        }
      }
      this.count += boxes;
    }
    this.fill(this.boxes, { position: positions, color: colors });
    this.fill(this.shade, { position: message?.unseen ? shade(message.unseen.runs, message.unseen.cell) : [] });
    this.draw();
  }

  fill(object, attributes) {
    object.geometry.dispose();
    object.geometry = new THREE.BufferGeometry();
    for (const [name, list] of Object.entries(attributes)) object.geometry.setAttribute(name, new THREE.Float32BufferAttribute(list, 3));
  }

  draw() {
    for (const [layer, object] of [['sightings', this.boxes], ['unseen', this.shade]]) {
      object.visible = this.on[layer] && object.geometry.attributes.position.count > 0;
    }
  }

  show(layer, on) {
    if (!(layer in this.on)) return;
    this.on[layer] = on;
    this.draw();
  }
}
