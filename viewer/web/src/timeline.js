// The whole flight on a line: outcomes as a band, events as marks above it. A click jumps, near a mark to that mark.
import { eventNear, QUIET } from './time_rows.js';
import { palette } from './palette.js';

const BAND_PX = 6;
const INSET_PX = 8; // half a mark, and half the slider's thumb, so that click and band agree

/** Kind of event → mark and colour. */
export const MARKS = {
  goal: { mark: '▲', color: palette.goal },
  outcome: { mark: '·', color: palette.axis },
  evasion: { mark: '◆', color: palette.outcomes[3] },
  clearance: { mark: '▼', color: palette.outcomes[4] },
  stop: { mark: '■', color: palette.pillar },
  late: { mark: '✕', color: palette.outcomes[4] },
  restart: { mark: '↻', color: palette.committed },
  result: { mark: '⚑', color: palette.plan },
};

const byId = (id) => document.getElementById(id);

export class Timeline {
  /** @param jump  to a time of the flight, s */
  constructor(jump) {
    this.jump = jump;
    this.events = [];
    this.outcomes = [[], []];
    this.span = [0, 1];
    this.now = 0;
    this.hovered = null;
    this.canvas = byId('events');
    this.context = this.canvas.getContext('2d');
    this.still = document.createElement('canvas'); // the parts that do not change with time
    new ResizeObserver(() => this.redraw()).observe(byId('timeline'));
    const scrub = byId('scrub');
    scrub.addEventListener('pointermove', (event) => this.point(event.offsetX));
    scrub.addEventListener('pointerleave', () => this.point(null));
    scrub.addEventListener('click', (event) => {
      const mark = eventNear(this.events, (t) => this.place(t), event.offsetX);
      if (mark) this.jump(mark.t);
    });
  }

  place(t) {
    const [begin, end] = this.span;
    return INSET_PX + ((t - begin) / (end - begin)) * (this.canvas.clientWidth - 2 * INSET_PX);
  }

  /** @param span  begin and end of the known time, s */
  takeChart({ outcomes }, [begin, end]) {
    this.outcomes = outcomes;
    this.span = [begin, Math.max(end, begin + 0.1)];
    this.redraw();
  }

  takeEvents(events) {
    this.events = events.filter((event) => Number.isFinite(event.t) && MARKS[event.kind]);
    this.redraw();
  }

  setNow(t) {
    if (Math.abs(this.place(t) - this.place(this.now)) < 0.5) return;
    this.now = t;
    this.draw();
  }

  /** Shows the cursor of a chart. */
  hover(t) {
    if (this.hovered === t) return;
    this.hovered = t;
    this.draw();
  }

  point(x) {
    const mark = x === null ? null : eventNear(this.events, (t) => this.place(t), x);
    const tip = byId('tip');
    tip.hidden = !mark;
    if (!mark) return;
    tip.textContent = `${mark.t.toFixed(1)} s: ${mark.text}`;
    const room = this.canvas.clientWidth - tip.offsetWidth;
    tip.style.left = `${Math.max(Math.min(x - tip.offsetWidth / 2, room), 0)}px`;
  }

  /** Draws everything: another flight, more of it, or another size. */
  redraw() {
    const { canvas, still } = this;
    const [width, height] = [canvas.clientWidth, canvas.clientHeight];
    if (width === 0) return;
    const scale = window.devicePixelRatio;
    for (const each of [canvas, still]) {
      each.width = Math.round(width * scale);
      each.height = Math.round(height * scale);
      each.getContext('2d').setTransform(scale, 0, 0, scale, 0, 0);
    }
    const context = still.getContext('2d');
    this.drawBand(context, width, height - BAND_PX - 3);
    for (const event of this.events) this.drawMark(context, event, height - BAND_PX - 3);
    this.draw();
  }

  draw() {
    const { canvas, context, still } = this;
    const [width, height] = [canvas.clientWidth, canvas.clientHeight];
    if (still.width === 0 || width === 0) return;
    context.clearRect(0, 0, width, height);
    context.drawImage(still, 0, 0, width, height);
    for (const [t, color] of [[this.hovered, palette.axis], [this.now, palette.plan]]) {
      if (t === null) continue;
      context.fillStyle = color;
      context.fillRect(this.place(t) - 1, 0, 2, height);
    }
  }

  /** Draws an answer's outcome until the next answer. */
  drawBand(context, width, top) {
    const [t, kinds] = this.outcomes;
    context.fillStyle = palette.rule;
    context.fillRect(INSET_PX, top, width - 2 * INSET_PX, BAND_PX);
    for (let k = 0; k < t.length; ++k) {
      let last = k;
      while (last + 1 < t.length && kinds[last + 1] === kinds[k]) ++last;
      const from = this.place(t[k]);
      const to = this.place(last + 1 < t.length ? t[last + 1] : Math.min(t[last] + 0.1, this.span[1]));
      context.fillStyle = palette.outcomes[kinds[k]] ?? palette.axis;
      context.fillRect(from, top, Math.max(to - from, 1), BAND_PX);
      k = last;
    }
  }

  drawMark(context, { t, kind }, bottom) {
    const { mark, color } = MARKS[kind];
    context.fillStyle = color;
    if (kind === QUIET) return context.fillRect(this.place(t) - 0.5, bottom - 3, 1, 3);
    context.font = '12px system-ui, sans-serif';
    context.textAlign = 'center';
    context.fillText(mark, this.place(t), bottom - 3);
  }
}
