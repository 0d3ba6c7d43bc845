// page_tests.mjs: what the page computes, without a browser.
import assert from 'node:assert/strict';
import { test } from 'node:test';

const source = (name) => import(new URL(`../../viewer/web/src/${name}.js`, import.meta.url));
const { Quality, Stillness } = await source('quality');
const { readLink, writeLink } = await source('link');
const { countUpTo, eventNear, placeAt, valueAt } = await source('time_rows');
const { Tape } = await source('tape');
const { label } = await source('labels');
const { mapInWords, obstacleInWords } = await source('words');
const { BOUNDS, boxEdges, boxInPicture, depthColor, project } = await source('projection');
const { ageInWords } = await source('pictures');

/** A renderer whose frames take `fixed` ms and `perPixels` ms at full size. @return ms until the pixels stayed, and the last frame's */
function settle(quality, fixed, perPixels, seconds = 30) {
  let now = 0;
  let changed = 0;
  let ms = 0;
  while (now < 1e3 * seconds) {
    ms = fixed + perPixels * quality.pixels ** 2;
    now += ms;
    const pixels = quality.frame(now);
    if (pixels !== null && now < 20_000) changed = now;
  }
  return { changed, ms };
}

test('quality: a slow renderer has what it can pay for within two seconds', () => {
  for (const perPixels of [40, 80, 150, 300]) {
    const quality = new Quality({ pixels: 0.7, fewest: 0.3, most: 1 });
    const { changed, ms } = settle(quality, 8, perPixels, 10);
    assert.ok(changed < 2000 || quality.pixels === 1, `${perPixels}: still changed after ${changed} ms`);
    assert.ok(ms < 33 || quality.pixels === 0.3, `${perPixels}: ${ms} ms a frame at ${quality.pixels}`);
  }
});

test('quality: a renderer of four frames a second is at its least within two seconds', () => {
  const quality = new Quality({ pixels: 0.7, fewest: 0.3, most: 1 });
  const { changed } = settle(quality, 200, 200, 5);
  assert.equal(quality.pixels, 0.3);
  assert.ok(changed < 2000, `after ${changed} ms`);
});

test('quality: what stands still is drawn sharply, and then only when something is new', () => {
  const stillness = new Stillness();
  const drawn = [];
  const look = (now, moves, news = false) => stillness.isDue(now, moves, news) && drawn.push([now, stillness.still]);
  for (let now = 0; now < 100; now += 20) look(now, true);
  assert.ok(drawn.length === 5 && drawn.every(([, still]) => !still), 'while it moves every picture is drawn');
  for (let now = 100; now < 1000; now += 20) look(now, false);
  assert.deepEqual(drawn.filter(([, still]) => still).map(([now]) => now), [480, 980]);
  look(1000, false, true);
  assert.deepEqual(drawn.at(-1), [1000, true], 'news are shown at once');
  look(1020, true);
  assert.deepEqual(drawn.at(-1), [1020, false], 'who moves does not wait for all pixels');
});

test('quality: a pause says nothing of the frames before it', () => {
  const quality = new Quality({ pixels: 0.7, fewest: 0.3, most: 1 });
  for (let now = 0; now < 1000; now += 25) quality.frame(now);
  const { pixels } = quality;
  quality.pause();
  for (let now = 60_000; now < 61_000; now += 25) quality.frame(now);
  assert.equal(quality.pixels, pixels);
});

test('quality: a fast renderer gets all pixels', () => {
  const quality = new Quality({ pixels: 0.4, fewest: 0.3, most: 1 });
  settle(quality, 3, 4);
  assert.equal(quality.pixels, 1);
});

test('links: what is written is read', () => {
  for (const link of [{}, { t: 6.3 }, { t: -0.4 }, { cam: 'top' }, { t: 0, cam: 'chase' }, { t: 5, cam: 'fit' }, { t: 12.25, cam: 'free', eye: [1, -2.5, 3, 0, 0, 1] }]) {
    assert.deepEqual(readLink(writeLink(link)), link);
  }
  assert.equal(writeLink({ t: 6.3, cam: 'top' }), '#t=6.3&cam=top');
});

