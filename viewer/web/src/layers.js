// The layers, each with the colours in which it is drawn: their switches are the scene's legend.
import { palette } from './palette.js';
import { BOUNDS } from './projection.js';

const speeds = `linear-gradient(90deg, ${palette.speeds.join(', ')})`;

export const LAYERS = [
  { name: 'obstacles', on: true, says: 'moving, standing', colors: [palette.mover, palette.pillar] },
  { name: 'walls', on: true, says: 'occupied voxels of the map', colors: [palette.occupied] },
  { name: 'regions', on: true, says: 'attractive, repulsive', colors: [palette.attractive, palette.repulsive] },
  { name: 'path', on: true, says: 'flown, slow to fast', colors: [speeds] },
  { name: 'plan', on: true, says: 'the newest plan, its local goal', colors: [palette.plan, palette.goal] },
  { name: 'minvo', on: true, says: 'simplices around the plan', colors: [palette.plan] },
  { name: 'committed', on: true, says: 'the trajectory in force', colors: [palette.committed] },
  { name: 'sphere', on: true, says: 'S, in which the local goal lies', colors: [palette.sphere] },
  { name: 'hulls', on: false, says: 'where moving obstacles may be during the first second of the plan', colors: [palette.hull] },
  { name: 'tracks', on: false, says: 'detections; predicted obstacles with α, by id and age', colors: [palette.detection, palette.track] },
  { name: 'views', on: true, says: 'fields of view of the sensors, and the planned heading', colors: [palette.view] },
  { name: 'sightings', on: true, says: 'boxes of the newest sightings, and pictures of the sensors: green bounds are measured', colors: [BOUNDS[1].color, BOUNDS[2].color] },
  { name: 'unseen', on: true, says: 'ground under what no sensor has seen for a second', colors: [palette.unseen] },
  { name: 'estimate', on: true, says: 'the estimate with its 99 % bound, the true vehicle, features in view', colors: [palette.estimate, palette.truth, palette.feature] },
  { name: 'planes', on: false, says: 'of the certificate, where bounding boxes do not separate plan and obstacle', colors: [palette.plane] },
  { name: 'search', on: false, says: 'tree of the last search', colors: [palette.search] },
  { name: 'ghost', on: true, says: 'the other log', colors: [palette.ghost] },
];

/** The bridge computes these only while a page shows them. */
export const ON_DEMAND = ['hulls', 'tracks', 'planes', 'search'];

/** Makes switches for all layers. @param set  called with a name and whether it is on, at once and at every change */
export function makeSwitches(root, set) {
  for (const { name, on, says, colors } of LAYERS) {
    const row = document.createElement('label');
    row.title = says;
    row.dataset.layer = name;
    const box = Object.assign(document.createElement('input'), { type: 'checkbox', checked: on, name });
    box.onchange = () => set(name, box.checked);
    const swatches = colors.map((color) => {
      const swatch = document.createElement('i');
      swatch.style.background = color;
      return swatch;
    });
    row.append(box, name, document.createElement('b'), ...swatches);
    root.append(row);
    set(name, on);
  }
}

/** Hides a layer from the legend if this flight has no objects of it. */
export function offer(name, there) {
  document.querySelector(`[data-layer=${name}]`).hidden = !there;
}

/** Shows the number of drawn objects beside a layer's name. @param count  null: the layer is off */
export function showCount(name, count) {
  const place = document.querySelector(`[data-layer=${name}] b`);
  const text = count === null ? '' : String(count);
  if (place.textContent !== text) place.textContent = text;
}
