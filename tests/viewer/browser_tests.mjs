// browser_tests.mjs [NAME…]: tests of tern-viewer's page in a headless Chromium, all unless some are named.
import { existsSync } from 'node:fs';
import http from 'node:http';
import { join } from 'node:path';
import {
  atRest, awaitPage, end, eventually, expect, knownLog, onScreen, openPage, pauseAt, run, scrubTo, shows, start, startFlight,
  startScene, startViewer, status, work,
} from './support.mjs';

const OBSTACLES = 30; // of the known scene
const REGIONS = 2;
const { TERN_BIN, TERN_BUILD } = process.env;

const text = (page, selector) => page.textContent(selector);

/** A request by hand: {status, body}. */
function request(url, options = {}) {
  return new Promise((resolve, reject) => {
    const sent = http.request(url, options, (response) => {
      let body = '';
      response.on('data', (part) => (body += part));
      response.on('end', () => resolve({ status: response.statusCode, body }));
    });
    sent.on('upgrade', (response, socket) => resolve({ status: response.statusCode }) || socket.destroy());
    sent.on('error', reject);
    sent.end(options.body);
  });
}

const upgrade = (url, headers) =>
  request(new URL('stream', url), {
    headers: {
      Connection: 'Upgrade', Upgrade: 'websocket', 'Sec-WebSocket-Version': '13',
      'Sec-WebSocket-Key': 'dGhlIHNhbXBsZSBub25jZQ==', ...headers,
    },
  });

