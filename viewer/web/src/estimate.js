// A vehicle that estimates its position: the true vehicle beside the believed one, the 99 % ellipsoid, and the features in view.
import * as THREE from 'three';
import { numbers, point } from './form.js';
import { palette } from './palette.js';
import { model } from './vehicle.js';

const LEAST_AXIS = 0.01; // m: a flatter ellipsoid is not seen
const DOT = 5; // pixels

function dots(color) {
  const points = new THREE.Points(
    new THREE.BufferGeometry(), new THREE.PointsMaterial({ color, size: DOT, sizeAttenuation: false, transparent: true, opacity: 0.9 }));
  points.frustumCulled = false;
  return points;
}

function fill(object, positions) {
  object.geometry.dispose();
  object.geometry = new THREE.BufferGeometry().setAttribute('position', new THREE.Float32BufferAttribute(positions, 3));
}

export class Estimate {
  constructor(scene) {
    const sphere = new THREE.SphereGeometry(1, 24, 16);
    this.bound = new THREE.Mesh(
      sphere, new THREE.MeshBasicMaterial({ color: palette.estimate, transparent: true, opacity: 0.16, depthWrite: false }));
    this.net = new THREE.LineSegments(
      new THREE.WireframeGeometry(new THREE.SphereGeometry(1, 14, 8)),
      new THREE.LineBasicMaterial({ color: palette.estimate, transparent: true, opacity: 0.3, depthWrite: false }));
    this.truth = model(palette.truth);
    this.error = new THREE.Line(new THREE.BufferGeometry(), new THREE.LineBasicMaterial({ color: palette.truth }));
    this.error.frustumCulled = false;
    this.features = dots(palette.feature);
    this.moving = dots(palette.mover);
    this.group = new THREE.Group();
    this.group.add(this.bound, this.net, this.truth, this.error, this.features, this.moving);
    scene.add(this.group);
    this.wanted = true;
    this.count = 0;
    this.clear();
  }

  clear() {
    this.take(null);
  }

  /**
   * @param message  {p, half, q, truth, truth_yaw, features}: the 99 % ellipsoid has the half-axes `half`, turned by the
   * quaternion q (w, x, y, z); features are [x, y, z, moves, right, down, …]; null: no valid estimate
   */
  take(message) {
    const features = numbers(message?.features ?? [], 6);
    const rows = Array.from({ length: features.length / 6 }, (_, k) => features.slice(6 * k, 6 * k + 6));
    const places = (moves) => rows.filter((row) => row[3] === moves).flatMap((row) => row.slice(0, 3));
    fill(this.features, places(0));
    fill(this.moving, places(1));
    this.count = rows.length;
    this.isThere = Boolean(message);
    this.group.visible = this.isThere && this.wanted;
    if (!message) return;
    const [w, x, y, z] = numbers(message.q, 4, 1);
    for (const part of [this.bound, this.net]) {
      part.position.set(...point(message.p));
      part.scale.set(...point(message.half).map((half) => Math.max(half, LEAST_AXIS)));
      part.quaternion.set(x, y, z, w);
    }
    this.truth.visible = this.error.visible = message.truth !== undefined;
    if (!this.truth.visible) return;
    this.truth.position.set(...point(message.truth));
    this.truth.rotation.z = message.truth_yaw;
    fill(this.error, [...message.p, ...message.truth]);
  }

  show(layer, on) {
    if (layer !== 'estimate') return;
    this.wanted = on;
    this.group.visible = this.isThere && on;
  }
}