test('links: what is wrong is left out', () => {
  for (const hash of ['', '#', '#t=', '#t=x', '#t=Infinity', '#cam=moon', '#cam=<b>', '#x=1']) {
    const { t, cam } = readLink(hash);
    assert.ok(t === undefined || t === 0, hash);
    assert.equal(cam, undefined, hash);
  }
  assert.deepEqual(readLink('#cam=free:1,2,x,4,5,6'), { cam: 'free' });
  assert.deepEqual(readLink('#t=2&cam=free:1,2'), { t: 2, cam: 'free' });
});

test('rows: the newest value, and the place between two', () => {
  const t = [0, 1, 1, 2, 5];
  for (const at of [-1, 0, 0.5, 1, 1.5, 2, 4, 5, 6]) assert.equal(countUpTo(t, at), t.filter((x) => x <= at).length);
  assert.equal(valueAt([[1, 2], ['a', 'b']], 0.9), null);
  assert.equal(valueAt([[1, 2], ['a', 'b']], 1.9), 'a');
  const path = { t: [1, 2, 4], curve: [0, 0, 0, 1, 2, 0, 0, 3, 2, 8, 0, 1] };
  assert.equal(placeAt(path, 0.5), null);
  assert.deepEqual(placeAt(path, 1.5), [1, 0, 0, 2]);
  assert.deepEqual(placeAt(path, 3), [2, 4, 0, 2]);
  assert.equal(placeAt(path, 9), null);
});

test('timeline: a click finds the loud event near it', () => {
  const events = [{ t: 1, kind: 'outcome' }, { t: 1.3, kind: 'late' }, { t: 9, kind: 'goal' }];
  const place = (t) => 10 * t;
  assert.equal(eventNear(events, place, 11).kind, 'late');
  assert.equal(eventNear(events, place, 5).kind, 'outcome');
  assert.equal(eventNear(events, place, 50), null);
});

/** A tape of 10 s: the vehicle's x is its time; plans at 2, 4, 6, 8 s. */
function tape() {
  const shown = [];
  let now = 0;
  const s = (t) => t * 1e6;
  const rows = {
    state: [Array.from({ length: 101 }, (_, k) => s(k / 10)), Array.from({ length: 101 }, (_, k) => ({ x: k / 10 }))],
    plan: [[2, 4, 6, 8].map(s), ['a', 'b', 'c', 'd']],
  };
  const known = {};
  const handlers = { open() {}, frame: (frame) => Object.assign(known, frame) && shown.push(frame), reply: (r) => (known.reply = r) };
  const player = new Tape({ begin_us: 0, zero_us: 0, end_us: s(10), still: { session: { mode: 'file' } }, rows }, handlers, () => now);
  player.open();
  return { player, known, shown, pass: (ms) => ((now += ms), player.drawn()) };
}

test('tape: plays at its speed, and ends at the end', () => {
  const { known, pass, player } = tape();
  assert.equal(known.session.mode, 'file');
  pass(1500);
  assert.equal(known.state.x, 1.5);
  assert.equal(known.plan ?? null, null);
  player.send({ player: { speed: 2 } });
  pass(1000);
  assert.equal(known.state.x, 3.5);
  assert.equal(known.plan, 'a');
  pass(60_000);
  assert.equal(known.state.x, 10);
  assert.equal(known.player.playing, false);
  player.send({ player: { play: true } });
  pass(100);
  assert.equal(known.state.x, 0.2);
});

test('tape: jumps anywhere, and steps from plan to plan', () => {
  const { known, pass, player } = tape();
  for (const [to, x, plan] of [[7e6, 7, 'c'], [1e6, 1, null], [99e6, 10, 'd'], [-5, 0, null]]) {
    player.send({ player: { play: false } });
    player.send({ player: { seek_us: to } });
    pass(500);
    assert.equal(known.state.x, x);
    assert.equal(known.plan, plan);
  }
  for (const [step, at] of [[1, 2e6], [1, 4e6], [-1, 2e6], [-1, 2e6]]) {
    player.send({ player: { step } });
    pass(10);
    assert.equal(known.player.at_us, at);
  }
});

