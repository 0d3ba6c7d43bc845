// Charts over the whole flight: several curves each, of any received field. Drag zooms all charts, double-click zooms out, a
// click jumps.
import uPlot from 'uplot';
import 'uplot/dist/uPlot.min.css';
import { label } from './labels.js';
import { palette } from './palette.js';
import { curveAt, valueAt } from './time_rows.js';

const HEIGHT = 96;
const MOST_CURVES = 6;
const MOST_CHARTS = 6;
const DEFAULT = [
  ['UAV_STATE.speed_mps'],
  ['clearance.obstacles_m', 'clearance.map_m'],
  ['PLAN_TIMING.total_ms', 'PLAN_TIMING.allowed_ms'],
];
const DOTS = new Set(['PLAN_TIMING.total_ms']); // answers, not a curve
const DRAGGED_PX = 4;

const axis = {
  stroke: palette.axis,
  font: '11px system-ui, sans-serif',
  grid: { stroke: palette.rule, width: 1 },
  ticks: { show: false },
};

function element(tag, className, text = '') {
  return Object.assign(document.createElement(tag), { className, textContent: text });
}

const brief = (x) => (Number.isFinite(x) ? Number(x.toPrecision(4)).toString() : '–');

/** One chart: a caption with its curves and their values, and a plot. */
class Chart {
  constructor(charts, names) {
    this.charts = charts;
    this.names = names;
    this.figure = element('figure', 'panel');
    this.caption = element('figcaption', '');
    this.area = element('div', 'plot');
    this.figure.append(this.caption, this.area);
    this.nowLine = element('div', 'now');
    this.watcher = new ResizeObserver(() => this.fitWidth());
    this.watcher.observe(this.area);
    this.rebuild();
  }

  fitWidth() {
    if (this.area.clientWidth > 50) this.plot.setSize({ width: this.area.clientWidth, height: HEIGHT });
    this.draw(); // needed if it was hidden
  }

  rebuild() {
    this.plot?.destroy();
    const series = this.names.map((name, k) => {
      const stroke = palette.curves[k % palette.curves.length];
      return DOTS.has(name)
        ? { label: name, stroke, paths: () => null, points: { show: true, size: 3, width: 0, fill: stroke } }
        : { label: name, stroke, width: 1.5, points: { show: false }, spanGaps: true };
    });
    const { charts } = this;
    this.plot = new uPlot({
      width: Math.max(this.area.clientWidth, 50),
      height: HEIGHT,
      legend: { show: false },
      padding: [6, 16, 0, 0],
      cursor: { sync: { key: 'flight' }, drag: { x: true, y: false, setScale: false }, points: { size: 5 }, y: false,
        bind: { dblclick: () => () => charts.zoom(null) } },
      scales: { x: { time: false, range: () => charts.range() }, y: { range: (_, low, high) => room(low, high) } },
      axes: [{ ...axis, size: 20, values: (_, ticks) => ticks.map((t) => `${t} s`) }, { ...axis, size: 38, space: 26 }],
      series: [{}, ...series],
      hooks: {
        setSelect: [(u) => u.select.width > DRAGGED_PX && charts.zoom([u.posToVal(u.select.left, 'x'), u.posToVal(u.select.left + u.select.width, 'x')])],
        setCursor: [(u) => charts.hover(u.cursor.left >= 0 ? u.posToVal(u.cursor.left, 'x') : null, this)],
      },
    }, [[], ...this.names.map(() => [])], this.area);
    this.plot.over.append(this.nowLine);
    let pressed = 0;
    this.plot.over.addEventListener('mousedown', (event) => (pressed = event.clientX));
    this.plot.over.addEventListener('click', (event) => {
      if (Math.abs(event.clientX - pressed) <= DRAGGED_PX) charts.jump(this.plot.posToVal(event.offsetX, 'x'));
    });
    this.showCaption();
    this.draw();
  }

  showCaption() {
    this.values = this.names.map(() => element('b', 'numbers'));
    const curves = this.names.map((name, k) => {
      const curve = element('button', 'curve', label(name));
      curve.title = `${name}: click to remove it`;
      curve.dataset.field = name;
      curve.style.setProperty('--color', palette.curves[k % palette.curves.length]);
      curve.append(this.values[k]);
      curve.onclick = () => this.charts.change(this, this.names.filter((other) => other !== name));
      return curve;
    });
    const add = Object.assign(element('input', 'add'), { placeholder: '+ field', type: 'text' });
    add.setAttribute('list', 'fields');
    add.setAttribute('aria-label', 'Add a curve');
    add.onchange = () => {
      const name = add.value.trim();
      add.value = '';
      if (name) this.charts.add(name, this);
    };
    this.caption.replaceChildren(...curves, ...(this.names.length < MOST_CURVES ? [add] : []));
  }

