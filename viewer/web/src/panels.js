// Where the panels leave the scene free.

const LEAST_SHARE = 0.2; // of the window, per axis; with less free, the scene has what is beneath the panels, too

/** {left, right, top, bottom}, CSS pixels. The inspector is not counted: who opened it closes it. */
function freeArea() {
  const { innerWidth: width, innerHeight: height } = window;
  const box = (selector) => document.querySelector(selector).getBoundingClientRect();
  const left = Math.max(box('#head').right, box('#flight').right);
  const right = box('#side').left;
  const bottom = box('footer').top;
  const wide = right - left > LEAST_SHARE * width;
  const high = bottom > LEAST_SHARE * height;
  return { left: wide ? left : 0, right: wide ? right : width, top: 0, bottom: high ? bottom : height };
}

/** Tells the free area now, and whenever window or panels change their size. */
export function watchFreeArea(tell) {
  const look = () => tell(freeArea());
  const watcher = new ResizeObserver(look);
  for (const panel of document.querySelectorAll('#head, #flight, #side, footer')) watcher.observe(panel);
  window.addEventListener('resize', look);
  look();
}
