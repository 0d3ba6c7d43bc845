// frames_per_second.mjs [LOG]: prints the frame rate of the page at 1600 × 1000 in a headless Chromium without a GPU. The page
// plays LOG, or a flight among 300 obstacles that is flown first. It asserts nothing.
// Environment: TERN_BIN, TERN_PAGE, TERN_CHROMIUM, where they are not build/release/bin, build/viewer-page and chromium.
import { execFileSync } from 'node:child_process';
import { rmSync } from 'node:fs';
import { join } from 'node:path';
import { fileURLToPath } from 'node:url';

const root = fileURLToPath(new URL('../../', import.meta.url));
process.env.TERN_BIN ??= join(root, 'build/release/bin');
process.env.TERN_PAGE ??= join(root, 'build/viewer-page');
process.env.TERN_CHROMIUM ??= execFileSync('sh', ['-c', 'command -v chromium'], { encoding: 'utf8' }).trim();
const { end, expect, openBrowser, start, startViewer, work } = await import('./support.mjs');

const SECONDS = 10; // a flight among 300 obstacles takes 13

/** A flight through the paper's corridor; its log. */
async function fly() {
  const campaign = join(process.env.TERN_BIN, 'tern-campaign');
  const flight = start(campaign, ['fly-one', '--world', join(root, 'scenarios/paper_corridor.yaml'), '--count', '300',
    '--seed', '1', '--charge', 'counts', '--folder', work]);
  expect(`flown: ${flight.said}`, (await flight.gone) === 0);
  return join(work, 'flight.lcm');
}

let code = 0;
let browser = null;
let viewer = null;
try {
  viewer = await startViewer('--log', process.argv[2] ?? (await fly()));
  browser = await openBrowser([]); // as it runs for a user: made to use SwiftShader, it draws half as many
  const page = await browser.newPage({ viewport: { width: 1600, height: 1000 } });
  await page.goto(viewer.url);
  await page.waitForFunction(() => window.tern?.status().vehicle && window.tern.known.truth, null, { timeout: 60_000 });
  const { obstacles, perSecond } = await page.evaluate(async (seconds) => {
    const wait = (ms) => new Promise((resolve) => setTimeout(resolve, ms));
    const { tern } = window;
    tern.jump(0);
    tern.send({ player: { play: true } });
    await wait(2500); // by then the page has adapted its number of pixels
    const rates = [];
    for (let second = 0; second < seconds; ++second) {
      const [from, drawn] = [performance.now(), tern.counts.drawn];
      await wait(1000);
      rates.push((1e3 * (tern.counts.drawn - drawn)) / (performance.now() - from));
    }
    return { obstacles: tern.status().obstacles, perSecond: rates };
  }, SECONDS);
  const mean = perSecond.reduce((sum, rate) => sum + rate, 0) / perSecond.length;
  console.log(`${mean.toFixed(0)} frames a second (${Math.min(...perSecond).toFixed(0)} to ${Math.max(...perSecond).toFixed(0)}, ` +
    `${SECONDS} seconds), 1600 × 1000, ${obstacles} obstacles`);
} catch (error) {
  console.error(error.message);
  code = 1;
}
await browser?.close();
if (viewer) await end(viewer, 'SIGKILL');
rmSync(work, { recursive: true, force: true });
process.exit(code);