await run({
  async a_live_scene_is_shown_as_it_is_and_moves() {
    const viewer = await startViewer();
    const page = await openPage(viewer.url);
    startScene(); // when the page is there: it flies for 20 s
    const first = await shows(page, 'the scene', (s) => s.obstacles === OBSTACLES && s.regions === REGIONS && s.vehicle);
    await shows(page, 'the vehicle flies along x', (s) => s.vehicle[0] > first.vehicle[0] + 0.5);
    await eventually('its speed', async () => (await text(page, '#speed')) === '1.0');
    expect('live', (await text(page, '#mode')) === 'live');
    await eventually('the outcome', async () => (await text(page, '#outcome')) === 'optimized');
    await eventually('its confidence', async () => (await text(page, '#confidence')) === '0.9 for 0.8 s');
    // A page that joins between a request and its answer knows the time allowed from the next request on.
    await eventually('replan time', async () => (await text(page, '#replan')) === '12.5 of 70 ms');
    await eventually('health', async () => (await text(page, '#health')).includes('scene'));
    expect(`the console is silent: ${page.complaints}`, page.complaints.length === 0);
  },

  async hulls_planes_and_search_are_shown_when_someone_looks() {
    startScene();
    const viewer = await startViewer();
    const page = await openPage(viewer.url);
    await shows(page, 'the scene', (s) => s.obstacles === OBSTACLES);
    const before = await status(page);
    expect('nothing before', before.hulls === 0 && before.planes === 0 && before.nodes === 0);
    await page.check('input[name=hulls]');
    await page.check('input[name=planes]');
    await page.check('input[name=search]');
    await shows(page, 'all three', (s) => s.hulls > 0 && s.planes === 1 && s.nodes === 3);
    expect(`the console is silent: ${page.complaints}`, page.complaints.length === 0);
  },

  async what_is_picked_shows_its_messages() {
    const viewer = await startViewer('--log', await knownLog());
    const page = await openPage(viewer.url);
    await shows(page, 'the scene', (s) => s.obstacles === OBSTACLES);
    // At the log's beginning, from above, whatever was played of it: there nothing hides the vehicle, no panel either.
    await page.click('[data-camera=top]');
    await pauseAt(page, 0);
    await shows(page, 'the vehicle at the start', (s) => s.vehicle[0] < 0.01);
    const spot = await atRest(page, [0, 0, 1]);
    await page.mouse.click(spot.x, spot.y);
    await eventually('the vehicle', async () => (await text(page, '#inspected')) === 'Vehicle');
    expect('its message', (await text(page, '#messages')).includes('UAV_STATE'));
    // Some obstacle's centre is in view and nothing stands before it.
    const centres = await page.evaluate(() => {
      const { p } = window.tern.known.truth;
      return Array.from({ length: p.length / 3 }, (_, k) => p.slice(3 * k, 3 * k + 3));
    });
    const spots = await Promise.all(centres.map((p) => onScreen(page, p)));
    const free = spots.find(({ x, y, seen }) => seen && x > 290 && x < 540 && y > 20 && y < 380);
    expect('an obstacle is in view', free);
    await page.mouse.click(free.x, free.y);
    await eventually('an obstacle', async () => /^Obstacle \d+$/.test(await text(page, '#inspected')));
    await eventually('both messages', async () => /OBSTACLE_TRUTH.*PREDICTIONS/s.test(await text(page, '#messages')));
    await page.click('#closeinspector');
    expect('closed', await page.isHidden('#inspector'));
    expect(`the console is silent: ${page.complaints}`, page.complaints.length === 0);
  },

  async a_log_plays_steps_and_scrubs() {
    const viewer = await startViewer('--log', await knownLog());
    const page = await openPage(viewer.url);
    await shows(page, 'the scene', (s) => s.vehicle && s.obstacles === OBSTACLES);
    expect('nobody sends goals to a log', !(await page.isVisible('#goals')));
    await page.waitForFunction(() => window.tern.known.player.at_us > window.tern.known.player.begin_us); // it plays by itself
    await pauseAt(page, 0);
    await page.selectOption('#rate', '0.1'); // so that a late look does not find it at its end
    await page.click('#play');
    await shows(page, 'the vehicle flies', (s) => s.vehicle[0] > 0.2);
    await page.click('#play');
    await page.waitForFunction(() => window.tern.known.player.playing === false);
    for (const share of [0.75, 0.1, 0.5]) {
      await scrubTo(page, share);
      // 20 s at 1 m/s.
      await shows(page, `the vehicle at ${20 * share} m`, (s) => Math.abs(s.vehicle[0] - 20 * share) < 0.05);
    }
    const at = () => page.evaluate(() => window.tern.known.player.at_us);
    const here = await at();
    await page.click('#forth');
    await eventually('the next plan', async () => (await at()) === here + 100_000);
    await page.click('#back');
    await eventually('and back', async () => (await at()) === here);
    await page.selectOption('#rate', '8');
    await page.click('#play');
    await eventually('it ends at the end', async () => (await text(page, '#at')) === '20.0 s');
    expect('a goal is refused', await refusal(page, /a log is played/));
    expect(`the console is silent: ${page.complaints}`, page.complaints.length === 0);
  },

  async goals_are_refused_unless_allowed() {
    const scene = startScene();
    const readonly = await startViewer();
    const page = await openPage(readonly.url);
    await shows(page, 'the scene', (s) => s.obstacles === OBSTACLES);
    expect('no button', await page.isDisabled('#goalmode'));
    expect('refused', await refusal(page, /--allow-goals/));
    await page.close();

    const open = await startViewer('--allow-goals');
    const other = await openPage(open.url);
    await shows(other, 'the scene', (s) => s.obstacles === OBSTACLES && s.vehicle);
    await other.waitForFunction(() => window.tern.known.goal && window.tern.known.request);
    await other.click('#goalmode');
    await other.mouse.click(400, 300);
    await other.waitForFunction(() => window.tern.counts.goals.length === 1);
    const [{ sent }] = await other.evaluate(() => window.tern.counts.goals);
    expect('it is newer than the flight’s own', sent === 2);
    await eventually('the bus heard it', () => /^goal 2 /m.test(scene.said));
    const [, z] = /^goal 2 \S+ \S+ (\S+)/m.exec(scene.said);
    expect('at the height of the last', Number(z) === 1);
    await other.waitForFunction(() => window.tern.known.goal.id === 2);
    await other.evaluate(() => window.tern.send({ goal: { position: [1000, 0, 1] } }));
    await other.waitForFunction(() => /flight box/.test(window.tern.counts.goals[1]?.refused));
    await other.evaluate(() => window.tern.send({ goal: { position: [1, 0, 0.05] } })); // the centre alone would be within
    await other.waitForFunction(() => /body .* flight box/.test(window.tern.counts.goals[2]?.refused));
    expect('nobody sent a third', !/^goal 3 /m.test(scene.said));
  },

  async after_hold_or_stop_a_click_sends_a_goal_that_can_be_flown_to() {
    const scene = startScene();
    const viewer = await startViewer('--allow-goals');
    const open = async () => {
      const page = await openPage(viewer.url);
      await shows(page, 'the scene', (s) => s.obstacles === OBSTACLES && s.vehicle);
      await page.waitForFunction(() => window.tern.known.goal && window.tern.known.request);
      return page;
    };
    const knows = (page, id) => page.waitForFunction((n) => window.tern.known.goal.id === n, id);
    const click = async (page, id) => {
      await page.click('#goalmode');
      await page.mouse.click(400, 300);
      await eventually(`the bus heard goal ${id}`, () => new RegExp(`^goal ${id} `, 'm').test(scene.said));
      return Number(new RegExp(`^goal ${id} \\S+ \\S+ (\\S+)`, 'm').exec(scene.said)[1]);
    };
    const page = await open();
    await page.evaluate(() => window.tern.send({ goal: { position: [5, 0, 2] } }));
    await knows(page, 2);
    await page.click('#hold-goal');
    await knows(page, 3);
    await eventually('holding, there is nothing to fly to', async () => (await text(page, '#togoal')) === '–');
    expect('at the height of the last place', (await click(page, 4)) === 2);
    await knows(page, 4);
    await page.click('#stop-goal');
    await knows(page, 5);
    await page.close();
    const other = await open(); // no position was received by it
    await knows(other, 5);
    expect('at the height of the vehicle', (await click(other, 6)) === 1);
    expect(`the console is silent: ${page.complaints}`, page.complaints.length === 0);
  },

  async the_vehicle_flies_to_where_a_page_clicks_and_rests_there() {
    const record = join(work, 'flight');
    const pillar = new URL('pillar.yaml', import.meta.url).pathname;
    const flight = startFlight('--view', '--allow-goals', '--report', '--record', record, '--scenario', pillar);
    await eventually('the URL', () => /view +http/.test(flight.said) || flight.ended);
    const page = await openPage(/view +(\S+)/.exec(flight.said)[1]);
    await shows(page, 'the vehicle waits', (s) => s.vehicle && s.obstacles === 1);
    await page.click('[data-camera=top]');
    for (const goal of [[5, 0, 1], [4, -3, 1]]) { // behind the pillar; then beside
      const spot = await atRest(page, goal);
      await page.click('#goalmode');
      await page.mouse.click(spot.x, spot.y);
      await eventually('it is there', () =>
        page.evaluate(([x, y]) => {
          const { state, goal } = window.tern.known;
          if (!goal || Math.hypot(goal.p[0] - x, goal.p[1] - y) > 0.1) return false;
          return Math.hypot(...state.p.map((u, k) => goal.p[k] - u)) < 0.01 && Math.hypot(...state.v) < 0.001;
        }, goal));
      await shows(page, 'and seen there', (s) => Math.hypot(s.vehicle[0] - goal[0], s.vehicle[1] - goal[1]) < 0.12);
    }
    expect(`the console is silent: ${page.complaints}`, page.complaints.length === 0);
    expect('Ctrl-C is how such a flight ends', (await end(flight, 'SIGINT')) === 130);
    expect('it is drawn then, as it was asked for', existsSync(join(record, 'report.html')));
    const audit = start(`${TERN_BIN}/tern-audit`, [join(record, 'flight.lcm')]);
    await audit.gone;
    // A browser without a GPU sometimes takes the planner's core; other tests check that answers are in time.
    const broken = audit.said.split('\n').filter((line) => /^ +BROKEN +(?! |answers )/.test(line));
    expect(`the audit: ${audit.said}`, / held +certificates/.test(audit.said) && broken.length === 0);
  },

  async malformed_messages_break_neither_page_nor_bridge() {
    startScene();
    const viewer = await startViewer();
    const nasty = [
      'not json', 'null', '7', '"text"', '[]', '{"frame":"one"}', '{"frame":1,"state":{}}', '{"frame":1,"state":7}',
      '{"frame":1,"truth":{"id":[1,2],"moves":[0],"p":[0],"v":[],"h":[]}}', '{"frame":1,"plan":{"curve":"x"}}',
      '{"frame":1,"map":{"faces":[1,2,3]}}', '{"frame":1,"chart":{}}', '{"frame":1,"health":{"a":1}}',
      '{"frame":1,"hulls":{"hulls":[{"points":null}]}}', '{"frame":1,"path":[1,2,3]}', '{"detail":{"title":"x"}}',
    ];
    let toPage = null;
    const page = await openPage(viewer.url, (p) =>
      p.routeWebSocket(/stream/, (socket) => {
        socket.connectToServer();
        toPage = socket;
      }));
    await shows(page, 'the scene', (s) => s.obstacles === OBSTACLES);
    for (const message of nasty) toPage.send(message);
    const hurt = await shows(page, 'it noticed', (s) => s.malformed >= nasty.length - 4);
    await shows(page, 'it goes on', (s) => s.frames > hurt.frames + 5 && s.obstacles === OBSTACLES && s.vehicle);
    expect(`no error: ${page.complaints}`, page.complaints.length === 0);

    const answers = await page.evaluate(
      (url) =>
        new Promise((resolve) => {
          const heard = [];
          const socket = new WebSocket(url);
          socket.onopen = () => ['{', '{"fly":1}', '{"seen":"x"}'].forEach((text) => socket.send(text));
          socket.onmessage = ({ data }) => {
            const message = JSON.parse(data);
            if (message.refused) heard.push(message.refused);
            if (heard.length === 3) socket.send('x'.repeat(100_000));
          };
          socket.onclose = () => resolve(heard);
        }),
      viewer.url.replace('http', 'ws') + 'stream');
    expect(`each command was refused: ${answers}`, answers.length === 3);
    const after = await status(page);
    await shows(page, 'the bridge goes on', (s) => s.frames > after.frames + 5);
  },

  async a_page_comes_back_when_the_bridge_does() {
    startScene();
    const viewer = await startViewer();
    const page = await openPage(viewer.url);
    await shows(page, 'the scene', (s) => s.obstacles === OBSTACLES);
    const dots = () => page.$$eval('#health li', (all) => all.map(({ className }) => className).join());
    await eventually('a process is ready', async () => (await dots()).includes('ready'));
    await end(viewer, 'SIGKILL');
    await eventually('no process is said to be ready', async () => /^unknown(,unknown)*$/.test(await dots()));
    await eventually('it says so', async () => (await text(page, '#mode')) === 'bridge lost');
    const before = await status(page);
    await startViewer('--listen', new URL(viewer.url).host);
    await shows(page, 'it is back', (s) => s.connections === 2 && s.frames > before.frames + 5 && s.obstacles === OBSTACLES);
    expect('live again', (await text(page, '#mode')) === 'live');
  },

  async a_slow_page_gets_the_newest_and_holds_up_nobody() {
    startScene();
    const viewer = await startViewer();
    const page = await openPage(viewer.url);
    await shows(page, 'the scene', (s) => s.obstacles === OBSTACLES);
    await page.evaluate((url) => {
      const slow = (window.slow = { frames: [], socket: new WebSocket(url) });
      slow.socket.onmessage = ({ data }) => slow.frames.push(JSON.parse(data));
    }, viewer.url.replace('http', 'ws') + 'stream');
    await page.waitForFunction(() => window.slow.frames.length === 2);
    const { frames } = await status(page);
    await shows(page, 'the other page goes on', (s) => s.frames > frames + 30);
    expect('two frames and no more', (await page.evaluate(() => window.slow.frames.length)) === 2);
    const newest = await page.evaluate(() => window.tern.known.state.at_us);
    await page.evaluate(() => window.slow.socket.send('{"seen":2}'));
    await page.waitForFunction(() => window.slow.frames.length > 2);
    const third = await page.evaluate(() => window.slow.frames[2]);
    expect('what it missed was counted', third.dropped > 10);
    expect('it got the newest', third.state.at_us >= newest);
  },

  async other_sites_and_other_hosts_are_refused() {
    const { url } = await startViewer();
    const { host, port } = new URL(url);
    expect('its own page', (await upgrade(url, { Origin: `http://${host}` })).status === 101);
    expect('no browser', (await upgrade(url, {})).status === 101);
    for (const origin of ['http://evil.example', 'null', `http://localhost:${port}`]) {
      expect(`Origin ${origin}`, (await upgrade(url, { Origin: origin })).status === 403);
    }
    expect('a name that was bent here', (await request(url, { headers: { Host: `evil.example:${port}` } })).status === 403);
    expect('POST', (await request(url, { method: 'POST', body: 'x' })).status === 405);
    for (const path of ['/nothing', '/../../etc/passwd', '//index.html', '/%2e%2e/', '/stream']) {
      expect(path, (await request(url, { path })).status === 404);
    }
    const index = await request(url);
    expect('the page', index.status === 200 && index.body.includes('<title>Tern</title>'));
  },

  async an_installed_viewer_has_its_page() {
    const prefix = join(work, 'prefix');
    const install = start('cmake', ['--install', TERN_BUILD, '--prefix', prefix, '--component', 'programs']);
    expect(`cmake --install: ${install.said}`, (await install.gone) === 0);
    startScene();
    const viewer = await awaitPage(start(join(prefix, 'bin/tern-viewer'), []));
    const page = await openPage(viewer.url);
    await shows(page, 'the scene', (s) => s.obstacles === OBSTACLES && s.vehicle);
    expect(`the console is silent: ${page.complaints}`, page.complaints.length === 0);
  },

  async an_isolated_flight_is_seen_from_outside() {
    const record = join(work, 'flight');
    const flight = startFlight('--view', '--allow-goals', '--record', record, '--set', 'simulator.min_flight_s=60');
    await eventually('the URL', () => /view +http/.test(flight.said) || flight.ended);
    const page = await openPage(/view +(\S+)/.exec(flight.said)[1]);
    const first = await shows(page, 'the corridor', (s) => s.obstacles === 100 && s.regions === 2 && s.vehicle);
    await shows(page, 'the vehicle flies', (s) => s.vehicle[0] > first.vehicle[0] + 2);
    await eventually('every process', async () => (await page.$$('#health li.ready')).length === 8);
    expect('goals may be sent', await page.isEnabled('#goalmode'));
    expect(`the console is silent: ${page.complaints}`, page.complaints.length === 0);
    await end(flight, 'SIGINT');
  },
}, ['the_vehicle_flies_to_where_a_page_clicks_and_rests_there', 'an_isolated_flight_is_seen_from_outside']);

/** Sends a goal without the buttons. @return true if it is refused for this reason */
async function refusal(page, reason) {
  await page.evaluate(() => window.tern.send({ goal: { position: [1, 0, 1] } }));
  await page.waitForFunction(() => window.tern.counts.goals.length > 0);
  const [goal] = await page.evaluate(() => window.tern.counts.goals);
  return reason.test(goal.refused);
}
