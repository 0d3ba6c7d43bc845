// A second log drawn over the first: its path, and its vehicle at the same time since departure.
import * as THREE from 'three';
import { numbers } from './form.js';
import { palette } from './palette.js';
import { placeAt } from './time_rows.js';
import { Ribbon } from './trajectories.js';

export class Ghost {
  constructor(scene) {
    this.line = new Ribbon(scene, { color: palette.ghost, linewidth: 2, opacity: 0.6 });
    this.ball = new THREE.Mesh(
      new THREE.SphereGeometry(1, 20, 14), new THREE.MeshBasicMaterial({ color: palette.ghost, transparent: true, opacity: 0.75 }));
    this.ball.visible = false;
    this.wanted = true;
    scene.add(this.ball);
    this.path = null;
  }

  clear() {
    this.path = null;
    this.line.set([]);
    this.ball.visible = false;
  }

  /** @param ghost  {name, t, curve, radius}: t in seconds of the shown flight, so that both depart together */
  take(ghost) {
    numbers(ghost.curve, 4, numbers(ghost.t, 1).length);
    this.path = ghost;
    this.line.set(ghost.curve.filter((_, k) => k % 4 !== 3));
    this.ball.scale.setScalar(Math.max(ghost.radius, 0.05));
  }

  /** @param t  of the flight, s */
  draw(t) {
    const at = this.path && this.wanted ? placeAt(this.path, t) : null;
    this.ball.visible = at !== null;
    if (at) this.ball.position.set(at[0], at[1], at[2]);
  }

  show(layer, on) {
    if (layer !== 'ghost') return;
    this.wanted = this.line.material.visible = on;
  }
}
