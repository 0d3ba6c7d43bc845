// Where the vehicle looks: the field of view of each sensor, and the planned heading along the plan.
import * as THREE from 'three';
import { numbers } from './form.js';
import { palette } from './palette.js';

const TICK = 0.7; // m, length of a line that shows a yaw
const BARB = 0.22; // m, of its arrowhead

/** [x, y, z, yaw, …] → arrows, two points per line. */
export function arrows(heading) {
  const lines = [];
  for (let k = 0; k < numbers(heading, 4).length; k += 4) {
    const [x, y, z, yaw] = heading.slice(k, k + 4);
    const tip = [x + TICK * Math.cos(yaw), y + TICK * Math.sin(yaw), z];
    lines.push(x, y, z, ...tip);
    for (const turn of [2.6, -2.6]) {
      lines.push(...tip, tip[0] + BARB * Math.cos(yaw + turn), tip[1] + BARB * Math.sin(yaw + turn), z);
    }
  }
  return lines;
}

export class Views {
  constructor(scene) {
    const lines = (color, opacity) => Object.assign(
      new THREE.LineSegments(
        new THREE.BufferGeometry(), new THREE.LineBasicMaterial({ color, transparent: true, opacity, depthWrite: false })),
      { frustumCulled: false });
    this.outlines = lines(palette.view, 0.55);
    this.heading = lines(palette.view, 1);
    this.group = new THREE.Group();
    this.group.add(this.outlines, this.heading);
    scene.add(this.group);
    this.clear();
  }

  clear() {
    this.take(null);
  }

  /** @param message  {heading: [x, y, z, yaw, …], views: [{sensor, lines}]}: lines are flat, two points each; null: none */
  take(message) {
    this.fill(this.heading, arrows(message?.heading ?? []));
    this.fill(this.outlines, (message?.views ?? []).flatMap((view) => numbers(view.lines, 6)));
  }

  fill(lines, positions) {
    lines.geometry.dispose();
    lines.geometry = new THREE.BufferGeometry().setAttribute('position', new THREE.Float32BufferAttribute(positions, 3));
    lines.visible = positions.length > 0;
  }

  show(layer, on) {
    if (layer === 'views') this.group.visible = on;
  }
}
