// The pointer in the scene: picks, orbits, sends goals.
import * as THREE from 'three';

const DRAGGED_PX = 4;
const DOUBLE_MS = 350;

const distance = (event, [x, y]) => Math.hypot(event.clientX - x, event.clientY - y);

export class Pointer {
  /**
   * @param canvas, world  of the scene
   * @param does  {pick(ray), orbit(ray), aim(point)}; point: where the ray meets `height()`
   */
  constructor(canvas, world, does) {
    Object.assign(this, { world, does, aiming: false, ray: new THREE.Raycaster(), pressed: null, last: { time: -Infinity, at: [0, 0] } });
    canvas.addEventListener('pointerdown', (event) => (this.pressed = [event.clientX, event.clientY]));
    canvas.addEventListener('pointerup', (event) => this.release(event));
  }

  release(event) {
    const { pressed, ray, does } = this;
    const dragged = !pressed || distance(event, pressed) > DRAGGED_PX;
    if (dragged || event.button !== 0) return;
    const at = new THREE.Vector2((2 * event.clientX) / innerWidth - 1, 1 - (2 * event.clientY) / innerHeight);
    ray.setFromCamera(at, this.world.camera);
    const isSecond = event.timeStamp - this.last.time < DOUBLE_MS && distance(event, this.last.at) <= DRAGGED_PX;
    this.last = { time: event.timeStamp, at: [event.clientX, event.clientY] };
    if (this.aiming) return this.send();
    if (isSecond) does.orbit(ray);
    else does.pick(ray);
  }

  /** A goal is where the ray meets the height of the last goal. */
  send() {
    const plane = new THREE.Plane(new THREE.Vector3(0, 0, 1), -this.does.height());
    const at = this.ray.ray.intersectPlane(plane, new THREE.Vector3());
    if (at) this.does.aim(at);
    this.aim(false);
  }

  aim(on) {
    this.aiming = on;
    document.body.classList.toggle('aiming', on);
    document.getElementById('goalmode').classList.toggle('on', on);
  }
}
