// Rows of a flight by time: [[t…], [value…]], t ascending.

/** Returns how many of t are ≤ at. */
export function countUpTo(t, at) {
  let low = 0;
  let high = t.length;
  while (low < high) {
    const middle = (low + high) >> 1;
    if (t[middle] <= at) low = middle + 1;
    else high = middle;
  }
  return low;
}

/** Returns the newest value at that time, or null. */
export function valueAt([t, values], at) {
  const n = countUpTo(t, at);
  return n > 0 ? values[n - 1] : null;
}

/** Returns the value of a curve at that time, interpolated; null before its first point. */
export function curveAt([t, values], at) {
  const n = countUpTo(t, at);
  if (n === 0 || n === t.length || !Number.isFinite(values[n])) return n > 0 ? values[n - 1] : null;
  return values[n - 1] + ((at - t[n - 1]) / (t[n] - t[n - 1])) * (values[n] - values[n - 1]);
}

/** Returns the point of a path at that time, [x, y, z, speed], interpolated; null before and after it. */
export function placeAt({ t, curve }, at) {
  const n = countUpTo(t, at);
  if (n === 0 || (n === t.length && at > t[n - 1] + 0.1)) return null;
  const row = (k) => curve.slice(4 * k, 4 * k + 4);
  if (n === t.length) return row(n - 1);
  const share = (at - t[n - 1]) / Math.max(t[n] - t[n - 1], 1e-9);
  const next = row(n);
  return row(n - 1).map((x, k) => x + share * (next[k] - x));
}

const NEAR_PX = 6;
/** The kind of event that is shown as a tick in the timeline's band. */
export const QUIET = 'outcome';

/** Returns the nearest event within NEAR_PX of x, with other kinds before QUIET, or null. @param place  seconds → px */
export function eventNear(events, place, x) {
  const away = (event) => Math.abs(place(event.t) - x);
  const rank = (event) => away(event) + (event.kind === QUIET ? 2 * NEAR_PX : 0);
  return events.filter((event) => away(event) <= NEAR_PX).sort((a, b) => rank(a) - rank(b))[0] ?? null;
}
