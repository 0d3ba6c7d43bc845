// Adapts the number of pixels per CSS pixel, for a renderer without a GPU, to measured frame times.

const FIRST_LOOK_MS = 250; // first decision after this time; until then shaders are compiled
const WINDOW_MS = 400; // between two decisions
const FEWEST_FRAMES = 3; // per decision; one is enough if frames take longer than SLOWEST_MS
const SLOWEST_MS = 150;
const SLOW_MS = 31; // 32 frames a second
const WANTED_MS = 25;
const FAST_MS = 19;
const RISE = 1.1;
const RISE_PAUSE_MS = 1500; // after a rise that had to be undone, no rise for this long
const LONG_PAUSE_MS = 60_000;
const STILL_MS = 400; // after this long without movement, the picture stands still
const LOOK_MS = 500; // a still picture is redrawn at this interval if something changed

/** Pure: the caller reports drawn frames. */
export class Quality {
  /** @param pixels  the initial number, within `fewest` … `most` */
  constructor({ pixels, fewest, most }) {
    Object.assign(this, { pixels, fewest, most, begin: null, frames: 0, risePause: RISE_PAUSE_MS });
  }

  /** Reports a drawn frame. @return the new number of pixels, or null if it stays */
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

  /** Ignores the time to the next frame, after a pause. */
  pause() {
    this.begin = null;
    this.frames = 0;
  }

  decide(mean, now) {
    let wanted = this.pixels;
    if (mean > SLOW_MS) {
      if (this.rose && now - this.rose < 2 * WINDOW_MS) this.risePause = Math.min(2 * this.risePause, LONG_PAUSE_MS);
      wanted *= Math.sqrt(WANTED_MS / mean); // the cost is that of pixels, the square
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

/** Gives a still picture all pixels, and redraws it only from time to time. Pure. */
export class Stillness {
  constructor() {
    Object.assign(this, { moved: -Infinity, drawn: -Infinity, still: false });
  }

  /**
   * Decides before a picture. @param now  ms @param moves  flight or camera moved since the last one
   * @param news  something else may look different @return true if it must be drawn; `still` then says how
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
