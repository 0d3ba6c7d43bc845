// Plays a flight that is in the page itself (tern-viewer --export), without a bridge. It answers the same commands as a
// bridge's log player.
import { countUpTo } from './time_rows.js';

const NO_DETAIL = 'this file does not contain the messages; tern-viewer --log shows them';

/** Returns the tape of this page, or null. It is base64 of a deflated JSON text. */
export async function readTape() {
  const element = document.getElementById('tape');
  if (!element) return null;
  const packed = await (await fetch(`data:application/octet-stream;base64,${element.textContent.trim()}`)).blob();
  return new Response(packed.stream().pipeThrough(new DecompressionStream('deflate-raw'))).json();
}

export class Tape {
  /**
   * @param tape  {begin_us, zero_us, end_us, still: {topic: value}, rows: {topic: [[at_us…], [value…]]}}
   * @param handlers  as of a Stream
   */
  constructor(tape, handlers, clock = () => performance.now()) {
    Object.assign(this, { tape, handlers, clock, at: tape.begin_us, playing: true, speed: 1, shown: {}, frame: 0 });
    this.wall = clock();
  }

  /** Sends the constant topics first. */
  open() {
    this.handlers.open();
    this.handlers.frame({ frame: ++this.frame, dropped: 0, ...this.tape.still, player: this.player() });
  }

  player() {
    const { begin_us, zero_us, end_us, damage } = this.tape;
    const { at, playing, speed } = this;
    return { begin_us, zero_us, end_us, at_us: at, playing, speed, refused: 0, damage: damage ?? '' };
  }

  send(command) {
    if (command.player) this.play(command.player);
    if (command.pick) this.handlers.reply({ detail: { title: command.pick.name ?? command.pick.kind, messages: [], note: NO_DETAIL } });
    if (command.goal) this.handlers.reply({ goal: { refused: 'this is a recorded flight' } });
  }

  play({ play, seek_us: seek, step, speed }) {
    this.advance();
    const { begin_us, end_us, rows } = this.tape;
    if (speed !== undefined) this.speed = speed;
    if (play !== undefined) {
      if (play && this.at >= end_us) this.at = begin_us;
      this.playing = play;
    }
    if (seek !== undefined) this.at = Math.min(Math.max(seek, begin_us), end_us);
    if (step === undefined || !rows.plan) return;
    const [plans] = rows.plan;
    const next = step > 0 ? countUpTo(plans, this.at) : countUpTo(plans, this.at - 1) - 1;
    if (next < 0 || next >= plans.length) return;
    this.at = plans[next];
    this.playing = false;
  }

  advance() {
    const now = this.clock();
    if (this.playing) this.at = Math.min(this.at + (now - this.wall) * 1e3 * this.speed, this.tape.end_us);
    if (this.at >= this.tape.end_us) this.playing = false;
    this.wall = now;
  }

  /** Before each picture: sends the topics that have changed. */
  drawn() {
    this.advance();
    const frame = {};
    for (const [topic, [at, values]] of Object.entries(this.tape.rows)) {
      const k = countUpTo(at, this.at) - 1;
      if (k === (this.shown[topic] ?? -1)) continue;
      this.shown[topic] = k;
      frame[topic] = k < 0 ? null : values[k];
    }
    const player = this.player();
    const sent = JSON.stringify(player);
    if (sent === this.sent && Object.keys(frame).length === 0) return;
    this.sent = sent;
    this.handlers.frame({ frame: ++this.frame, dropped: 0, ...frame, player });
  }
}
