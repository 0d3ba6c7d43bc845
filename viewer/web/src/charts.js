// The last 30 s: speed, clearance, replan time.
import uPlot from 'uplot';
import 'uplot/dist/uPlot.min.css';
import { outcomes, palette } from './palette.js';

const HEIGHT = 104;
const SPAN_S = 30;

const axis = {
  stroke: '#7f91a4',
  font: '11px system-ui, sans-serif',
  grid: { stroke: 'rgba(148,173,199,0.08)', width: 1 },
  ticks: { show: false },
};

function line(label, stroke, more = {}) {
  return { label, stroke, width: 1.5, points: { show: false }, ...more };
}

function chart(element, series, scaleY) {
  const options = {
    width: Math.max(element.clientWidth, 50),
    height: HEIGHT,
    legend: { show: false },
    cursor: { show: false },
    padding: [6, 14, 0, 0],
    scales: { x: { time: false, range: [-SPAN_S, 0] }, y: { range: scaleY } },
    axes: [
      { ...axis, size: 20, values: (_, ticks) => ticks.map((t) => (t === 0 ? 'now' : `${t} s`)) },
      { ...axis, size: 34, space: 28 },
    ],
    series: [{}, ...series],
  };
  const plot = new uPlot(options, [[], ...series.map(() => [])], element);
  new ResizeObserver(() => {
    if (element.clientWidth > 50) plot.setSize({ width: element.clientWidth, height: HEIGHT });
  }).observe(element);
  return plot;
}

function show(plot, data) {
  if (plot.root.clientWidth > 0) plot.setData(data);
}

export class Charts {
  constructor() {
    const at = (id) => document.getElementById(id);
    this.speed = chart(
      at('chart-speed'), [line('speed', palette.plan, { fill: 'rgba(92,214,255,0.10)' })],
      (_, low, high) => [0, Math.max(high ?? 0, 2) * 1.1]);
    this.clearance = chart(
      at('chart-clearance'), [line('clearance', palette.attractive, { fill: 'rgba(47,214,163,0.10)' })],
      (_, low, high) => [Math.min(low ?? 0, 0), Math.max(high ?? 0, 1) * 1.1]);
    const dot = (fill) => ({ width: 0, paths: () => null, points: { show: true, size: 4, width: 0, fill } });
    this.replan = chart(
      at('chart-replan'),
      [line('allowed', 'rgba(255,93,115,0.7)', { dash: [5, 4], width: 1 }), ...outcomes.map(dot)],
      (_, low, high) => [0, Math.max(high ?? 0, 20) * 1.1]);
  }

  /** Charts that a small window hides are left alone. @param chart  as FlightHistory::chart_json tells it */
  take({ motion, clearance, answers }) {
    show(this.speed, [motion[0], motion[1]]);
    show(this.clearance, clearance);
    const [t, ms, allowed, outcome] = answers;
    const rows = outcomes.map((_, k) => ms.map((x, i) => (outcome[i] === k ? x : null)));
    show(this.replan, [t, allowed.map((x) => (x > 0 ? x : null)), ...rows]);
  }
}
