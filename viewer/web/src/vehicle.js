// The vehicle to scale: a quadrotor that tilts with its acceleration, as large as the body that the planner keeps clear.
import * as THREE from 'three';
import { numbers, point } from './form.js';
import { palette } from './palette.js';

const GRAVITY = 9.81;
const LONGEST_GUESS_S = 0.12;
const MODEL_RADIUS = 0.18 * Math.SQRT2 + 0.115; // m: to the rotors' tips

export function model(color = palette.vehicle) {
  const group = new THREE.Group();
  const shell = new THREE.MeshLambertMaterial({ color, emissive: color, emissiveIntensity: 0.18 });
  const dark = new THREE.MeshLambertMaterial({ color: '#39434f', emissive: '#0d1116' });
  const body = new THREE.Mesh(new THREE.SphereGeometry(0.1, 20, 12), shell);
  body.scale.set(1.35, 0.9, 0.55);
  const nose = new THREE.Mesh(
    new THREE.SphereGeometry(0.03, 12, 8), new THREE.MeshBasicMaterial({ color: palette.plan }));
  nose.position.set(0.125, 0, 0.012);
  group.add(body, nose);
  const disc = new THREE.MeshBasicMaterial({
    color, transparent: true, opacity: 0.4, depthWrite: false, side: THREE.DoubleSide });
  for (const [sx, sy] of [[1, 1], [1, -1], [-1, 1], [-1, -1]]) {
    const arm = new THREE.Mesh(new THREE.BoxGeometry(0.25, 0.026, 0.02), dark);
    arm.position.set(0.09 * sx, 0.09 * sy, 0);
    arm.rotation.z = Math.atan2(sy, sx);
    const rotor = new THREE.Mesh(new THREE.CircleGeometry(0.115, 28), disc);
    rotor.position.set(0.18 * sx, 0.18 * sy, 0.035);
    group.add(arm, rotor);
  }
  return group;
}

export class Vehicle {
  constructor(scene) {
    this.body = model();
    this.ball = new THREE.Mesh(
      new THREE.SphereGeometry(1, 24, 16),
      new THREE.MeshBasicMaterial({ color: palette.plan, transparent: true, opacity: 0.1, depthWrite: false }));
    this.tube = new THREE.LineSegments(
      new THREE.WireframeGeometry(new THREE.SphereGeometry(1, 12, 8)),
      new THREE.LineBasicMaterial({ color: palette.committed, transparent: true, opacity: 0.35, depthWrite: false }));
    this.stem = new THREE.Line(
      new THREE.BufferGeometry().setAttribute('position', new THREE.BufferAttribute(new Float32Array(6), 3)),
      new THREE.LineBasicMaterial({ color: palette.plan, transparent: true, opacity: 0.35 }));
    this.stem.frustumCulled = false;
    this.spot = new THREE.Mesh(
      new THREE.RingGeometry(0.16, 0.2, 40),
      new THREE.MeshBasicMaterial({ color: palette.plan, transparent: true, opacity: 0.6, depthWrite: false }));
    this.group = new THREE.Group();
    this.group.add(this.body, this.ball, this.tube);
    scene.add(this.group, this.stem, this.spot);
    this.p = new THREE.Vector3();
    this.setBody([0.1, 0.1, 0.1]);
    this.clear();
  }

  clear() {
    this.state = null;
    for (const part of [this.group, this.stem, this.spot]) part.visible = false;
  }

  take(state) {
    for (const vector of [state.p, state.v, state.a]) point(vector);
    numbers([state.at_us, state.yaw], 2);
    this.state = state;
    for (const part of [this.group, this.stem, this.spot]) part.visible = true;
  }

  /**
   * @param half  half-extents of the body's box, m: the rotors reach its ends; a ball is round if the body is
   * @param tube  half-extents of the tube, m
   */
  setBody(half, tube = [0, 0, 0]) {
    const [x, y, z] = point(half).map((metres) => Math.max(metres, 0.02));
    this.ball.scale.set(x, y, z);
    const [off_x, off_y, off_z] = point(tube);
    this.tube.scale.set(x + off_x, y + off_y, z + off_z);
    this.tube.visible = Math.max(off_x, off_y, off_z) > 0;
    this.body.scale.setScalar(Math.min(x, y) / MODEL_RADIUS);
    this.reach = Math.hypot(x, y, z);
  }

  /** Hides the vehicle for a camera inside it. */
  showBody(on) {
    this.group.visible = on && this.state !== null;
  }

  draw(now_us) {
    if (!this.state) return;
    const { p, v, a, at_us, yaw } = this.state;
    const t = Math.min(Math.max((now_us - at_us) * 1e-6, 0), LONGEST_GUESS_S);
    this.p.set(...[0, 1, 2].map((k) => p[k] + v[k] * t + 0.5 * a[k] * t * t));
    this.group.position.copy(this.p);
    const up = new THREE.Vector3(a[0], a[1], a[2] + GRAVITY).normalize();
    const nose = new THREE.Vector3(Math.cos(yaw), Math.sin(yaw), 0);
    const left = new THREE.Vector3().crossVectors(up, nose).normalize();
    nose.crossVectors(left, up);
    const lean = new THREE.Quaternion().setFromRotationMatrix(new THREE.Matrix4().makeBasis(nose, left, up));
    this.body.quaternion.slerp(lean, 0.3);
    this.spot.position.set(this.p.x, this.p.y, 0.025);
    const ends = this.stem.geometry.attributes.position;
    ends.setXYZ(0, this.p.x, this.p.y, this.p.z);
    ends.setXYZ(1, this.p.x, this.p.y, 0.02);
    ends.needsUpdate = true;
  }

  hit(raycaster) {
    if (!this.state) return null;
    const near = raycaster.ray.distanceToPoint(this.p);
    const reach = Math.max(0.3, this.reach);
    return near < reach ? { distance: raycaster.ray.origin.distanceTo(this.p) - reach } : null;
  }
}
