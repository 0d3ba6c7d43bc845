// Colours that the scene and the charts share.
import { Color } from 'three';

export const palette = {
  back: '#0b1119',
  sky: '#060a10',
  ground: '#0f161e',
  grid: '#2b3a4a',
  mover: '#ffa05c',
  pillar: '#74849a',
  plan: '#5cd6ff',
  committed: '#9d8cff',
  goal: '#ffd166',
  attractive: '#2fd6a3',
  repulsive: '#ff4d6d',
  occupied: '#7b8ea3',
  plane: '#6aa8ff',
  vehicle: '#f2f7fb',
};

/** By outcome: optimized, search only, kept, evasion, none. */
export const outcomes = ['#3ddc97', '#5cd6ff', '#8fa3b8', '#ffb454', '#ff5d73'];

// Slow to fast: indigo, blue, teal, green, yellow, white-hot.
const stops = ['#4d4fc4', '#2d86e0', '#22b8c9', '#46d98a', '#d8e35a', '#fff3b0'].map((c) => new Color(c));

/** Writes the colour of a share of the top speed, 0 … 1, to `target`. */
export function speedColor(share, target) {
  const x = Math.min(Math.max(share, 0), 1) * (stops.length - 1);
  const k = Math.min(Math.floor(x), stops.length - 2);
  return target.copy(stops[k]).lerp(stops[k + 1], x - k);
}
