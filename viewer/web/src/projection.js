// What a sensor's picture shows: colours of depths and bounds, and where points and boxes of W are in it.

/** Bounds by what was seen of them, as numbered in sighting_t.lcm, and the colours of edges in picture and scene. */
export const BOUNDS = [
  { says: 'measured', color: '#2fd08a' },
  { says: 'measured', color: '#2fd08a' },
  { says: 'occluded', color: '#ff5470' },
  { says: 'cut', color: '#4db5ff' },
  { says: 'touching', color: '#f5a623' },
  { says: 'faces away', color: '#98a3b0' },
];
const [FACE, WHOLE, OCCLUDED, CUT, TOUCHING, UNSEEN] = BOUNDS.keys();
/** Of the two bounds that meet in an edge, the first of these gives its colour: that end is known the least. */
const LEAST_KNOWN = [UNSEEN, OCCLUDED, CUT, TOUCHING, WHOLE, FACE];

/** Cells within whose range nothing was, and cells that were not measured. */
export const FAR_COLOR = '#123a63';
export const BLIND_COLOR = '#000000';
const FAR = -1;
const BLIND = 0;
const BRIGHT = 236; // grey of the depth 0
const DARK = 64; // grey of the range's end

const LEAST_DEPTH = 0.05; // m: nearer points are not projected
const STEPS = 8; // lines per edge, which are curves in a lidar's picture

const rgb = (color) => [1, 3, 5].map((k) => parseInt(color.slice(k, k + 2), 16));

/** Returns red, green and blue of a cell, 0 … 255. @param decimetres  of the message `sight` @param range  m */
export function depthColor(decimetres, range) {
  if (decimetres === FAR) return rgb(FAR_COLOR);
  if (decimetres === BLIND) return rgb(BLIND_COLOR);
  const grey = Math.round(BRIGHT + (DARK - BRIGHT) * Math.min(decimetres / 10 / range, 1));
  return [grey, grey, grey];
}

/** Width over height of a picture. */
export function aspect({ kind, left, right, up, down }) {
  const size = kind === 'camera' ? Math.tan : (angle) => angle;
  return (size(left) + size(right)) / (size(up) + size(down));
}

/** Turns a vector of W into the sensor's frame C: x right, y down, z forward. @param q  w, x, y, z: turns C into W */
function toSensor([w, x, y, z], v) {
  const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
  const axis = [-x, -y, -z];
  const twice = cross(axis, v).map((c) => 2 * c);
  const turned = cross(axis, twice);
  return v.map((c, k) => c + w * twice[k] + turned[k]);
}

/** Returns [right, down] of a point of W, as shares of the picture, beyond 0 … 1 outside of it; null behind a camera. */
export function project(sensor, point) {
  const [x, y, z] = toSensor(sensor.q, point.map((c, k) => c - sensor.p[k]));
  const share = (at, low, high) => (at + low) / (low + high);
  if (sensor.kind === 'camera') {
    if (z < LEAST_DEPTH) return null;
    const { left, right, up, down } = Object.fromEntries(['left', 'right', 'up', 'down'].map((side) => [side, Math.tan(sensor[side])]));
    return [share(x / z, left, right), share(y / z, up, down)];
  }
  return [share(Math.atan2(x, z), sensor.left, sensor.right), share(Math.atan2(y, Math.hypot(x, z)), sensor.up, sensor.down)];
}

/** Returns the state of an edge, from those of the two bounds that meet in it. */
export function edgeState(one, other) {
  return LEAST_KNOWN.find((state) => state === one || state === other);
}

/**
 * Returns the twelve edges of a box as {from, to, state, faces}. @param lower  [x, y, z] @param bounds  of −x, +x, −y, +y, −z, +z
 * `faces` are the numbers of the two bounds that meet in the edge.
 */
export function boxEdges(lower, upper, bounds) {
  const edges = [];
  for (let along = 0; along < 3; ++along) {
    const [b, c] = [(along + 1) % 3, (along + 2) % 3];
    for (const sides of [[0, 0], [0, 1], [1, 0], [1, 1]]) {
      const from = [];
      from[along] = lower[along];
      from[b] = sides[0] ? upper[b] : lower[b];
      from[c] = sides[1] ? upper[c] : lower[c];
      const to = [...from];
      to[along] = upper[along];
      const faces = [2 * b + sides[0], 2 * c + sides[1]];
      edges.push({ from, to, faces, state: edgeState(...faces.map((face) => bounds[face])) });
    }
  }
  return edges;
}

/** Returns whether the outside of a face is turned to the place. */
function isFacing(face, lower, upper, place) {
  const axis = face >> 1;
  return face & 1 ? place[axis] > upper[axis] : place[axis] < lower[axis];
}

/**
 * Returns the lines of a box in the picture of the sensor that saw it: {points: [[right, down]…], state}. Edges between two faces that
 * look away from the sensor are left out. A line ends behind a camera, and at the seam of a picture all around.
 */
export function boxInPicture(sensor, lower, upper, bounds) {
  const lines = [];
  for (const { from, to, faces, state } of boxEdges(lower, upper, bounds)) {
    if (!faces.some((face) => isFacing(face, lower, upper, sensor.p))) continue;
    let last = null;
    for (let k = 0; k <= STEPS; ++k) {
      const at = project(sensor, from.map((c, axis) => c + (k / STEPS) * (to[axis] - c)));
      if (!at || !last || Math.abs(at[0] - last[0]) > (sensor.kind === 'camera' ? Infinity : 0.5)) lines.push({ points: [], state });
      if (at) lines.at(-1).points.push(at);
      last = at;
    }
  }
  return lines.filter(({ points }) => points.length > 1);
}
