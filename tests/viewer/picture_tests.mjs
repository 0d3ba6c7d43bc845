// picture_tests.mjs [NAME…]: tests of what is read at a glance, in page and report, in a headless Chromium; all unless some are named.
import { writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { end, eventually, expect, knownLog, newPage, openPage, pauseAt, run, shows, start, startViewer, status, work } from './support.mjs';

const OBSTACLES = 30; // of the known scene
const MOVERS = 10;
const { TERN_BIN } = process.env;

const tags = (page) => page.$$eval('#tags span', (all) => all.map((tag) => tag.textContent));

await run({
  async nothing_sticks_out_of_a_panel_of_a_phone() {
    const viewer = await startViewer('--log', await knownLog());
    const page = await openPage(viewer.url);
    await shows(page, 'the scene', (s) => s.obstacles === OBSTACLES);
    await pauseAt(page, 10);
    for (const width of [320, 360, 375, 390, 412]) {
      for (const outcome of ['keep committed', 'reached']) { // the longest, and a short one
        await page.setViewportSize({ width, height: 720 });
        await page.evaluate((words) => {
          const longest = { outcome: words, clearance: '−10.25 m', togoal: '1234.5 m', replan: '112.5 of 1170 ms', confidence: '0.99 for 1.1 s' };
          for (const [id, text] of Object.entries(longest)) document.getElementById(id).textContent = text;
        }, outcome);
        const out = await page.$$eval('#head, #flight, footer', (panels) => panels.flatMap((panel) => {
          const box = panel.getBoundingClientRect();
          const texts = [...panel.querySelectorAll('span, dd, dt, button')].filter((one) => one.offsetParent);
          return texts.filter((one) => {
            const { left, right, top, bottom } = one.getBoundingClientRect();
            return left < box.left || right > box.right || top < box.top || bottom > box.bottom;
          }).map((one) => `${panel.id} ${one.textContent}`);
        }));
        expect(`at ${width} with ${outcome}: ${out}`, out.length === 0);
      }
    }
  },

  async hulls_are_outlines_of_the_first_second() {
    const viewer = await startViewer('--log', await knownLog());
    const page = await openPage(viewer.url, undefined, '#t=10');
    await shows(page, 'the scene', (s) => s.obstacles === OBSTACLES);
    await page.check('input[name=hulls]');
    await shows(page, 'hulls', (s) => s.hulls > 0);
    const { lines, far } = await page.evaluate(() => {
      const { scene } = window.tern.world;
      const { hulls } = window.tern.known.hulls;
      const drawn = scene.getObjectByName('hulls');
      return { lines: drawn.isLineSegments ? drawn.geometry.attributes.position.count : 0, far: Math.max(...hulls.map((hull) => hull.interval)) };
    });
    expect(`intervals of 0.2 s, the last one ${far}`, far === 4);
    const { hulls } = await status(page);
    expect(`${lines} ends of lines around ${hulls} movers`, hulls > 0 && hulls <= MOVERS && lines >= 2 * 12 * hulls);
  },

  async detections_and_tracks_have_a_layer_with_id_age_and_alpha() {
    const viewer = await startViewer('--log', await knownLog());
    const page = await openPage(viewer.url, undefined, '#t=10&cam=top');
    await shows(page, 'the scene', (s) => s.obstacles === OBSTACLES);
    await pauseAt(page, 10);
    expect('it is off at first', !(await page.evaluate(() => window.tern.known.tracked)));
    await page.check('input[name=tracks]');
    await shows(page, 'the movers', (s) => s.tracks === MOVERS);
    const { detections } = await page.evaluate(() => window.tern.known.tracked);
    expect(`their detections: ${detections.id}`, detections.id.length === MOVERS);
    await eventually('the tag of mover 25', async () => (await tags(page)).includes('25, 10.0 s, α 0.20 m'));
    await pauseAt(page, 2);
    await eventually('younger in the past', async () => (await tags(page)).some((tag) => /^21, 2\.0 s, /.test(tag)));
    await page.uncheck('input[name=tracks]');
    await eventually('they are gone', async () => (await tags(page)).every((tag) => tag === 'gate'));
    expect(`the console is silent: ${page.complaints}`, page.complaints.length === 0);
  },

  async obstacles_keep_their_names() {
    const viewer = await startViewer('--log', await knownLog());
    const page = await openPage(viewer.url, undefined, '#t=10&cam=top');
    await shows(page, 'the scene', (s) => s.obstacles === OBSTACLES);
    await pauseAt(page, 10);
    await eventually('a tag', async () => (await tags(page)).includes('gate'));
    // The camera glides to the vehicle. Until it rests, a projected point is elsewhere at the next frame.
    const camera = () => page.evaluate(() => window.tern.world.camera.position.toArray());
    let seen = await camera();
    await eventually('the camera rests', async () => {
      await page.evaluate(() => new Promise((resolve) => requestAnimationFrame(() => requestAnimationFrame(resolve))));
      const before = seen;
      seen = await camera();
      return seen.every((x, k) => Math.abs(x - before[k]) < 1e-6);
    });
    const detail = await page.evaluate(async () => {
      const { tern } = window;
      const panel = document.getElementById('inspected');
      const centre = tern.world.camera.position.clone().set(10, 3, 2);
      tern.world.camera.updateMatrixWorld();
      const { x, y } = centre.project(tern.world.camera);
      return { x: ((x + 1) / 2) * innerWidth, y: ((1 - y) / 2) * innerHeight, panel: panel.textContent };
    });
    await page.mouse.click(detail.x, detail.y);
    await eventually('the inspector', async () => (await page.textContent('#inspected')) === "Obstacle 10 'gate'");
    expect('how far it is from the body', /the vehicle is 2\.70 m away/.test(await page.textContent('#words')));
    await end(viewer);
  },

  async the_end_of_a_flight_says_why() {
    const log = await knownLog();
    const why = 'stood since 4.0 s: 160 answers stale world, sensor 0.28 s late, limit 0.3';
    writeFileSync(join(work, 'summary.json'), JSON.stringify({ why, pace: 1 }));
    const viewer = await startViewer('--log', log);
    const page = await openPage(viewer.url, undefined, '#t=10');
    await shows(page, 'the scene', (s) => s.obstacles === OBSTACLES);
    await pauseAt(page, 10);
    const said = () => page.textContent('#why');
    expect('not before its end', (await said()) === '');
    await pauseAt(page, 20);
    await eventually('at its end', async () => (await said()) === why);
    await page.setViewportSize({ width: 360, height: 640 });
    expect('on a phone', await page.isVisible('#why'));
    await pauseAt(page, 10);
    await eventually('not before its end', async () => (await said()) === '');
  },

  async a_report_without_width_is_drawn_when_it_gets_one() {
    const report = join(work, 'report.html');
    const made = start(`${TERN_BIN}/tern-report`, [await knownLog(), '--out', report]);
    await made.gone;
    const page = await newPage({ viewport: { width: 1, height: 600 } });
    const complaints = [];
    page.on('pageerror', (error) => complaints.push(error.message));
    await page.goto(`file://${report}`);
    await page.waitForFunction(() => document.querySelectorAll('.u-wrap').length > 0 && document.querySelector('footer'));
    expect(`nothing fails: ${complaints}`, complaints.length === 0);
    await page.setViewportSize({ width: 900, height: 600 });
    await page.waitForFunction(() => document.querySelector('canvas.map').clientWidth > 500 && document.querySelector('.u-wrap').clientWidth > 200);
    await page.setViewportSize({ width: 360, height: 600 });
    await page.waitForFunction(() => document.querySelector('canvas.map').clientWidth < 340);
    expect(`nothing fails: ${complaints}`, complaints.length === 0);
  },
});
