// view_tests.mjs [NAME…]: tests of how tern-viewer's page shows a flight, in a headless Chromium; all unless some are named.
import { chmodSync, readFileSync, statSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import {
  atRest, end, eventually, expect, fail, knownLog, openPage, pauseAt, pausedAt, run, scrubTo, shows, start, startFlight,
  startScene, startViewer, status, work,
} from './support.mjs';

const OBSTACLES = 30; // of the known scene
const REGIONS = 2;
const { TERN_BIN, TERN_PAGE } = process.env;

const text = (page, selector) => page.textContent(selector);

/** Where the camera is and where it looks to. */
const looks = (page) => page.evaluate(() => {
  const { camera } = window.tern.world;
  return { from: camera.position.toArray(), to: camera.getWorldDirection(camera.position.clone()).toArray() };
});

await run({
  async no_panel_hides_the_vehicle_that_is_followed() {
    const viewer = await startViewer('--log', await knownLog(0, 0, 20));
    const page = await openPage(viewer.url);
    await shows(page, 'the scene', (s) => s.obstacles === OBSTACLES);
    await pauseAt(page, 10);
    await shows(page, 'the vehicle at 10 m', (s) => Math.abs(s.vehicle[0] - 10) < 0.05);
    for (const [width, height] of [[800, 600], [1600, 900], [390, 844], [844, 390]]) {
      await page.setViewportSize({ width, height });
      for (const camera of ['chase', 'top', 'side']) {
        await page.evaluate((mode) => window.tern.setCamera(mode), camera); // a phone has the buttons behind its menu
        const { vehicle } = await status(page);
        const { x, y } = await atRest(page, vehicle);
        const hidden = await page.evaluate(
          ([u, v]) => [[0, 0], [-25, 0], [25, 0], [0, -25], [0, 25]].some(
            ([right, down]) => document.elementFromPoint(u + right, v + down)?.id !== 'view'),
          [x, y]);
        expect(`${camera} at ${width}×${height}: the vehicle is at ${x}, ${y}`, !hidden);
      }
    }
    expect(`the console is silent: ${page.complaints}`, page.complaints.length === 0);
  },

  async no_two_panels_overlap() {
    const viewer = await startViewer('--log', await knownLog(0, 0, 20));
    const page = await openPage(viewer.url);
    await shows(page, 'the scene', (s) => s.obstacles === OBSTACLES);
    for (const [width, height] of [[390, 844], [844, 390], [667, 375], [360, 640], [800, 600], [1024, 768], [1190, 700], [1600, 1000]]) {
      await page.setViewportSize({ width, height });
      const overlaps = await page.evaluate(() => {
        const boxes = ['#head', '#flight', '#pictures', '#side', 'footer'].map((name) => [name, document.querySelector(name).getBoundingClientRect()]);
        const shown = boxes.filter(([, box]) => box.width > 0);
        const bad = shown.filter(([, b]) => b.left < 0 || b.top < 0 || b.right > innerWidth || b.bottom > innerHeight);
        for (const [one, a] of shown) {
          for (const [other, b] of shown) {
            if (one < other && a.left < b.right && b.left < a.right && a.top < b.bottom && b.top < a.bottom) bad.push([`${one} ${other}`]);
          }
        }
        return bad.map(([name]) => name);
      });
      expect(`at ${width}×${height}: ${overlaps}`, overlaps.length === 0);
    }
  },

  async a_panel_has_the_picture_of_each_sensor_and_says_when_it_is_old() {
    const viewer = await startViewer('--log', await knownLog(0, 0, 10));
    const page = await openPage(viewer.url, undefined, '#t=5&cam=top');
    await page.setViewportSize({ width: 1600, height: 900 });
    await pausedAt(page, 5);
    await shows(page, 'a sighting', (s) => s.sightings === 1);
    const told = () => page.$$eval('.picture', (all) => all.map((one) => [one.textContent, one.classList.contains('old')].join()).join());
    await eventually('its picture is new', async () => (await told()) === 'camera 00.0 s ago,false');
    const colors = await page.$eval('.picture canvas', (canvas) => [[0.1, 0.1], [0.6, 0.5], [0.1, 0.9]].map(([right, down]) =>
      [...canvas.getContext('2d').getImageData(right * canvas.width, down * canvas.height, 1, 1).data].slice(0, 3).join()));
    expect(`nothing in range, not measured, 2 m: ${colors.join(' ')}`, colors.join(' ') === '18,58,99 0,0,0 202,202,202');
    const isUnseen = ([x, y]) => page.evaluate(([u, v]) => {
      const { cell, runs } = window.tern.known.sight.unseen;
      const [column, row] = [Math.floor(u / cell), Math.floor(v / cell)];
      return runs.some((_, k) => k % 3 === 0 && runs[k + 1] === row && runs[k] <= column && column < runs[k] + runs[k + 2]);
    }, [x, y]);
    expect('it was seen ahead', !(await isUnseen([6.6, 0.6])));
    expect('and not behind', await isUnseen([0, 0.6]));
    await pauseAt(page, 15);
    await eventually('its picture is old', async () => (await told()) === 'camera 0old: 5.1 s,true');
    await eventually('then nothing is seen', () => isUnseen([16.6, 0.6]));
    await shows(page, 'no box in the scene', (s) => s.sightings === 0);
    await page.uncheck('input[name=sightings]');
    expect('the layer hides the panel', !(await page.isVisible('#pictures')));
    const alone = await openPage((await startViewer('--log', await knownLog())).url);
    await alone.setViewportSize({ width: 1600, height: 900 });
    await shows(alone, 'the scene', (s) => s.obstacles === OBSTACLES);
    expect('no sensor, no panel and no layer', !(await alone.isVisible('#pictures')) && !(await alone.isVisible('[data-layer=unseen]')));
    expect(`the console is silent: ${page.complaints}`, page.complaints.length === 0);
  },

  async a_phone_reaches_every_button() {
    const viewer = await startViewer('--log', await knownLog());
    const page = await openPage(viewer.url);
    await shows(page, 'the scene', (s) => s.obstacles === OBSTACLES);
    for (const [width, height] of [[390, 844], [844, 390], [667, 375]]) {
      await page.setViewportSize({ width, height });
      await page.click('#menu');
      const hidden = await page.$$eval('#side button, #side input[type=checkbox]', (all) => all.filter((button) => {
        if (button.closest('[hidden], .recorded #goals')) return false;
        button.scrollIntoView({ block: 'nearest' });
        const { left, top, width: wide, height: high } = button.getBoundingClientRect();
        return document.elementFromPoint(left + wide / 2, top + high / 2) !== button;
      }).map((button) => button.id || button.name || button.dataset.camera));
      expect(`at ${width}×${height}: ${hidden}`, hidden.length === 0);
      await page.click('#showcharts');
      expect('the menu makes room', !(await page.isVisible('#side')));
      const [flight, foot] = await page.$$eval('#flight, footer', (all) => all.map((panel) => panel.getBoundingClientRect()));
      expect(`at ${width}×${height}: charts cover the numbers`, foot.height > 100 && foot.top > flight.bottom);
      await page.click('#menu');
      expect('charts are not under the menu', !(await page.isVisible('#charts')));
      await page.click('#showcharts');
      expect('they are gone', !(await page.isVisible('#charts')) && !(await page.isVisible('#side')));
    }
  },

  async keys_work_after_clicks() {
    const viewer = await startViewer('--log', await knownLog());
    const page = await openPage(viewer.url);
    await shows(page, 'the scene', (s) => s.obstacles === OBSTACLES);
    const playing = () => page.evaluate(() => window.tern.known.player.playing);
    await pauseAt(page, 0);
    await page.evaluate(() => window.tern.send({ player: { speed: 0.1 } })); // so that it does not reach its end
    for (const [k, spot] of ['#play', '[data-camera=top]', 'input[name=hulls]', '#timeline', '#view'].entries()) {
      if (spot === '#view') await page.mouse.click(400, 250);
      else await page.click(spot, { force: true });
      const here = 5 + k; // another place each round, so that an old picture does not pass
      await pauseAt(page, here);
      await page.keyboard.press('ArrowRight');
      await pausedAt(page, here + 0.1); // the next plan
      await page.keyboard.press('ArrowLeft');
      await pausedAt(page, here);
      await page.keyboard.press(' ');
      await eventually(`it plays after a click on ${spot}`, playing);
      await page.keyboard.press(' ');
      await eventually('and pauses', async () => !(await playing()));
    }
  },

  async a_link_holds_moment_and_camera() {
    const viewer = await startViewer('--log', await knownLog());
    const page = await openPage(viewer.url, undefined, '#t=6.3&cam=top');
    await pausedAt(page, 6.3);
    await shows(page, 'the vehicle at 6.3 m', (s) => s.vehicle && Math.abs(s.vehicle[0] - 6.3) < 0.02);
    expect('from above', await page.evaluate(() => window.tern.world.camera.isOrthographicCamera));
    await page.evaluate(() => window.tern.jump(12));
    await eventually('the address follows', () => page.evaluate(() => location.hash === '#t=12&cam=top'));
    await page.evaluate(() => new Promise((followed) => {
      window.addEventListener('hashchange', followed, { once: true });
      location.hash = '#t=3&cam=top';
    }).then(() => {
      const scrub = document.getElementById('scrub');
      scrub.value = 0.45 * scrub.max;
      scrub.dispatchEvent(new Event('input'));
    }));
    await eventually('whoever scrubs elsewhere at once', () => page.evaluate(() => location.hash === '#t=9&cam=top'));
    await page.evaluate(() => (location.hash = '#t=99&cam=top'));
    await eventually("the log's end", () => page.evaluate(() => location.hash === '#t=20&cam=top'));
    await page.evaluate(() => { // a link is made before the page gets the new address
      location.hash = '#t=4&cam=top';
      document.getElementById('link').click();
    });
    await pausedAt(page, 4);
    const whole = await openPage(viewer.url, undefined, '#t=6.3&cam=fit');
    await pausedAt(whole, 6.3);
    await shows(whole, 'the vehicle at 6.3 m', (s) => s.vehicle && Math.abs(s.vehicle[0] - 6.3) < 0.02);
    await eventually('all of the flight, from where it is seen', () =>
      whole.evaluate(() => location.hash.startsWith('#t=6.3&cam=free:')));
    await page.evaluate(() => (location.hash = '#cam=fit'));
    await eventually('in a page that is open, too', () => page.evaluate(() => window.tern.world.cameras.isStill));
  },

  async times_are_those_of_the_world() {
    const log = await knownLog(2);
    const file = join(work, 'flight.html');
    const made = start(`${TERN_BIN}/tern-viewer`, ['--page', TERN_PAGE, '--export', file, log]);
    expect(`exported: ${made.said}`, (await made.gone) === 0);
    const viewer = await startViewer('--log', log);
    for (const url of [viewer.url, `file://${file}`]) {
      const page = await openPage(url, undefined, '#t=6.3&cam=top'); // the vehicle's x is its time
      await pausedAt(page, 6.3);
      await shows(page, 'the vehicle at 6.3 m', (s) => s.vehicle && Math.abs(s.vehicle[0] - 6.3) < 0.06);
      await eventually('so says the clock', async () => (await text(page, '#clock')) === '6.3 s');
      await eventually('charts', () => page.evaluate(() => window.tern.charts.range().join() === '-2,20'));
      const [at, begin] = await page.evaluate(() => [6.3, -2].map((t) => window.tern.timeline.place(t)));
      const now = await page.evaluate(() => window.tern.timeline.place(window.tern.timeline.now));
      expect(`the line is at ${now}, not ${at}`, Math.abs(now - at) < 1 && begin === 8);
      await scrubTo(page, 0);
      await eventually('it begins before', async () => (await text(page, '#clock')) === '-2.0 s');
      await eventually('nothing is told of later answers', async () =>
        (await text(page, '#outcome')) === 'no plan yet' && (await text(page, '#replan')) === '–');
      await scrubTo(page, 0.5);
      await eventually('half of the log is 9 s', async () => (await text(page, '#at')) === '9.0 s');
      await eventually('as the address says', () => page.evaluate(() => location.hash === '#t=9&cam=top'));
    }
  },

  async the_cameras_look_along_the_flight() {
    const viewer = await startViewer('--log', await knownLog());
    const page = await openPage(viewer.url, undefined, '#t=10&cam=chase');
    await pausedAt(page, 10);
    await shows(page, 'the vehicle at 10 m', (s) => s.vehicle && Math.abs(s.vehicle[0] - 10) < 0.02);
    await page.waitForFunction(() => Object.keys(window.tern.known.path ?? {}).length > 0);
    for (const [camera, holds] of [
      ['chase', ({ from, to }) => from[0] < 8 && to[0] > 0.8], // behind, along +x
      ['first', ({ from, to }) => Math.abs(from[0] - 10) < 0.1 && to[0] > 0.9],
      ['top', ({ to }) => to[2] < -0.99],
      ['side', ({ from, to }) => from[1] < -20 && to[1] > 0.99],
    ]) {
      await page.evaluate((mode) => window.tern.setCamera(mode), camera);
      let view = null;
      await eventually(`${camera}: ${JSON.stringify(view)}`, async () => holds((view = await looks(page))));
    }
    const clear = await page.evaluate(() => {
      window.tern.setCamera('free', [20, -100, 40, 20, 0, 1]);
      return window.tern.world.clear(107); // distance of the camera from its target
    });
    expect(`what a far camera looks at is not in the fog: ${clear}`, clear > 0.9);
    await page.click('#fit');
    const ends = await Promise.all([[0, 0, 1], [20, 0, 1]].map((p) => atRest(page, p)));
    expect(`all of the path: ${JSON.stringify(ends)}`, ends.every(({ x, y }) => x > 0 && x < 800 && y > 0 && y < 600));
  },

  async the_cameras_look_along_flights_to_the_north_and_to_the_west() {
    for (const course of [Math.PI / 2, Math.PI]) {
      const [c, s] = [Math.cos(course), Math.sin(course)];
      const ahead = (p) => p[0] * c + p[1] * s;
      const right = (p) => p[0] * s - p[1] * c;
      const viewer = await startViewer('--log', await knownLog(0, course));
      const page = await openPage(viewer.url, undefined, '#t=10&cam=chase');
      await pausedAt(page, 10);
      await shows(page, 'the vehicle after 10 m', (is) => is.vehicle && Math.abs(ahead(is.vehicle) - 10) < 0.02);
      await page.waitForFunction(() => Object.keys(window.tern.known.path ?? {}).length > 0);
      for (const [camera, holds] of [
        ['chase', ({ from, to }) => ahead(from) < 8 && ahead(to) > 0.8],
        ['first', ({ from, to }) => Math.abs(ahead(from) - 10) < 0.1 && ahead(to) > 0.9],
        ['side', ({ from, to }) => right(from) > 20 && right(to) < -0.99],
      ]) {
        await page.evaluate((mode) => window.tern.setCamera(mode), camera);
        let view = null;
        await eventually(`${camera} on course ${course}`, async () => holds((view = await looks(page)))).catch((error) =>
          fail(`${error.message}: ${JSON.stringify(view)}`));
      }
      expect(`the console is silent: ${page.complaints}`, page.complaints.length === 0);
      await page.close();
      await end(viewer);
    }
  },

  async a_double_click_orbits_an_obstacle() {
    const viewer = await startViewer('--log', await knownLog());
    const page = await openPage(viewer.url, undefined, '#t=10&cam=top');
    await pausedAt(page, 10);
    await shows(page, 'the vehicle at 10 m', (s) => s.obstacles === OBSTACLES && Math.abs(s.vehicle[0] - 10) < 0.02);
    const pillar = [10, 3, 1];
    const { x, y } = await atRest(page, pillar);
    await page.mouse.dblclick(x, y);
    const orbit = () => page.evaluate(() => {
      const { mode, controls } = window.tern.world.cameras;
      return { mode, target: controls.target.toArray() };
    });
    await eventually('it is orbited', async () => (await orbit()).mode === 'orbit');
    const { target } = await orbit();
    expect(`its centre is looked at: ${target}`, Math.hypot(...target.map((c, k) => c - pillar[k])) < 0.1);
    expect(`the console is silent: ${page.complaints}`, page.complaints.length === 0);
  },

  async a_light_page_is_light_and_leads_to_the_dark_one_at_the_same_moment() {
    const viewer = await startViewer('--log', await knownLog());
    const page = await openPage(viewer.url, undefined, '&theme=light#t=10&cam=top');
    await pausedAt(page, 10);
    await shows(page, 'the vehicle at 10 m', (s) => s.vehicle && Math.abs(s.vehicle[0] - 10) < 0.02);
    /** 0 … 1 of the ground of the page, of its letters, and of what is behind the scene. */
    const brightness = () => page.evaluate(() => {
      const of = (color) => color.match(/[\d.]+/g).slice(0, 3).reduce((sum, part) => sum + Number(part) / 765, 0);
      const { color } = window.tern.world.fog;
      const root = getComputedStyle(document.body);
      return { panel: of(getComputedStyle(document.querySelector('#side')).backgroundColor), letters: of(root.color), scene: (color.r + color.g + color.b) / 3 };
    });
    const light = await brightness();
    expect(`dark on light: ${JSON.stringify(light)}`, light.panel > 0.7 && light.letters < 0.3 && light.scene > 0.5);
    await page.click('#theme');
    await page.waitForFunction(() => document.documentElement.dataset.theme === 'dark' && window.tern?.counts.drawn > 0);
    const dark = await brightness();
    expect(`light on dark: ${JSON.stringify(dark)}`, dark.panel < 0.3 && dark.letters > 0.6 && dark.scene < 0.2);
    await pausedAt(page, 10);
    await shows(page, 'the same moment', (s) => s.vehicle && Math.abs(s.vehicle[0] - 10) < 0.02);
    expect('the same camera', (await page.evaluate(() => window.tern.world.cameras.mode)) === 'top');
    expect(`the console is silent: ${page.complaints}`, page.complaints.length === 0);
  },

  async the_dot_of_a_process_that_has_ended_is_grey() {
    const scene = startScene();
    const viewer = await startViewer();
    const page = await openPage(viewer.url);
    const dot = () => page.evaluate(() => {
      const item = [...document.querySelectorAll('#health li')].find((li) => li.textContent.startsWith('scene'));
      const [red, green, blue] = item ? getComputedStyle(item, '::before').backgroundColor.match(/\d+/g).map(Number) : [];
      return { state: item?.className, red, green, blue };
    });
    await eventually('it is green', async () => {
      const { state, red, green } = await dot();
      return state === 'ready' && green > red + 40;
    });
    await end(scene, 'SIGKILL');
    await eventually('it has ended', async () => (await dot()).state === 'ended');
    const { red, green, blue } = await dot();
    expect(`it is grey: ${red} ${green} ${blue}`, Math.max(red, green, blue) - Math.min(red, green, blue) < 50);
  },

  async charts_and_timeline_show_the_whole_flight() {
    const viewer = await startViewer('--log', await knownLog());
    const page = await openPage(viewer.url);
    await shows(page, 'the scene', (s) => s.obstacles === OBSTACLES && s.events > 0);
    await page.evaluate(() => window.tern.send({ player: { play: false } }));
    const series = (name) => page.evaluate((n) => window.tern.charts.series[n], name);
    await eventually('speed', async () => (await series('UAV_STATE.speed_mps'))?.[0].length > 100);
    const [t, speed] = await series('UAV_STATE.speed_mps');
    expect('all of it', t[0] < 0.1 && t.at(-1) === 20 && speed.at(-1) === 0 && speed.slice(0, -1).every((v) => v === 1));
    const [, toMap] = await series('clearance.map_m');
    expect('nothing of the map is occupied', toMap.every((x) => x === null));
    await page.setViewportSize({ width: 1400, height: 900 });
    const [input] = await page.$$('.add');
    await input.fill('PLAN.hold_s');
    await input.press('Enter');
    await eventually('another field', async () => (await series('PLAN.hold_s'))?.[1].every((x) => x === 1));
    const plot = await page.$('.plot .u-over');
    const box = await plot.boundingBox();
    await page.mouse.click(box.x + box.width / 2, box.y + 20);
    await shows(page, 'a click jumps', (s) => Math.abs(s.vehicle[0] - 10) < 0.3);
    // The panels are drawn some times a second, the scene with every picture.
    await eventually('one cursor', () => page.evaluate(() => Math.abs(window.tern.timeline.now - 10) < 0.3));
    await eventually('numbers are of the state that the panels show', () => page.evaluate(() => {
      const { charts, known: { state, player } } = window.tern;
      return Math.abs(charts.stateTime - (state.at_us - player.zero_us) * 1e-6) < 1e-9;
    }));
    await page.evaluate(() => { // a curve that keeps but two of its rows
      const { charts } = window.tern;
      charts.series['clearance.obstacles_m'] = [[0, 20], [5, 25]];
      charts.setNow(charts.now, charts.stateTime, charts.shown);
    });
    await eventually('panels and charts tell one number', () => page.evaluate(() => {
      const told = document.querySelector('[data-field="clearance.obstacles_m"] b').textContent;
      const shown = document.getElementById('clearance').textContent;
      return Math.abs(Number(told) - parseFloat(shown)) <= 0.005 + 1e-9;
    }));
    await page.mouse.move(box.x + box.width / 4, box.y + 20);
    await page.mouse.down();
    await page.mouse.move(box.x + box.width / 2, box.y + 20, { steps: 4 });
    await page.mouse.up();
    await eventually('a drag zooms all', () => page.evaluate(() => {
      const [from, to] = window.tern.charts.range();
      return Math.abs(from - 5) < 0.3 && Math.abs(to - 10) < 0.3;
    }));
    await page.click('#eventlist');
    await eventually('the goal is listed', async () => (await text(page, '#messages')).includes('goal 1: 20.0, 0.0, 1.0'));
    expect(`the console is silent: ${page.complaints}`, page.complaints.length === 0);
  },

  async a_film_has_the_pictures_that_were_asked_for() {
    const film = join(work, 'film.mp4');
    // A program in place of ffmpeg: it stores its arguments and its input.
    const encoder = join(work, 'encoder');
    writeFileSync(encoder, `#!/bin/sh\necho "$@" >"${film}.told"\nfor last; do :; done\ncat /dev/fd/$(echo "$@" | sed 's/.*pipe:\\([0-9]*\\).*/\\1/') >"$last"\n`);
    chmodSync(encoder, 0o755);
    const made = start(`${TERN_BIN}/tern-viewer`, [
      '--page', TERN_PAGE, '--video', film, '--video-size', '320', '180', '--video-rate', '4', '--video-part', '0', '1.5', await knownLog(),
    ], { TERN_FFMPEG: encoder });
    expect(`filmed: ${made.said}`, (await made.gone) === 0);
    const bytes = readFileSync(film);
    let pictures = 0;
    for (let at = 0; (at = bytes.indexOf(Buffer.from([0xff, 0xd8, 0xff]), at)) >= 0; ++at) ++pictures;
    expect(`six pictures, not ${pictures}`, pictures === 6);
    expect('their rate is told', readFileSync(`${film}.told`, 'utf8').includes('-framerate 4 '));
    const none = start(`${TERN_BIN}/tern-viewer`, ['--page', TERN_PAGE, '--video', film, '--video-part', '900', '901', await knownLog()], { TERN_FFMPEG: encoder });
    expect('no picture is an error', (await none.gone) !== 0 && /--video-part 900 901 is empty/.test(none.said));
    const alone = start(`${TERN_BIN}/tern-viewer`, ['--video-rate', '4', '--log', await knownLog()]);
    expect('without --video it has no effect and is refused', (await alone.gone) !== 0 && /requires --video/.test(alone.said));
  },

  async what_has_no_effect_on_a_log_is_refused() {
    const log = await knownLog();
    const played = [['--set', 'seed=3'], ['--config', 'x.yaml'], ['--lcm-url', 'udpm://'], ['--clock-offset-us', '5'], ['--allow-goals'],
      ['--key-file', 'key']];
    const written = [['--listen', '127.0.0.1'], ['--url-file', 'x'], ['--allow-host', 'x'], ['--pace', '0.5'], ['--foxglove', '8766']]
      .map((options) => [...options, '--export', join(work, 'refused.html')]);
    for (const options of [...played, ...written]) {
      for (const where of [[log], ['--log', log]]) {
        const viewer = start(`${TERN_BIN}/tern-viewer`, ['--page', TERN_PAGE, ...options, ...where]);
        expect(`${options}: ${viewer.said}`, (await viewer.gone) === 2 && viewer.said.includes(`${options[0]}: has no effect when a`));
      }
    }
  },

  async an_exported_page_plays_by_itself() {
    const file = join(work, 'flight.html');
    const log = await knownLog();
    const made = start(`${TERN_BIN}/tern-viewer`, ['--page', TERN_PAGE, '--export', file, '--ghost', log, log]);
    expect(`exported: ${made.said}`, (await made.gone) === 0);
    expect('small enough', statSync(file).size < 10_000_000);
    const page = await openPage(`file://${file}`, undefined, '#t=6.3&cam=side');
    await pausedAt(page, 6.3);
    await shows(page, 'the vehicle at 6.3 m', (s) => s.vehicle && Math.abs(s.vehicle[0] - 6.3) < 0.06);
    const there = await status(page);
    expect('all that stands there', there.obstacles === OBSTACLES && there.regions === REGIONS);
    expect('its ghost is where it is', Math.abs(there.ghost[0] - there.vehicle[0]) < 0.1);
    expect('and in the legend', await page.isVisible('[data-layer=ghost]'));
    await page.keyboard.press(' ');
    await shows(page, 'it plays', (s) => s.vehicle[0] > 7);
    await page.check('input[name=planes]');
    await shows(page, 'planes', (s) => s.planes === 1);
    expect(`the console is silent: ${page.complaints}`, page.complaints.length === 0);
    const alone = join(work, 'alone.html');
    const made_alone = start(`${TERN_BIN}/tern-viewer`, ['--page', TERN_PAGE, '--export', alone, log]);
    expect(`exported: ${made_alone.said}`, (await made_alone.gone) === 0);
    expect('no legend of another log', !(await (await openPage(`file://${alone}`)).isVisible('[data-layer=ghost]')));
  },

  async a_flight_that_has_ended_is_played_by_the_same_page() {
    const record = join(work, 'flight');
    const pillar = new URL('pillar.yaml', import.meta.url).pathname;
    const flight = startFlight('--view', '--view-wait', '60', '--record', record, '--scenario', pillar,
      '--set', 'simulator.send_goal=true');
    await eventually('it waits for a page', () => /begins when a page has connected/.test(flight.said) || flight.ended);
    const page = await openPage(/view +(\S+)/.exec(flight.said)[1]);
    await eventually('the log', async () => (await text(page, '#mode')) === 'log');
    expect('which was seen live before', (await status(page)).modes.join() === 'live,log');
    expect('reached', /^reached$/m.test(flight.said));
    await pauseAt(page, 0);
    await shows(page, 'wound back', (s) => s.vehicle && Math.hypot(s.vehicle[0], s.vehicle[1]) < 0.5);
    expect(`the console is silent: ${page.complaints}`, page.complaints.filter((c) => !/WebSocket/.test(c)).length === 0);
    expect('it stays', !flight.ended);
    process.kill(flight.child.pid, 'SIGINT');
    expect(`the flight's exit code: ${flight.said}`, (await flight.gone) === 0);
  },
}, ['a_flight_that_has_ended_is_played_by_the_same_page']);
