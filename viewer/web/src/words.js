// Describes a clicked object in words.

const metres = (x) => `${x.toFixed(2)} m`;

/** @param clear  from the body, m: the bridge computes it as the referee does */
function fromBody(clear) {
  return clear < 0 ? `the vehicle overlaps it by ${metres(-clear)}` : `the vehicle is ${metres(clear)} away`;
}

function size(half) {
  return `${half.map((h) => (2 * h).toFixed(1)).join(' × ')} m`;
}

/** @param known  the newest value of each topic @param clearance  of this obstacle, m; undefined: unknown */
export function obstacleInWords(id, known, clearance) {
  const set = known.truth ?? known.tracks;
  const k = set?.id.indexOf(id) ?? -1;
  if (k < 0) return 'It has gone.';
  const row = (list) => list.slice(3 * k, 3 * k + 3);
  const speed = Math.hypot(...row(set.v));
  const parts = [`${set.moves[k] ? `Moving at ${speed.toFixed(1)} m/s` : 'Stationary'}, ${size(row(set.h))}`];
  if (Number.isFinite(clearance)) parts.push(fromBody(clearance));
  const isPredicted = known.tracks?.id.includes(id);
  if (known.tracks) parts.push(isPredicted ? 'the planner knows it from PREDICTIONS' : 'the planner does not know it: PREDICTIONS lacks it');
  const planes = (known.plan?.planes ?? []).filter((plane) => plane.track === id).length;
  if (known.plan?.planes) parts.push(`${planes === 0 ? 'no plane' : planes === 1 ? 'one plane' : `${planes} planes`} of the newest plan separate it from the vehicle`);
  return `${parts.join('; ')}.`;
}

const KINDS = { walls: 'Occupied: a wall of the map', regions: 'A region of the map' };

/** @param hit  of Regions */
export function mapInWords({ point: at, layer }, known) {
  const parts = [KINDS[layer], `here at ${at.toArray().map((x) => x.toFixed(1)).join(', ')}`];
  if (known.state) {
    const away = Math.hypot(...known.state.p.map((x, k) => at.getComponent(k) - x));
    parts.push(`${metres(away)} from the vehicle's centre`);
  }
  if (layer === 'walls' && Number.isFinite(known.state?.map_clearance)) {
    parts.push(`the vehicle's nearest wall is ${metres(known.state.map_clearance)} from its body`);
  }
  return `${parts.join('; ')}.`;
}
