// The log's controls. The bridge plays; the page asks.

const RATES = [0.1, 0.25, 0.5, 1, 2, 4, 8];

const byId = (id) => document.getElementById(id);
const seconds = (s) => `${s.toFixed(1)} s`;

export class Player {
  /** @param send  a command to the bridge  @param refuse  says why there is nothing to play */
  constructor(send, refuse) {
    this.state = null;
    this.send = send;
    this.refuse = refuse;
    byId('play').onclick = () => this.toggle();
    byId('back').onclick = () => this.step(-1);
    byId('forth').onclick = () => this.step(1);
    byId('rate').append(...RATES.map((rate) => new Option(`${rate}×`, rate, rate === 1, rate === 1)));
    byId('rate').onchange = () => this.ask({ speed: Number(byId('rate').value) });
    byId('scrub').oninput = () => this.jump(this.length() * (byId('scrub').value / byId('scrub').max));
    this.take(null);
  }

  ask(command) {
    if (this.state) this.send({ player: command });
    else this.refuse('a flight that is flown cannot be wound back; when it has ended, its log can');
  }

  toggle() {
    this.ask({ play: !this.state?.playing });
  }

  /** @param plans  1: to the next answer of the planner, -1: to the last */
  step(plans) {
    this.ask({ step: plans });
  }

  /** @param t  seconds from the log's begin */
  jump(t) {
    this.ask({ seek_us: Math.round((this.state?.begin_us ?? 0) + 1e6 * t) });
  }

  length() {
    return this.state ? (this.state.end_us - this.state.begin_us) * 1e-6 : 0;
  }

  /** @param state  as LogPlayer::json tells it; null: a live flight */
  take(state) {
    this.state = state;
    document.body.classList.toggle('live', !state);
    if (!state) return;
    byId('play').textContent = state.playing ? '❚❚' : '▶';
    byId('damage').textContent = state.damage || (state.refused ? `${state.refused} refused` : '');
    this.show((state.at_us - state.begin_us) * 1e-6, this.length());
  }

  /** Where the flight is. @param at, length  s */
  show(at, length) {
    for (const [id, text] of [['at', seconds(at)], ['length', seconds(length)]]) {
      if (byId(id).textContent !== text) byId(id).textContent = text;
    }
    const scrub = byId('scrub');
    if (!scrub.matches(':active')) scrub.value = (scrub.max * at) / Math.max(length, 1e-6);
  }
}
