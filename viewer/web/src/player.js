// The controls of a log. The bridge plays it; the page sends commands.
import { say } from './hud.js';

const RATES = [0.1, 0.25, 0.5, 1, 2, 4, 8];
const REACHED_S = 0.1;

const byId = (id) => document.getElementById(id);
const seconds = (s) => `${(Math.round(10 * s) / 10).toFixed(1)} s`; // avoids -0.0

export class Player {
  /** @param send  sends a command to the bridge  @param refuse  explains why nothing can be played */
  constructor(send, refuse) {
    this.state = null;
    this.rest = undefined; // the time that it is on its way to, s of the flight
    this.send = send;
    this.refuse = refuse;
    byId('play').onclick = () => this.toggle();
    byId('back').onclick = () => this.step(-1);
    byId('forth').onclick = () => this.step(1);
    byId('rate').append(...RATES.map((rate) => new Option(`${rate}×`, rate, rate === 1, rate === 1)));
    byId('rate').onchange = () => this.ask({ speed: Number(byId('rate').value) });
    byId('scrub').oninput = () => {
      const [begin, end] = this.span();
      this.jump(begin + (end - begin) * (byId('scrub').value / byId('scrub').max));
    };
    this.take(null);
  }

  ask(command) {
    this.rest = undefined;
    if (this.state) this.send({ player: command });
    else this.refuse('a live flight cannot be rewound; play its log afterwards');
  }

  toggle() {
    this.ask({ play: !this.state?.playing });
  }

  /** @param plans  1: to the next answer of the planner, -1: to the previous */
  step(plans) {
    this.ask({ step: plans });
  }

  /** @param t  seconds of the flight */
  jump(t) {
    this.ask({ seek_us: Math.round((this.state?.zero_us ?? 0) + 1e6 * t) });
  }

  /** Pauses at this time, or at the nearest end of the log. @param t  seconds of the flight */
  restAt(t) {
    this.ask({ play: false }); // first, because playing would leave that time
    this.jump(t);
    const [begin, end] = this.span();
    this.rest = Math.min(Math.max(t, begin), end);
  }

  /** Seconds of the flight; on the way to another time, that one. Undefined: nothing is played. */
  now() {
    if (!this.state) return undefined;
    const now = (this.state.at_us - this.state.zero_us) * 1e-6;
    if (Math.abs(now - this.rest) < REACHED_S) this.rest = undefined;
    return this.rest ?? now;
  }

  /** Begin and end of the log, seconds of the flight. */
  span() {
    const { begin_us: begin, zero_us: zero, end_us: end } = this.state ?? { begin_us: 0, zero_us: 0, end_us: 0 };
    return [(begin - zero) * 1e-6, (end - zero) * 1e-6];
  }

  /** @param state  from LogPlayer::json; null: a live flight */
  take(state) {
    this.state = state;
    document.body.classList.toggle('live', !state);
  }

  /** Shows the position in the log. */
  draw() {
    const { state } = this;
    say('play', state.playing ? '❚❚' : '▶');
    say('damage', state.damage || (state.refused ? `${state.refused} refused` : ''));
    this.show((state.at_us - state.zero_us) * 1e-6, this.span());
  }

  /** Shows the time of a live flight. @param at  s  @param span  begin and end of the known time, s */
  show(at, [begin, end]) {
    say('at', seconds(at));
    say('length', seconds(end));
    const scrub = byId('scrub');
    if (!scrub.matches(':active')) scrub.value = (scrub.max * (at - begin)) / Math.max(end - begin, 1e-6);
  }
}
