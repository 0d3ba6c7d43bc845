// Shared parts of the browser tests: processes that end with the test, a browser, and waiting for conditions.
import { spawn } from 'node:child_process';
import { mkdtempSync, readFileSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { chromium } from '../../viewer/web/node_modules/playwright-core/index.mjs';

const { TERN_BIN, TERN_PAGE, TERN_CHROMIUM } = process.env;
const PATIENCE_MS = 180_000; // for what takes milliseconds on an idle machine, and for flights at a pace

const all_work = mkdtempSync(join(tmpdir(), 'tern-viewer-'));
/** A folder for files; each test of run() has its own. */
export let work = all_work;
const running = new Set();
let browser = null;

export function fail(text) {
  throw new Error(text);
}

export function expect(what, holds) {
  if (!holds) fail(what);
}

/** Polls until `holds()` is true. */
export async function eventually(what, holds) {
  const deadline = Date.now() + PATIENCE_MS;
  while (!(await holds())) {
    if (Date.now() > deadline) fail(`not in time: ${what}`);
    await new Promise((resolve) => setTimeout(resolve, 20));
  }
}

/** Starts a program in a process group of its own; `said` grows with its output. */
export function start(program, args, env = {}) {
  const child = spawn(program, args, {
    env: { ...process.env, ...env }, stdio: ['ignore', 'pipe', 'pipe'], detached: true });
  const process_ = { child, said: '', ended: false };
  for (const stream of [child.stdout, child.stderr]) stream.on('data', (text) => (process_.said += text));
  child.on('error', (error) => (process_.said += error.message));
  process_.gone = new Promise((resolve) => child.on('close', (code) => resolve((process_.ended = true) && code)));
  running.add(process_);
  return process_;
}

/** Starts a flight, at a pace that this machine has time for. */
export function startFlight(...options) {
  const at_its_pace = new URL('../support/at_machine_pace.sh', import.meta.url).pathname;
  const fly = new URL('../../launch_scripts/fly.sh', import.meta.url).pathname;
  return start(at_its_pace, [fly, '--no-install', '--isolated', ...options]);
}

export async function end(process_, signal = 'SIGTERM') {
  if (!process_.ended) process.kill(-process_.child.pid, signal);
  running.delete(process_);
  return process_.gone;
}

/** tern-viewer with these options. */
export const startViewer = (...options) => awaitPage(start(`${TERN_BIN}/tern-viewer`, ['--page', TERN_PAGE, ...options]));

/** Waits until this tern-viewer listens; its `url` is where its page is. */
export async function awaitPage(viewer) {
  await eventually('tern-viewer listens', () => /the page is at/.test(viewer.said) || viewer.ended);
  viewer.url = /the page is at (\S+)/.exec(viewer.said)?.[1] ?? fail(`tern-viewer: ${viewer.said}`);
  return viewer;
}

export const startScene = () => start(`${TERN_BIN}/viewer_known_scene_process`, []);

/**
 * The known scene as a log, which begins `lead` s before world time, flown on a course (rad from x to y), with a camera for the first
 * `sighted` s; its path.
 */
export async function knownLog(lead = 0, course = 0, sighted = 0) {
  const path = join(work, `flight-${course}-${sighted}.lcm`);
  const code = await start(`${TERN_BIN}/viewer_known_scene_process`, [],
    { KNOWN_LOG: path, KNOWN_LEAD_S: `${lead}`, KNOWN_COURSE: `${course}`, KNOWN_SIGHTED_S: `${sighted}` }).gone;
  expect('the log is written', code === 0);
  return path;
}

// The same renderer everywhere, whatever Chromium would choose. It draws WebGL alone: charts and maps of 2D canvases take it seconds a
// picture.
const SWIFTSHADER = ['--use-gl=angle', '--use-angle=swiftshader', '--enable-unsafe-swiftshader', '--disable-accelerated-2d-canvas'];

/** @param rendering  Chromium's options that choose how it draws; none: as it runs for a user */
export async function openBrowser(rendering = SWIFTSHADER) {
  browser ??= await chromium.launch({ executablePath: TERN_CHROMIUM, args: ['--no-sandbox', ...rendering] });
  return browser;
}

/** An empty page with the patience of all other waiting. */
export async function newPage(options) {
  const page = await (await openBrowser()).newPage(options);
  page.setDefaultTimeout(PATIENCE_MS);
  return page;
}

/** A page that shows something. `page.complaints` collects warnings and errors of its console. */
export async function openPage(url, prepare = async () => {}, hash = '') {
  const page = await newPage({ viewport: { width: 800, height: 600 } });
  page.complaints = [];
  page.on('pageerror', (error) => page.complaints.push(error.message));
  page.on('console', (message) => {
    if (message.type() === 'error') page.complaints.push(message.text());
  });
  await prepare(page);
  await page.goto(`${url}?quality=low${hash}`);
  await eventually('the page draws', async () => {
    const drawn = await page.evaluate(() => window.tern?.counts.drawn ?? 0);
    if (drawn === 0 && page.complaints.length > 0) fail(`the page complains: ${page.complaints.join('; ')}`);
    return drawn > 0;
  });
  return page;
}

export const status = (page) => page.evaluate(() => window.tern.status());

/** Polls the page's status. */
export async function shows(page, what, holds) {
  let last = null;
  try {
    await eventually(what, async () => holds((last = await status(page))));
  } catch (error) {
    fail(`${error.message}; the page: ${JSON.stringify(last)} ${page.complaints.join('; ')}`);
  }
  return last;
}

/** Where a point of W is on the screen, in CSS pixels. */
export function onScreen(page, point) {
  return page.evaluate((p) => {
    const { camera } = window.tern.world;
    camera.updateMatrixWorld();
    const v = camera.position.clone().fromArray(p).project(camera);
    return { x: ((v.x + 1) / 2) * innerWidth, y: ((1 - v.y) / 2) * innerHeight, seen: v.z < 1 };
  }, point);
}

/**
 * Where a point of W is on the screen once the camera is at rest. The camera follows smoothly, so two pictures at nearly the same
 * time may look alike before.
 */
export async function atRest(page, point) {
  let at = await onScreen(page, point);
  await eventually('the camera rests', async () => {
    const since = await page.evaluate(() => ({ drawn: window.tern.counts.drawn, ms: performance.now() }));
    await page.waitForFunction((s) => window.tern.counts.drawn > s.drawn && performance.now() > s.ms + 300, since);
    const last = at;
    at = await onScreen(page, point);
    return Math.hypot(at.x - last.x, at.y - last.y) < 0.1;
  });
  return at;
}

/**
 * Waits until the log is paused at that time, s of the flight. The player's state is checked instead of the picture, which may be
 * older.
 */
export function pausedAt(page, t) {
  return eventually(`the log is paused at ${t} s`, () => page.evaluate((s) => {
    const { playing, at_us: at, zero_us: zero } = window.tern.known.player ?? {};
    return playing === false && Math.abs(at - zero - 1e6 * s) < 1;
  }, t));
}

/** Pauses the log at that time, s of the flight. A log plays from the start of its viewer on. */
export async function pauseAt(page, t) {
  await page.waitForFunction(() => window.tern.known.player);
  await page.evaluate((s) => {
    window.tern.send({ player: { play: false } });
    window.tern.jump(s);
  }, t);
  await pausedAt(page, t);
}

/** Moves the log player's slider to a share of the log. */
export function scrubTo(page, share) {
  return page.$eval('#scrub', (scrub, x) => {
    scrub.value = x * scrub.max;
    scrub.dispatchEvent(new Event('input'));
  }, share);
}

/** Runs a test in a folder of its own; its pages and processes end with it. @return whether it passed */
async function passes(name, test) {
  const began = Date.now();
  let passed = true;
  work = mkdtempSync(join(all_work, 'test-'));
  try {
    await test();
    console.log(`passed: ${name} (${(Date.now() - began) / 1000} s)`);
  } catch (error) {
    console.error(`FAILED: ${name}: ${error.stack}`);
    for (const { child, said } of running) console.error(`---- ${child.spawnfile}:\n${said.slice(-3000)}`);
    passed = false;
  }
  await Promise.all((browser?.contexts() ?? []).map((context) => context.close()));
  await Promise.all([...running].map((process_) => end(process_, 'SIGKILL')));
  return passed;
}

/**
 * Runs the tests that the command line names; otherwise all tests except live flights. A test's name is its claim. All tests share a
 * browser; each has a context of its own.
 */
export async function run(tests, live = []) {
  const named = process.argv.slice(2);
  const names = named.length > 0 ? named : Object.keys(tests).filter((name) => !live.includes(name));
  const failed = [];
  for (const name of names) {
    if (!(await passes(name, tests[name] ?? (() => fail(`no test ${name}`))))) failed.push(name);
  }
  await browser?.close();
  rmSync(all_work, { recursive: true, force: true });
  console.log(`${names.length - failed.length} of ${names.length} passed${failed.map((name) => `\nFAILED: ${name}`).join('')}`);
  process.exit(failed.length === 0 ? 0 : 1);
}

export const read = (path) => readFileSync(path, 'utf8');
