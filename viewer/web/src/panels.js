// The part of the window that the panels leave free.

const LEAST_SHARE = 0.2; // of the window, per axis; with less free, the scene also uses the area below the panels
const PANELS = ['#head', '#flight', '#pictures', '#side', 'footer'];

/** {left, right, top, bottom}, CSS pixels. The inspector is ignored, since the user opens and closes it. */
function freeArea() {
  const { innerWidth: width, innerHeight: height } = window;
  const boxes = PANELS.map((selector) => document.querySelector(selector).getBoundingClientRect()).filter((box) => box.width > 0);
  const area = { left: 0, right: width, top: 0, bottom: height };
  for (const box of boxes) { // each panel is at one side of the window
    if (box.width > 0.6 * width) {
      if (box.top > height / 2) area.bottom = Math.min(area.bottom, box.top);
      else area.top = Math.max(area.top, box.bottom);
    } else if (box.left > width / 2) area.right = Math.min(area.right, box.left);
    else area.left = Math.max(area.left, box.right);
  }
  if (area.right - area.left < LEAST_SHARE * width) Object.assign(area, { left: 0, right: width });
  if (area.bottom - area.top < LEAST_SHARE * height) Object.assign(area, { top: 0, bottom: height });
  return area;
}

/** Reports the free area at once, and whenever window or panels change their size. @return {look()}, to measure at once */
export function watchFreeArea(tell) {
  const look = () => {
    document.body.style.setProperty('--foot', `${document.querySelector('footer').offsetHeight}px`);
    tell(freeArea());
  };
  const watcher = new ResizeObserver(look);
  for (const selector of PANELS) watcher.observe(document.querySelector(selector));
  window.addEventListener('resize', look);
  look();
  return { look };
}