test('tape: an unchanged topic is not told again', () => {
  const { shown, pass, player } = tape();
  pass(100);
  pass(10); // no new state in it
  assert.deepEqual(Object.keys(shown.at(-1)).sort(), ['dropped', 'frame', 'player']);
  player.send({ player: { play: false } });
  pass(100);
  const { length } = shown;
  pass(100);
  assert.equal(shown.length, length, 'who rests tells nothing');
});

test('walls: a height cuts off what is above, and opens what it cuts', async () => {
  globalThis.location = { search: '?theme=light' };
  globalThis.document = { documentElement: { dataset: {} } };
  const THREE = await import(new URL('../../viewer/web/node_modules/three/build/three.module.js', import.meta.url));
  const { Regions } = await source('regions');
  const walls = new Regions({ scene: new THREE.Scene(), lightOn: () => new THREE.Color() }, new THREE.Vector3());
  // A wall of 1 × 1 × 2 m: its top and its bottom.
  walls.take({ origin: [0, 0, 0], resolution: 0.5, faces: [[2, 5, 0, 0, 4, 2, 2, 4], [2, 4, 0, 0, 0, 2, 2, 0]].flat() });
  const fromAbove = new THREE.Raycaster(new THREE.Vector3(0.5, 0.5, 9), new THREE.Vector3(0, 0, -1));
  const seenAt = () => walls.hit(fromAbove)?.point.z;
  assert.equal(walls.top, 2);
  assert.equal(seenAt(), 2);
  walls.cutAt(1.2);
  assert.equal(seenAt(), 0);
  walls.cutAt(null);
  assert.equal(seenAt(), 2);
});

test('hulls: an outline has the edges of the hull, and none within a face', async () => {
  const THREE = await import(new URL('../../viewer/web/node_modules/three/build/three.module.js', import.meta.url));
  const { outline } = await source('proofs');
  const edges = (points) => {
    const out = [];
    outline(points.map((p) => new THREE.Vector3(...p)), out);
    return out.length / 6;
  };
  const box = [0, 1, 2, 3, 4, 5, 6, 7].map((k) => [k & 1, (k & 2) / 2, (k & 4) / 4]);
  assert.equal(edges(box), 12);
  assert.equal(edges([...box, ...box.map(([x, y, z]) => [x + 1, y, z])]), 12, 'swept along an axis it is a box');
  assert.equal(edges([...box, ...box.map(([x, y, z]) => [x + 1, y + 1, z])]), 18, 'swept across it is a prism over a hexagon');
});

test('tracks: id, age and the largest α', async () => {
  const { trackInWords } = await source('tracks');
  const tracks = { id: [7, 8], age_s: [1.25, null], alpha: [0.1, 0.344, 0.2, 0, 0, 0.5] };
  assert.equal(trackInWords(tracks, 0), '7, 1.3 s, α 0.34 m');
  assert.equal(trackInWords(tracks, 1), '8, α 0.50 m');
});

test('goal: its ring is a circle from above and from any side, and seen from afar', async () => {
  const THREE = await import(new URL('../../viewer/web/node_modules/three/build/three.module.js', import.meta.url));
  const { Trajectories } = await source('trajectories');
  const trajectories = new Trajectories(new THREE.Scene());
  trajectories.takeGoal({ p: [10, 0, 2] });
  const above = new THREE.OrthographicCamera(-40, 40, 40, -40, 0.1, 400);
  const behind = new THREE.PerspectiveCamera(46, 1, 0.1, 400);
  above.position.set(10, 0, 100);
  behind.position.set(-60, -30, 20);
  for (const camera of [above, behind]) {
    camera.up.set(0, camera === above ? 1 : 0, camera === above ? 0 : 1);
    camera.lookAt(10, 0, 2);
    camera.updateMatrixWorld();
    trajectories.draw(1.7, camera, 800);
    const [ring] = trajectories.goal.children;
    ring.updateWorldMatrix(true, false);
    const box = new THREE.Box2();
    const { position } = ring.geometry.attributes;
    for (let k = 0; k < position.count; ++k) {
      const at = new THREE.Vector3().fromBufferAttribute(position, k).applyMatrix4(ring.matrixWorld).project(camera);
      box.expandByPoint(new THREE.Vector2(400 * at.x, 400 * at.y));
    }
    const { x: wide, y: high } = box.getSize(new THREE.Vector2());
    assert.ok(Math.abs(wide - high) < 0.05 * wide && wide > 25, `${wide} × ${high} pixels`);
  }
});

