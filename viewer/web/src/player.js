// The log's controls. The bridge plays; the page asks.

const RATES = [0.1, 0.25, 0.5, 1, 2, 4, 8];

const byId = (id) => document.getElementById(id);
const seconds = (us) => `${(us * 1e-6).toFixed(1)} s`;

export class Player {
  /** @param send  a command to the bridge */
  constructor(send) {
    this.state = null;
    const ask = (command) => send({ player: command });
    byId('play').onclick = () => this.toggle();
    byId('back').onclick = () => ask({ step: -1 });
    byId('forth').onclick = () => ask({ step: 1 });
    byId('rate').append(...RATES.map((rate) => new Option(`${rate}×`, rate, rate === 1, rate === 1)));
    byId('rate').onchange = () => ask({ speed: Number(byId('rate').value) });
    byId('scrub').oninput = () => {
      const { begin_us, end_us } = this.state;
      ask({ seek_us: Math.round(begin_us + (end_us - begin_us) * (byId('scrub').value / byId('scrub').max)) });
    };
    this.ask = ask;
  }

  toggle() {
    if (this.state) this.ask({ play: !this.state.playing });
  }

  take(state) {
    this.state = state;
    byId('player').hidden = false;
    byId('play').textContent = state.playing ? '❚❚' : '▶';
    byId('at').textContent = seconds(state.at_us - state.begin_us);
    byId('length').textContent = seconds(state.end_us - state.begin_us);
    byId('damage').textContent = state.damage || (state.refused ? `${state.refused} refused` : '');
    const scrub = byId('scrub');
    if (!scrub.matches(':active')) {
      scrub.value = (scrub.max * (state.at_us - state.begin_us)) / Math.max(state.end_us - state.begin_us, 1);
    }
  }
}
