// The cameras. Chase and first person turn with the flight; top and side are orthographic. These four follow the vehicle,
// an orbit follows an obstacle, and the free camera stays.
import * as THREE from 'three';
import { OrbitControls } from 'three/addons/controls/OrbitControls.js';

const CHASE = { behind: 5, right: 1.2, above: 3.8, ahead: 2.2 }; // of the vehicle, m
const ORBIT = { back: 5, above: 2.5 };
const EYE_ABOVE = 0.16; // above the vehicle's centre, first person: shows the plan from above
const FAR_AWAY = 120; // of an orthographic camera, m
const SPAN = 16; // metres of the free height that an orthographic camera shows at zoom 1
const TURNS = 1.8; // 1/s: rate at which a camera turns to the flight's heading
const MOVES = 7; // 1/s
const LEAST_SPEED = 0.4; // m/s; below this, a heading is noise
const JUMP = 12; // m; a larger step is a jump in a log
const LOWEST = 0.495 * Math.PI; // a perspective camera stays above the ground

/** Margin around the target, in window heights: the vehicle is within 0.3 of the middle. */
const SHOWN = { width: 0.72, height: 0.5 };

const angleOf = (x, y) => Math.atan2(y, x);
const wrapped = (angle) => Math.atan2(Math.sin(angle), Math.cos(angle));
const UP = new THREE.Vector3(0, 0, 1);

export class Cameras {
  constructor(canvas) {
    this.perspective = new THREE.PerspectiveCamera(46, 1, 0.05, 400);
    this.flat = new THREE.OrthographicCamera(-1, 1, 1, -1, 0.1, 2 * FAR_AWAY + 200);
    this.camera = this.perspective;
    this.controls = new OrbitControls(this.perspective, canvas);
    this.controls.enableDamping = true;
    this.controls.dampingFactor = 0.12;
    this.controls.maxDistance = 150;
    this.controls.target.set(2.5, 0, 1);
    this.mode = 'chase';
    this.course = 0; // of the whole flight, rad
    this.heading = 0; // of the present motion
    this.seen = null; // last position of the followed object
    this.moved = () => {}; // called when the user has changed the view
    this.controls.addEventListener('end', () => this.moved());
    this.place();
  }

  /** Sets the part of the window that no panel covers, CSS pixels. The target is in its middle. */
  setFree(free, width, height) {
    const wide = free.right - free.left;
    const high = free.bottom - free.top;
    const shift = [(width - free.left - free.right) / 2, (height - free.top - free.bottom) / 2];
    this.perspective.zoom = Math.min(1, wide / (SHOWN.width * height), high / (SHOWN.height * height));
    this.perspective.aspect = width / height;
    const scale = SPAN / Math.min(high, wide); // metres per pixel
    this.shown = { wide: scale * wide, high: scale * high };
    const metres = (scale * height) / 2;
    Object.assign(this.flat, { top: metres, bottom: -metres, left: (-metres * width) / height, right: (metres * width) / height });
    for (const camera of [this.perspective, this.flat]) camera.setViewOffset(width, height, ...shift, width, height);
  }

  /** @param mode  of link.js's MODES, or 'orbit'  @param eye  of a free camera: its place and its target, six numbers */
  set(mode, eye) {
    if (mode === 'free' && this.camera === this.flat) { // starts from the view of top or side
      const back = this.flat.position.clone().sub(this.controls.target).setLength(SPAN);
      this.perspective.position.copy(this.controls.target).add(back);
    }
    this.mode = mode;
    this.isStill = mode === 'free';
    const isFlat = mode === 'top' || mode === 'side';
    this.camera = isFlat ? this.flat : this.perspective;
    this.controls.object = this.camera;
    this.controls.enabled = mode !== 'first';
    this.controls.enableRotate = !isFlat;
    this.controls.maxPolarAngle = isFlat ? Math.PI : LOWEST;
    this.perspective.fov = mode === 'first' ? 70 : 46;
    if (isFlat) this.flat.zoom = 1;
    this.camera.updateProjectionMatrix();
    if (eye) {
      this.camera.position.fromArray(eye);
      this.controls.target.fromArray(eye, 3);
    } else {
      this.place();
    }
    this.seen = null;
  }

  /** Returns the camera's position and its target, six numbers. */
  eye() {
    return [...this.camera.position.toArray(), ...this.controls.target.toArray()];
  }

  place() {
    const { target } = this.controls;
    if (this.vehicle && ['chase', 'top', 'side', 'first'].includes(this.mode)) target.copy(this.aimed());
    const offset = this.offset();
    if (offset) this.camera.position.copy(target).add(offset);
  }

