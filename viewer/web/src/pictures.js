// The panel of pictures: per sensor its newest depths, with the boxes of its sightings, and its age; and the features of a stereo camera.
import { numbers } from './form.js';
import { aspect, BLIND_COLOR, BOUNDS, boxInPicture, depthColor, FAR_COLOR } from './projection.js';

const WIDTH = 246; // CSS pixels
const MOST_ASPECT = 4; // flatter pictures are stretched in height
export const OLD_S = 0.5; // pictures of a greater age are called old
const DOT = 1.5; // CSS pixels, half the edge of a feature
const FEATURE = '#a7f432'; // on black, in either theme, as are those on movers
const MOVING = '#ffa05c';
const LEAST_EXTENT = 0.5; // of the features in normalized coordinates, to each side

/** "0.12 s ago", or "old: 2.3 s". @param age_s  negative if the sensor's clock is ahead */
export function ageInWords(age_s) {
  return age_s > OLD_S ? `old: ${age_s.toFixed(1)} s` : `${Math.max(age_s, 0).toFixed(1)} s ago`;
}

function element(tag, className, text = '') {
  return Object.assign(document.createElement(tag), { className, textContent: text });
}

/** A titled canvas, with the age of its picture. */
class Frame {
  constructor(title) {
    this.title = element('b', '', title);
    this.age = element('span', 'dim numbers');
    this.canvas = element('canvas', '');
    this.root = element('div', 'picture');
    const head = element('div', 'row');
    head.append(this.title, this.age);
    this.root.append(head, this.canvas);
  }

  /** Returns the context of a cleared canvas, in CSS pixels. @param ratio  width over height */
  begin(ratio) {
    const pixels = window.devicePixelRatio;
    const height = Math.round(WIDTH / Math.min(ratio, MOST_ASPECT));
    Object.assign(this.canvas, { width: WIDTH * pixels, height: height * pixels });
    Object.assign(this.canvas.style, { width: `${WIDTH}px`, height: `${height}px` });
    const context = this.canvas.getContext('2d');
    context.scale(pixels, pixels);
    context.imageSmoothingEnabled = false;
    return { context, height };
  }

  showAge(age_s) {
    const text = ageInWords(age_s);
    if (this.age.textContent === text) return;
    this.age.textContent = text;
    this.root.classList.toggle('old', age_s > OLD_S);
  }
}

/** Draws the depths, one cell after the other. */
function depthPicture(sensor) {
  const { rows, columns, range } = sensor;
  const picture = Object.assign(document.createElement('canvas'), { width: columns, height: rows });
  const context = picture.getContext('2d');
  const image = context.createImageData(columns, rows);
  sensor.depths.forEach((depth, k) => image.data.set([...depthColor(depth, range), 255], 4 * k));
  context.putImageData(image, 0, 0);
  return picture;
}

function drawSensor(frame, sensor) {
  const { context, height } = frame.begin(aspect(sensor));
  if (sensor.depths.length > 0) context.drawImage(depthPicture(sensor), 0, 0, WIDTH, height);
  context.lineWidth = sensor.kind === 'camera' ? 1.5 : 1;
  for (let k = 0; k < sensor.lower.length / 3; ++k) {
    const [lower, upper] = [sensor.lower, sensor.upper].map((list) => list.slice(3 * k, 3 * k + 3));
    for (const { points, state } of boxInPicture(sensor, lower, upper, sensor.bounds.slice(6 * k, 6 * k + 6))) {
      context.strokeStyle = BOUNDS[state].color;
      context.beginPath();
      for (const [right, down] of points) context.lineTo(right * WIDTH, down * height);
      context.stroke();
    }
  }
}

