// Colours of scene and charts, dark or light: ?theme=light, otherwise the user's system decides.
import { Color } from 'three';

const dark = {
  back: '#0b1119',
  sky: '#060a10',
  horizon: '#101b28',
  ground: '#0f161e',
  grid: '#2b3a4a',
  faint: '#18222c',
  mover: '#ffa05c',
  pillar: '#74849a',
  plan: '#5cd6ff',
  committed: '#9d8cff',
  goal: '#ffd166',
  attractive: '#2fd6a3',
  repulsive: '#ff4d6d',
  occupied: '#8797a8',
  sphere: '#8fb8dd',
  hull: '#c2ef6b',
  track: '#e4edf7',
  detection: '#ff5ce1',
  plane: '#6aa8ff',
  search: '#c7b6ff',
  view: '#ffe9a8',
  unseen: '#b06bd0',
  unseenOpacity: 0.16,
  vehicle: '#f2f7fb',
  ghost: '#ff8fd0',
  estimate: '#5cd6ff',
  truth: '#ff5d73',
  feature: '#a7f432',
  picked: '#ffffff',
  shadow: 'rgba(0,0,0,0.62)',
  axis: '#7f91a4',
  rule: 'rgba(148,173,199,0.08)',
  /** By outcome: optimized, search only, kept, evasion, none. */
  outcomes: ['#3ddc97', '#5cd6ff', '#8fa3b8', '#ffb454', '#ff5d73'],
  /** Of a chart, in turn. */
  curves: ['#5cd6ff', '#ffb454', '#3ddc97', '#9d8cff', '#ff5d73', '#ffd166'],
  // Slow to fast: indigo, blue, teal, green, yellow, white-hot.
  speeds: ['#4d4fc4', '#2d86e0', '#22b8c9', '#46d98a', '#d8e35a', '#fff3b0'],
};

const light = {
  ...dark,
  back: '#eef2f6',
  sky: '#cfdeed',
  horizon: '#dfe8f1',
  ground: '#e6ebf0',
  grid: '#b3c0cd',
  faint: '#d5dde5',
  mover: '#e07b00',
  pillar: '#8e9bab',
  plan: '#0086c4',
  committed: '#6a4fd6',
  goal: '#d99500',
  attractive: '#0fa678',
  repulsive: '#e0234a',
  occupied: '#a3afbc',
  sphere: '#5d86ad',
  hull: '#5d8a00',
  track: '#2b3a49',
  detection: '#b8008f',
  plane: '#2b6fd6',
  search: '#8a70d6',
  view: '#8a6a00',
  unseen: '#5b3a78',
  unseenOpacity: 0.16,
  vehicle: '#27323d',
  ghost: '#c2188a',
  estimate: '#0086c4',
  truth: '#d92340',
  feature: '#3f8f00',
  picked: '#111820',
  shadow: 'rgba(30,45,60,0.32)',
  axis: '#5b6b7b',
  rule: 'rgba(40,60,80,0.10)',
  outcomes: ['#17a86b', '#0086c4', '#8595a6', '#e08a00', '#d92340'],
  curves: ['#0086c4', '#d97706', '#17a86b', '#6a4fd6', '#d92340', '#a17800'],
  speeds: ['#4143b0', '#1f74cc', '#0f98a8', '#1f9e58', '#9a9a00', '#d06a00'],
};

const asked = new URLSearchParams(location.search).get('theme');
export const theme = asked ?? (matchMedia('(prefers-color-scheme: light)').matches ? 'light' : 'dark');
export const palette = theme === 'light' ? light : dark;
document.documentElement.dataset.theme = theme === 'light' ? 'light' : 'dark';

let stops = null; // made when the renderer has defined its colour space (World)

/** Writes the colour of a speed, as a share 0 … 1 of the top speed, to `target`. */
export function speedColor(share, target) {
  stops ??= palette.speeds.map((c) => new Color(c));
  const x = Math.min(Math.max(share, 0), 1) * (stops.length - 1);
  const k = Math.min(Math.floor(x), stops.length - 2);
  return target.copy(stops[k]).lerp(stops[k + 1], x - k);
}

/** Returns the address of this page in the other theme, at the same time and camera. */
export function otherTheme() {
  const url = new URL(location.href);
  url.searchParams.set('theme', theme === 'light' ? 'dark' : 'light');
  return url.href;
}