test('movers: one colour in page, report, check and plot, and another one for hulls', async () => {
  const { readFileSync } = await import('node:fs');
  const text = (path) => readFileSync(new URL(`../../${path}`, import.meta.url), 'utf8');
  const [dark, light] = [...text('viewer/web/src/palette.js').matchAll(/ {2}mover: '(#\w+)'/g)].map(([, color]) => color);
  const report = [...text('tools/report/page/report.css').matchAll(/--mover: (#\w+)/g)].map(([, color]) => color);
  assert.deepEqual(report, [light, dark]);
  assert.ok(text('campaign/experiments/scenario_drawing.cpp').includes(`kMover[] = "fill=\\"${light}\\"`));
  assert.ok(text('docs/examples/plot_flight.py').includes(`"${light}" if o.moves`));
  assert.ok(![...text('viewer/web/src/palette.js').matchAll(/hull\w*: '(#\w+)'/g)].some(([, color]) => color === dark || color === light));
});

test('labels: fields as people read them', () => {
  assert.equal(label('UAV_STATE.speed_mps'), 'speed m/s');
  assert.equal(label('UAV_STATE.velocity_mps.x'), 'velocity.x m/s');
  assert.equal(label('clearance.obstacles_m'), 'to obstacles m');
  assert.equal(label('PLAN_TIMING.local_goal_ms'), 'local goal ms');
  assert.equal(label('PLAN.cost_jerk'), 'plan cost jerk');
  assert.equal(label('PLAN_TIMING.hulls'), 'hulls');
});

test('words: what was clicked on', () => {
  const known = {
    state: { p: [0, 0, 1], map_clearance: 0.4 },
    request: { radius: 0.1 },
    truth: { id: [7, 8], moves: [1, 0], p: [3, 0, 1, 0, 5, 1], v: [0, 2, 0, 0, 0, 0], h: [0.5, 0.5, 0.5, 1, 1, 1] },
    tracks: { id: [7] },
    plan: { planes: [{ track: 7 }, { track: 7 }] },
  };
  assert.equal(
    obstacleInWords(7, known, 2.4),
    'Moving at 2.0 m/s, 1.0 × 1.0 × 1.0 m; the vehicle is 2.40 m away; the planner knows it from PREDICTIONS; 2 planes of the newest plan separate it from the vehicle.');
  assert.match(obstacleInWords(8, known, 3.9), /^Stationary, .* 3\.90 m away; the planner does not know it/);
  assert.doesNotMatch(obstacleInWords(8, known), /away/);
  assert.equal(obstacleInWords(9, known), 'It has gone.');
  assert.match(obstacleInWords(7, known, -0.1), /overlaps it by 0\.10 m/);
  const at = { toArray: () => [0, 3, 1], getComponent: (k) => [0, 3, 1][k] };
  assert.equal(
    mapInWords({ point: at, layer: 'walls' }, known),
    'Occupied: a wall of the map; here at 0.0, 3.0, 1.0; 3.00 m from the vehicle\'s centre; the vehicle\'s nearest wall is 0.40 m from its body.');
});

/** A sensor at (1, 2, 3) that looks along W's y, level. */
const lookingNorth = (kind) => ({
  kind, p: [1, 2, 3], q: [Math.SQRT1_2, -Math.SQRT1_2, 0, 0], left: 0.6, right: 0.4, up: 0.3, down: 0.2, range: 10,
});

test('projection: the axis, the edges of the picture, and what is behind', () => {
  const camera = lookingNorth('camera');
  const near = (at, expected) => assert.ok(at.every((x, k) => Math.abs(x - expected[k]) < 1e-9), `${at}, not ${expected}`);
  const axis = [Math.tan(0.6) / (Math.tan(0.6) + Math.tan(0.4)), Math.tan(0.3) / (Math.tan(0.3) + Math.tan(0.2))];
  near(project(camera, [1, 7, 3]), axis);
  near(project(camera, [1 - 5 * Math.tan(0.6), 7, 3 + 5 * Math.tan(0.3)]), [0, 0]);
  near(project(camera, [1 + 5 * Math.tan(0.4), 7, 3 - 5 * Math.tan(0.2)]), [1, 1]);
  assert.equal(project(camera, [1, 1, 3]), null);
  const lidar = lookingNorth('lidar');
  near(project(lidar, [1, 7, 3]), [0.6, 0.6]);
  const along = (azimuth, elevation) =>
    [1 + 4 * Math.cos(elevation) * Math.sin(azimuth), 2 + 4 * Math.cos(elevation) * Math.cos(azimuth), 3 + 4 * Math.sin(elevation)];
  near(project(lidar, along(-0.6, 0.3)), [0, 0]);
  near(project(lidar, along(0.4, -0.2)), [1, 1]);
});

test('projection: a box in the picture has the edges that face the sensor, coloured by what is known the least', () => {
  const [face, whole, occluded, , touching, unseen] = BOUNDS.keys();
  const bounds = [occluded, whole, face, unseen, touching, whole]; // −x, +x, −y (towards the sensor), +y, −z, +z
  const [lower, upper] = [[0, 6, 2], [2, 7, 4]];
  const count = (lines) => lines.reduce((counts, { state }) => ({ ...counts, [state]: (counts[state] ?? 0) + 1 }), {});
  assert.deepEqual(count(boxEdges(lower, upper, bounds)), { [whole]: 3, [occluded]: 3, [touching]: 2, [unseen]: 4 });
  for (const kind of ['camera', 'lidar']) {
    const lines = boxInPicture(lookingNorth(kind), lower, upper, bounds);
    assert.deepEqual(count(lines), { [whole]: 2, [occluded]: 1, [touching]: 1 }, 'the sensor is before it: one face');
    const places = lines.flatMap(({ points }) => points);
    const corners = [[0, 6, 2], [2, 6, 4]].map((corner) => project(lookingNorth(kind), corner));
    for (const axis of [0, 1]) {
      const all = places.map((at) => at[axis]);
      assert.ok(Math.min(...all) <= Math.min(...corners.map((at) => at[axis])) + 1e-9);
      assert.ok(Math.max(...all) >= Math.max(...corners.map((at) => at[axis])) - 1e-9);
    }
  }
  const around = { ...lookingNorth('lidar'), left: Math.PI, right: Math.PI };
  for (const { points } of boxInPicture(around, [0, -3, 2], [2, -2, 4], bounds)) { // it lies across the seam
    for (let k = 1; k < points.length; ++k) assert.ok(Math.abs(points[k][0] - points[k - 1][0]) < 0.2);
  }
});

test('projection: depths are greys, and neither empty nor dark cells are', () => {
  const grey = [0.1, 2, 5, 9.9].map((m) => depthColor(10 * m, 10));
  assert.ok(grey.every(([red, green, blue]) => red === green && green === blue));
  assert.ok(grey.every(([red], k) => k === 0 || red < grey[k - 1][0] - 20), 'farther is darker');
  const [far, blind] = [depthColor(-1, 10), depthColor(0, 10)];
  assert.ok(far[2] > far[0] + 40, 'nothing in range is blue');
  assert.ok(Math.max(...blind) < grey[3][0] - 40, 'not measured is darker than any depth');
});

test('pictures: an age is told, and one beyond the limit is called old', () => {
  assert.equal(ageInWords(0.12), '0.1 s ago');
  assert.equal(ageInWords(-0.01), '0.0 s ago');
  assert.equal(ageInWords(2.34), 'old: 2.3 s');
});
