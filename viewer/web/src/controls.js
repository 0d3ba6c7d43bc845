// Buttons, keys and the link of the page.
import { MODES, readLink, writeLink } from './link.js';
import { otherTheme, theme } from './palette.js';

const LINK_EVERY_MS = 1000; // browsers refuse more

const byId = (id) => document.getElementById(id);

/** Clicked controls give the keys back, since space and arrows belong to the player. Controls reached by Tab keep them. */
function giveBackKeys() {
  const isMouse = (event) => event.detail > 0 || event.type === 'change';
  for (const kind of ['click', 'change']) {
    document.addEventListener(kind, (event) => {
      const isWritten = event.target.matches('input[type=text]');
      if (isMouse(event) && !isWritten) document.activeElement?.blur();
    });
  }
}

/** @param actions  by key */
function listen(actions) {
  window.addEventListener('keydown', (event) => {
    const isTyped = event.target.matches('input[type=text], select');
    const isPressed = event.key === ' ' && event.target.matches('button, input');
    const action = isTyped || isPressed || event.ctrlKey || event.metaKey || event.altKey ? null : actions[event.key];
    if (!action) return;
    event.preventDefault();
    action();
  });
}

export class Controls {
  /**
   * @param cameras  Cameras
   * @param does  {fit(), hasPath(), toggle(), step(n), restAt(t), cut(share), goal(mode), aim(), escape(),
   *   now(): seconds of a log or undefined, say(text), changed()}
   */
  constructor(cameras, does) {
    this.cameras = cameras;
    this.does = does;
    this.written = 0;
    this.hash = location.hash; // as last written or followed
    this.buttons = [...document.querySelectorAll('[data-camera]')];
    for (const button of this.buttons) button.onclick = () => this.setCamera(button.dataset.camera);
    byId('fit').onclick = () => this.fit();
    cameras.moved = () => this.writeLink();
    byId('goalmode').onclick = () => does.aim();
    byId('hold-goal').onclick = () => does.goal('hold');
    byId('stop-goal').onclick = () => does.goal('stop');
    byId('cut').oninput = () => does.cut(byId('cut').value / byId('cut').max);
    byId('theme').textContent = theme === 'light' ? 'dark' : 'light';
    byId('theme').onclick = () => {
      this.writeAddress();
      location.assign(otherTheme());
    };
    byId('link').onclick = () => this.copy();
    byId('menu').onclick = () => this.showMenu(!document.body.classList.contains('menu'));
    byId('showcharts').onclick = () => {
      document.body.classList.toggle('charts');
      this.showMenu(false); // the menu covers the charts
    };
    giveBackKeys();
    const camera = Object.fromEntries(MODES.map((mode, k) => [k + 1, () => this.setCamera(mode)]));
    listen({
      ...camera, f: () => this.fit(), g: () => does.aim(), Escape: () => does.escape(), ' ': () => does.toggle(),
      ArrowLeft: () => does.step(-1), ArrowRight: () => does.step(1),
    });
    window.addEventListener('hashchange', () => this.follow());
  }

  /** For a phone. */
  showMenu(on) {
    document.body.classList.toggle('menu', on);
    byId('menu').setAttribute('aria-expanded', on);
    this.does.changed();
  }

  setCamera(mode, eye) {
    this.cameras.set(mode, eye);
    this.showCamera();
    this.writeLink();
  }

  fit() {
    this.does.fit();
    this.showCamera();
  }

  /** The flight's path is known, so a link may now show all of it. */
  pathIsKnown() {
    if (this.isAskedToFit) this.fit();
    this.isAskedToFit = false;
  }

  showCamera() {
    for (const button of this.buttons) button.classList.toggle('on', button.dataset.camera === this.cameras.mode);
  }

  /** Follows the address. */
  follow() {
    this.hash = location.hash;
    const { t, cam, eye } = readLink(this.hash);
    this.isAskedToFit = cam === 'fit';
    if (this.does.hasPath()) this.pathIsKnown();
    if (t !== undefined) this.does.restAt(t);
    if (cam && cam !== 'fit') this.setCamera(cam, eye);
  }

  address() {
    const { mode } = this.cameras;
    const isKnown = MODES.includes(mode);
    return writeLink({
      t: this.does.now() ?? readLink(location.hash).t, // until the log is there, the time in the address
      cam: isKnown ? mode : 'free',
      eye: mode === 'free' || !isKnown ? this.cameras.eye() : undefined,
    });
  }

  /** Keeps time and camera in the address, so it can be shared. @param now  ms */
  writeLink(now = performance.now()) {
    if (now - this.written < LINK_EVERY_MS) return;
    this.written = now;
    this.writeAddress();
  }

  /** Skips an address that the user has just entered and that is not yet followed. */
  writeAddress() {
    if (location.hash !== this.hash) return;
    const hash = this.address();
    if (hash !== location.hash) history.replaceState(null, '', hash || location.pathname + location.search);
    this.hash = location.hash;
  }

  async copy() {
    this.writeAddress();
    try {
      await navigator.clipboard.writeText(location.href);
      this.does.say('copied');
    } catch {
      this.does.say('the address of this page is the link');
    }
  }
}
