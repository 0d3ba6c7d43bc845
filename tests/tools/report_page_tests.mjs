// report_page_tests.mjs [NAME…]: tern-report's page of a recorded flight in a headless Chromium; all tests unless some are named.
// TERN_RECORDED_FLIGHTS: the folder of those flights (tests/flights).
import { join } from 'node:path';
import { pathToFileURL } from 'node:url';
import { expect, newPage, run, start, work } from '../viewer/support.mjs';

const { TERN_BIN, TERN_RECORDED_FLIGHTS } = process.env;
const CARDS = [
  'Flown path', 'Speed, m/s', 'Acceleration, m/s²', 'Clearance, m', 'Exposure, m', 'Replan time by stage, ms', 'Plan outcomes',
  'Audit', 'Prediction coverage', 'Half-width of predictions, m', 'Tracks nearest to leaving their intervals', 'Replan time, ms', 'Answers', 'Regions', 'Log',
  'Processes',
];
const CHARTS = 8; // two views of the map, speed, acceleration, clearance, exposure, replan times, outcomes
const LEGIBLE = 4.5; // contrast of text, WCAG 2 AA

/** The report of a recorded flight. `short_sighted`: among movers of 4 to 5 m/s it sees 2 m far. */
async function report(flight = 'demo') {
  const file = join(work, 'report.html');
  const written = start(`${TERN_BIN}/tern-report`, [join(TERN_RECORDED_FLIGHTS, `${flight}.lcm`), '-o', file]);
  expect(`its report: ${written.said}`, (await written.gone) === 0);
  return pathToFileURL(file).href;
}

/** The report in a browser of this size and scheme, with its requests and its console messages. */
async function openReport(url, colorScheme, width) {
  const page = await newPage({ viewport: { width, height: 900 }, colorScheme });
  page.asked = [];
  page.complaints = [];
  page.on('request', (request) => page.asked.push(request.url()));
  page.on('pageerror', (error) => page.complaints.push(error.message));
  page.on('console', (message) => page.complaints.push(message.text()));
  await page.goto(url);
  await page.waitForFunction((n) => document.querySelectorAll('canvas').length === n, CHARTS);
  await page.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done))));
  return page;
}

/** How many colours each canvas has. */
const colours = (page) =>
  page.$$eval('canvas', (all) =>
    all.map((canvas) => {
      const { data } = canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height);
      return new Set(new Uint32Array(data.buffer)).size;
    }));

/** The worst contrast of a text with its background: {ratio, text}. */
const contrast = (page) =>
  page.evaluate(() => {
    const rgba = (text) => text.match(/[\d.]+/g).map(Number);
    const over = ([r, g, b, a = 1], below) => [r, g, b].map((x, k) => a * x + (1 - a) * below[k]);
    const ground = (node) => {
      const own = rgba(getComputedStyle(node).backgroundColor);
      if (own[3] !== 0 || !node.parentElement) return over(own, [255, 255, 255]);
      return ground(node.parentElement);
    };
    const luminance = (rgb) => {
      const [r, g, b] = rgb.map((x) => x / 255).map((x) => (x <= 0.04045 ? x / 12.92 : ((x + 0.055) / 1.055) ** 2.4));
      return 0.2126 * r + 0.7152 * g + 0.0722 * b;
    };
    let worst = { ratio: Infinity };
    for (const node of document.querySelectorAll('main *')) {
      const text = [...node.childNodes].filter((x) => x.nodeType === Node.TEXT_NODE && x.data.trim()).map((x) => x.data).join(' ');
      if (!text || !node.checkVisibility()) continue;
      const below = ground(node);
      const [dark, light] = [luminance(below), luminance(over(rgba(getComputedStyle(node).color), below))].sort((a, b) => a - b);
      const ratio = (light + 0.05) / (dark + 0.05);
      if (ratio < worst.ratio) worst = { ratio, text };
    }
    return { ...worst, ground: luminance(ground(document.body)) };
  });

await run({
  async a_report_is_drawn_and_legible_in_light_and_dark_and_asks_for_nothing() {
    const url = await report();
    for (const scheme of ['light', 'dark']) {
      const page = await openReport(url, scheme, 1200);
      const cards = await page.$$eval('h2', (all) => all.map((x) => x.textContent));
      expect(`${scheme}: ${cards}`, JSON.stringify(cards) === JSON.stringify(CARDS));
      const drawn = await colours(page);
      expect(`${scheme}: every chart is drawn, in ${drawn} colours`, drawn.every((n) => n > 8));
      const { ratio, text, ground } = await contrast(page);
      expect(`${scheme}: “${text}” has a contrast of ${ratio}`, ratio >= LEGIBLE);
      expect(`${scheme}: the ground's luminance is ${ground}`, scheme === 'light' ? ground > 0.8 : ground < 0.05);
      expect(`nothing was asked for but the file: ${page.asked}`, page.asked.length === 1);
      expect(`the console is silent: ${page.complaints}`, page.complaints.length === 0);
      await page.close();
    }
  },

  async a_report_follows_its_slider_and_fits_a_narrow_window() {
    const page = await openReport(await report(), 'light', 420);
    const picture = () => page.$eval('canvas.map', (canvas) => canvas.toDataURL());
    const before = await picture();
    await page.$eval('.player input', (slider) => {
      slider.value = slider.max * 0.9;
      slider.dispatchEvent(new Event('input'));
    });
    await page.waitForFunction((old) => document.querySelector('canvas.map').toDataURL() !== old, before);
    const { wide, inner } = await page.evaluate(() => ({ wide: document.documentElement.scrollWidth, inner: innerWidth }));
    expect(`${wide} pixels in a window of ${inner}`, wide <= inner);
    await page.setViewportSize({ width: 360, height: 740 }); // a phone
    const cut = await page.$$eval('h1, .tile', (all) => all.filter((one) => one.scrollWidth > one.clientWidth).map((one) => one.textContent));
    expect(`sticks out on a phone: ${cut}`, cut.length === 0);
    expect(`the console is silent: ${page.complaints}`, page.complaints.length === 0);
  },

  async a_report_of_a_contact_says_what_had_been_known_of_it() {
    const page = await newPage();
    await page.goto(await report('short_sighted'));
    const said = await page.textContent('main');
    const { top_speed } = await page.evaluate(() => JSON.parse(document.getElementById('data').textContent).flight.result);
    expect(`the top speed is the referee's, ${top_speed}`, said.includes(`${top_speed.toFixed(2)} m/stop speed`));
    expect('it was in motion', said.includes('1 / 0contacts while moving / at rest'));
    expect('it was seen late', /Obstacle \d+ was touched at [\d.]+ s, by the vehicle at [\d.]+ m\/s\. It had been in PREDICTIONS for 0\.\d+ s\./.test(said));
  },
});