  /** Returns the camera's position relative to its target; nothing for a free camera, which stays. */
  offset() {
    const [c, s] = [Math.cos(this.heading), Math.sin(this.heading)];
    const along = (x, right, z) => new THREE.Vector3(x * c + right * s, x * s - right * c, z);
    switch (this.mode) {
      case 'chase': return along(-CHASE.behind - CHASE.ahead, CHASE.right, CHASE.above);
      case 'orbit': return along(-ORBIT.back, 0, ORBIT.above);
      case 'top': return new THREE.Vector3(0, -1e-3, FAR_AWAY);
      case 'side': return new THREE.Vector3(Math.sin(this.course), -Math.cos(this.course), 0).multiplyScalar(FAR_AWAY);
      default: return null;
    }
  }

  /** Returns the target of a camera that follows the vehicle. */
  aimed() {
    const ahead = this.mode === 'chase' ? CHASE.ahead : 0;
    return this.vehicle.clone().add(new THREE.Vector3(ahead * Math.cos(this.heading), ahead * Math.sin(this.heading), 0));
  }

  /** Sets the course of the whole flight; the side camera looks across it. */
  head(from, to) {
    if (Math.hypot(to[0] - from[0], to[1] - from[1]) < 1 || this.coursed) return;
    this.coursed = true;
    this.course = angleOf(to[0] - from[0], to[1] - from[1]);
    if (!this.flying) this.heading = this.course;
    this.set(this.mode, this.mode === 'free' ? this.eye() : undefined);
  }

  /** Forgets the course, for another flight. */
  clear() {
    this.coursed = this.flying = false;
    this.seen = this.vehicle = null;
  }

  /**
   * Updates the camera. The vehicle is at p with velocity v; `centre` is that of an orbited obstacle, if any.
   * @param seconds  since the last call
   */
  follow(p, v, centre, seconds) {
    const jumped = !this.vehicle || this.vehicle.distanceTo(p) > JUMP;
    this.vehicle = (this.vehicle ?? new THREE.Vector3()).copy(p);
    this.turn(v, jumped ? Infinity : seconds);
    if (this.mode === 'first') return this.sit(p);
    if (this.isStill || (this.mode === 'orbit' && !centre)) return;
    const aim = this.mode === 'orbit' ? centre : this.aimed();
    if (!this.seen) this.seen = this.controls.target.clone();
    const share = aim.distanceTo(this.seen) > JUMP ? 1 : 1 - Math.exp(-seconds * MOVES);
    const move = aim.clone().sub(this.seen).multiplyScalar(share);
    this.seen.add(move);
    this.controls.target.add(move);
    this.camera.position.add(move);
  }

  /** Follows the flight's heading, and turns a chase camera with it. */
  turn(v, seconds) {
    if (Math.hypot(v[0], v[1]) < LEAST_SPEED) return;
    this.flying = true;
    const change = wrapped(angleOf(v[0], v[1]) - this.heading) * (1 - Math.exp(-seconds * TURNS));
    this.heading = wrapped(this.heading + change);
    if (this.mode !== 'chase') return;
    const offset = this.camera.position.clone().sub(this.controls.target).applyAxisAngle(UP, change);
    this.camera.position.copy(this.controls.target).add(offset);
  }

  sit(p) {
    this.camera.position.set(p.x, p.y, p.z + EYE_ABOVE);
    this.controls.target.set(p.x + 4 * Math.cos(this.heading), p.y + 4 * Math.sin(this.heading), p.z - 0.25);
    this.camera.lookAt(this.controls.target);
  }

  /** Shows a whole box from the present direction, and follows nothing. */
  fit(box) {
    if (box.isEmpty()) return;
    const middle = box.getCenter(new THREE.Vector3());
    const back = this.camera.position.clone().sub(this.controls.target).normalize();
    if (this.camera === this.flat) {
      const size = box.getSize(new THREE.Vector3());
      const [c, s] = [Math.abs(Math.cos(this.course)), Math.abs(Math.sin(this.course))];
      const [wide, high] = this.mode === 'top' ? [size.x, size.y] : [c * size.x + s * size.y, size.z];
      this.flat.zoom = 0.9 * Math.min(this.shown.wide / Math.max(wide, 1), this.shown.high / Math.max(high, 1));
      this.flat.updateProjectionMatrix();
      this.controls.target.copy(middle);
      this.camera.position.copy(middle).addScaledVector(back, FAR_AWAY);
      this.isStill = true;
    } else {
      const radius = box.getSize(new THREE.Vector3()).length() / 2;
      const half = THREE.MathUtils.degToRad(this.perspective.fov / 2);
      back.z = Math.max(back.z, 0.5);
      back.setLength(Math.min(radius / (Math.sin(half) * this.perspective.zoom), this.controls.maxDistance));
      this.set('free', [...middle.clone().add(back).toArray(), ...middle.toArray()]);
    }
    this.moved();
  }

  update() {
    if (this.mode !== 'first') this.controls.update();
    this.camera.updateMatrixWorld();
  }
}