/** @param features  [x, y, z, moves, right, down, …]: right and down over the distance ahead, in the left camera */
function drawFeatures(frame, features) {
  const rows = Array.from({ length: features.length / 6 }, (_, k) => features.slice(6 * k, 6 * k + 6));
  const extent = rows.reduce((most, at) => Math.max(most, Math.abs(at[4]), Math.abs(at[5])), LEAST_EXTENT);
  const { context, height } = frame.begin(4 / 3);
  context.fillStyle = BLIND_COLOR;
  context.fillRect(0, 0, WIDTH, height);
  const scale = WIDTH / 2 / extent / 1.05;
  for (const [, , , moves, right, down] of rows) {
    context.fillStyle = moves ? MOVING : FEATURE;
    context.fillRect(WIDTH / 2 + scale * right - DOT, height / 2 + scale * down - DOT, 2 * DOT, 2 * DOT);
  }
}

function legend() {
  const entries = [...BOUNDS.slice(1).map(({ says, color }) => [says, color]), ['nothing in range', FAR_COLOR], ['not measured', BLIND_COLOR]];
  const root = element('div', 'legend dim');
  for (const [name, color] of entries) {
    const swatch = element('i', '');
    swatch.style.background = color;
    const entry = element('span', '');
    entry.append(swatch, name);
    root.append(entry);
  }
  return root;
}

export class Pictures {
  constructor() {
    this.panel = document.getElementById('pictures');
    this.list = element('div', '');
    this.legend = legend();
    this.panel.append(this.list, this.legend);
    this.on = { sightings: true, estimate: true };
    this.clear();
  }

  clear() {
    this.frames = new Map();
    this.list.replaceChildren();
    this.times = new Map();
    this.waiting = new Map();
    this.look();
  }

  /** @param message  of the topic `sight`; null: none */
  take(message) {
    const sensors = message?.sensors ?? [];
    for (const { depths: list, rows, columns } of sensors) numbers(list, 1, rows * columns);
    this.keep('sensor', sensors.map(({ sensor }) => `sensor ${sensor}`));
    for (const sensor of sensors) {
      this.offer(`sensor ${sensor.sensor}`, `${sensor.kind} ${sensor.sensor}`, sensor.at_us, (frame) => drawSensor(frame, sensor));
    }
    this.look();
  }

  /** @param estimate  of the topic `estimate`; null: none */
  takeFeatures(estimate) {
    const features = numbers(estimate?.features ?? [], 6);
    this.keep('features', features.length > 0 ? ['features'] : []);
    if (features.length > 0) this.offer('features', 'stereo features', estimate.features_us, (frame) => drawFeatures(frame, features));
    this.look();
  }

  /** Removes the frames of a kind that are not named. */
  keep(kind, names) {
    for (const [name, frame] of this.frames) {
      if (!name.startsWith(kind) || names.includes(name)) continue;
      frame.root.remove();
      for (const map of [this.frames, this.times, this.waiting]) map.delete(name);
    }
  }

  offer(name, title, at_us, drawing) {
    if (!this.frames.has(name)) {
      this.frames.set(name, new Frame(title));
      this.list.append(this.frames.get(name).root);
    }
    this.frames.get(name).title.textContent = title;
    if (this.times.get(name) === at_us) return;
    this.times.set(name, at_us);
    this.waiting.set(name, drawing);
  }

  look() {
    const frames = [...this.frames];
    for (const [name, { root }] of frames) root.hidden = !this.on[name === 'features' ? 'estimate' : 'sightings'];
    this.legend.hidden = !frames.some(([name, { root }]) => name !== 'features' && !root.hidden);
    this.panel.hidden = frames.every(([, { root }]) => root.hidden);
  }

  /** Draws what is new. @param now_us  the vehicle's clock */
  draw(now_us) {
    if (this.panel.hidden) return;
    for (const [name, drawing] of this.waiting) drawing(this.frames.get(name));
    this.waiting.clear();
    for (const [name, at_us] of this.times) this.frames.get(name).showAge((now_us - at_us) * 1e-6);
  }

  show(layer, on) {
    if (!(layer in this.on)) return;
    this.on[layer] = on;
    this.look();
  }
}