  draw() {
    if (this.plot.root.clientWidth === 0) return; // a small window hides it
    const rows = this.names.map((name) => this.charts.series[name] ?? [[], []]);
    this.plot.setData(uPlot.join(rows));
    this.showNow();
  }

  /** Shows the curves' values at t. Values that the panels show are taken from them, since a curve stores not every row. */
  read(t, shown = {}) {
    this.names.forEach((name, k) => {
      const rows = this.charts.series[name];
      const read = DOTS.has(name) ? valueAt : curveAt;
      const value = () => (name in shown ? shown[name] : read(rows, t));
      const text = rows && t !== null ? ` ${brief(value())}` : '';
      if (this.values[k].textContent !== text) this.values[k].textContent = text;
    });
  }

  showNow() {
    const x = this.plot.valToPos(this.charts.now, 'x');
    const isSeen = Number.isFinite(x) && x >= 0 && x <= this.plot.over.clientWidth;
    this.nowLine.style.display = isSeen ? '' : 'none';
    if (isSeen) this.nowLine.style.transform = `translateX(${x}px)`;
  }
}

/** The range: from 0 with room above, or below 0 if a value is. */
function room(low, high) {
  if (low === null || high === null) return [0, 1];
  const more = 0.08 * Math.max(high - low, 1e-3);
  return [low >= 0 && low < 0.6 * high ? 0 : low - more, high + more];
}

export class Charts {
  /** @param handlers  {jump(t), wants(names), hover(t)}; t in seconds of the flight */
  constructor(handlers) {
    Object.assign(this, { handlers, series: {}, span: [0, 1], now: 0, stateTime: 0, shown: {}, zoomed: null, charts: [], fields: [] });
    this.root = document.getElementById('charts');
    for (const names of DEFAULT) this.append(names);
  }

  names() {
    return [...new Set(this.charts.flatMap((chart) => chart.names))];
  }

  range() {
    const [begin, end] = this.span;
    return this.zoomed ?? [begin, Math.max(end, begin + 1)];
  }

  append(names) {
    const chart = new Chart(this, names);
    this.charts.push(chart);
    this.root.append(chart.figure);
    this.root.style.setProperty('--charts', this.charts.length);
    return chart;
  }

  /** Adds a curve, to that chart or to a new one. */
  add(name, chart) {
    if (this.fields.length > 0 && !this.fields.includes(name)) return this.handlers.unknown?.(name);
    if (chart ? chart.names.length >= MOST_CURVES : this.charts.length >= MOST_CHARTS) return;
    if (chart?.names.includes(name)) return;
    if (chart) this.change(chart, [...chart.names, name]);
    else this.append([name]);
    this.handlers.wants(this.names());
  }

  /** Adds a chart of these curves unless one of them is shown. */
  offer(names) {
    if (names.some((name) => this.names().includes(name)) || this.charts.length >= MOST_CHARTS) return;
    this.append(names);
    this.handlers.wants(this.names());
  }

  change(chart, names) {
    if (names.length === 0 && this.charts.length > 1) {
      chart.watcher.disconnect();
      chart.plot.destroy();
      chart.figure.remove();
      this.charts = this.charts.filter((other) => other !== chart);
      this.root.style.setProperty('--charts', this.charts.length);
    } else {
      chart.names = names;
      chart.rebuild();
    }
    this.handlers.wants(this.names());
  }

  /** @param chart  from FlightHistory::chart_json  @param span  begin and end of the known time, s */
  take({ series }, span) {
    for (const rows of Object.values(series)) {
      if (rows.length !== 2 || rows[0].length !== rows[1].length) throw new RangeError('not two rows of one length');
    }
    this.series = series;
    this.span = span;
    for (const chart of this.charts) chart.draw();
  }

  /** Takes the names of all fields that can be charted. */
  takeFields(names) {
    this.fields = names;
    document.getElementById('fields').replaceChildren(...names.map((name) => new Option(name)));
  }

  zoom(range) {
    this.zoomed = range;
    for (const chart of this.charts) {
      chart.plot.setSelect({ left: 0, top: 0, width: 0, height: 0 }, false);
      chart.draw();
    }
  }

  /**
   * @param t  present time of the flight, s  @param stateTime  time of the newest state, s: all numbers are of that time
   * @param shown  values of the panels, by field name
   */
  setNow(t, stateTime, shown) {
    Object.assign(this, { now: t, stateTime, shown });
    for (const chart of this.charts) {
      chart.showNow();
      if (!this.hovers) chart.read(stateTime, shown);
    }
  }

  hover(t) {
    this.hovers = t !== null;
    for (const chart of this.charts) this.hovers ? chart.read(t) : chart.read(this.stateTime, this.shown);
    this.handlers.hover(t);
  }

  jump(t) {
    this.handlers.jump(t);
  }
}
