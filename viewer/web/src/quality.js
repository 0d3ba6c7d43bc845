// How many pixels per CSS pixel a renderer without a GPU is given: as many as it can pay for, found by measured time.

const FIRST_LOOK_MS = 250; // after that many, the first decision; until then shaders are compiled
const WINDOW_MS = 400; // between two looks
const FEWEST_FRAMES = 3; // of a look; of a look at a renderer that takes longer than SLOWEST_MS each, one is enough
const SLOWEST_MS = 150;
const SLOW_MS = 31; // 32 frames a second
const WANTED_MS = 25;
const FAST_MS = 19;
const RISE = 1.1;
const RISE_PAUSE_MS = 1500; // a rise that did not pay is not tried at every look
const LONG_PAUSE_MS = 60_000;
const STILL_MS = 400; // so long without a movement: it stands still
const LOOK_MS = 500; // what stands still is drawn again after that

/** Pure: it is told when frames were drawn. */
export class Quality {
  /** @param pixels  to begin with; `fewest` … `most` */
  constructor({ pixels, fewest, most }) {
    Object.assign(this, { pixels, fewest, most, begin: null, frames: 0, risePause: RISE_PAUSE_MS });
  }

  /** A frame was drawn. @return the new number of pixels, or null while it stays */
  frame(now) {
    this.begin ??= now + FIRST_LOOK_MS;
    if (now < this.begin) return null;
    const span = now - this.begin;
    const mean = this.frames > 0 ? span / this.frames : 0;
    this.frames += 1;
    const enough = mean > SLOWEST_MS || (span >= WINDOW_MS && this.frames > FEWEST_FRAMES);
    if (this.frames < 2 || !enough) return null;
    this.begin = now;
    this.frames = 1;
    return this.decide(mean, now);
  }

  /** The next frame says nothing of how long the last one took. */
  pause() {
    this.begin = null;
    this.frames = 0;
  }

  decide(mean, now) {
    let wanted = this.pixels;
    if (mean > SLOW_MS) {
      if (this.rose && now - this.rose < 2 * WINDOW_MS) this.risePause = Math.min(2 * this.risePause, LONG_PAUSE_MS);
      wanted *= Math.sqrt(WANTED_MS / mean); // what is paid for is pixels, the square
      this.changed = now;
    } else if (mean < FAST_MS && now - (this.changed ?? -Infinity) > this.risePause) {
      wanted *= RISE;
      this.changed = this.rose = now;
    }
    wanted = Math.min(Math.max(wanted, this.fewest), this.most);
    if (Math.abs(wanted - this.pixels) < 0.01) return null;
    return (this.pixels = wanted);
  }
}

/** What stands still gets every pixel, and is drawn only now and then. Pure. */
export class Stillness {
  constructor() {
    Object.assign(this, { moved: -Infinity, drawn: -Infinity, still: false });
  }

  /**
   * Before a picture. @param now  ms @param moves  whether flight or camera moved since the last one
   * @param news  whether anything else may look different @return whether it must be drawn; then `still` says how
   */
  isDue(now, moves, news) {
    if (moves) this.moved = now;
    const was = this.still;
    this.still = now - this.moved >= STILL_MS;
    if (this.still && was && !news && now - this.drawn < LOOK_MS) return false;
    this.drawn = now;
    return true;
  }
}
