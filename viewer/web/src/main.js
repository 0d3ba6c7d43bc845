// Connects the received data (a bridge's stream, or a tape in the page) with scene and panels.
import * as THREE from 'three';
import './style.css';
import './panels.css';
import './time.css';
import './small.css';
import { Charts } from './charts.js';
import { Controls } from './controls.js';
import { Estimate } from './estimate.js';
import { Ghost } from './ghost.js';
import * as hud from './hud.js';
import { Inspector } from './inspector.js';
import { makeSwitches, offer, ON_DEMAND, showCount } from './layers.js';
import { Obstacles } from './obstacles.js';
import { watchFreeArea } from './panels.js';
import { Pointer } from './picking.js';
import { Pictures } from './pictures.js';
import { Player } from './player.js';
import { Proofs } from './proofs.js';
import { Regions } from './regions.js';
import { Sight } from './sight.js';
import { Stream } from './stream.js';
import { readTape, Tape } from './tape.js';
import { QUIET } from './time_rows.js';
import { Tags } from './tags.js';
import { Timeline } from './timeline.js';
import { Tracks } from './tracks.js';
import { Trajectories } from './trajectories.js';
import { Vehicle } from './vehicle.js';
import { Views } from './views.js';
import { mapInWords, obstacleInWords } from './words.js';
import { World } from './world.js';

const canvas = document.getElementById('view');
const world = new World(canvas);
const { cameras } = world;
const free = watchFreeArea((area) => world.setFree(area));
const trajectories = new Trajectories(world.scene);
const proofs = new Proofs(world.scene);
const vehicle = new Vehicle(world.scene);
const regions = new Regions(world, vehicle.p);
const obstacles = new Obstacles(world, vehicle.p);
const tracks = new Tracks(world.scene, vehicle.p);
const views = new Views(world.scene);
const estimate = new Estimate(world.scene);
const sight = new Sight(world.scene);
const pictures = new Pictures();
const tags = new Tags(document.getElementById('tags'));
const ghost = new Ghost(world.scene);
const layers = {};
const known = {}; // the newest value of each topic
const counts = { frames: 0, drawn: 0, malformed: 0, connections: 0, dropped: 0, goals: [], modes: [] };
let clock = { at_us: 0, arrived_ms: 0 }; // the vehicle's clock when its last state arrived
let stream = null;
const send = (command) => stream?.send(command);

const inspector = new Inspector(send);
inspector.closed = () => pickObstacle(undefined);
const player = new Player(send, hud.toast);
const jump = (t) => player.jump(t);
const timeline = new Timeline(jump);
const charts = new Charts({
  jump,
  wants: (names) => send({ series: names }),
  hover: (t) => timeline.hover(t),
  unknown: (name) => hud.toast(`no such field: ${name}`),
});

/** Seconds of the flight: world time, or since the first state while world time is unknown. */
const flightTime = (at_us) => (at_us - (known.player?.zero_us ?? known.chart?.zero_us ?? at_us)) * 1e-6;
/** The known time of the flight, s: the log's begin and end, or the first and the newest state. */
const flightSpan = (chart) => [known.player ? flightTime(known.player.begin_us) : chart.begin_s, chart.end_s];

/** Handlers of the topics; null clears a topic. */
const topics = {
  session(session) {
    if (known.session && (known.session.epoch !== session.epoch || known.session.mode !== session.mode)) forget();
    counts.modes.push(session.mode);
    hud.showSession(session);
    if (session.mode === 'live') player.take(null);
  },
  player(state) {
    const isFirst = !known.player;
    known.player = state;
    player.take(state);
    if (isFirst) controls.follow();
  },
  chart(chart) {
    if (!chart) return;
    known.chart = chart;
    charts.take(chart, flightSpan(chart));
    timeline.takeChart(chart, flightSpan(chart));
  },
  fields: (names) => names && charts.takeFields(names),
  events: (message) => timeline.takeEvents(message?.events ?? []),
  path(path) {
    if (!path) return;
    trajectories.takePath(path);
    if (path.curve.length > 0) controls.pathIsKnown();
    if (known.state) trajectories.takeState(known.state, flightTime(known.state.at_us));
  },
  goal(goal) {
    if (goal?.p) known.place = goal.p; // the last goal that has a position
    trajectories.takeGoal(goal);
  },
  request(request) {
    if (!request) return;
    trajectories.takeRequest(request);
    vehicle.setBody(request.half, request.tube);
  },
  state(state) {
    if (!state) return vehicle.clear();
    vehicle.take(state);
    clock = { at_us: state.at_us, arrived_ms: performance.now() };
    trajectories.takeState(state, flightTime(state.at_us));
    if (known.goal?.p) cameras.head(state.p, known.goal.p);
    hud.takeState(state, known.goal);
  },
  truth: (set) => (set ? obstacles.take(set) : obstacles.clear()),
  tracks(set) {
    if (set && !known.truth) obstacles.take(set); // on an aircraft the truth is unknown
  },
  plan(plan) {
    trajectories.takePlan(plan);
    proofs.takePlanes(layers.planes ? plan : null, obstacles.pickedId);
    hud.takePlan(plan);
  },
  timing: (timing) => hud.takeTiming(timing),
  result: (result) => hud.showResult(result),
  hulls: (hulls) => proofs.takeHulls(hulls),
  tracked: (message) => tracks.take(message),
  search: (search) => proofs.takeSearch(search),
  map(map) {
    if (map) regions.take(map);
    else regions.clear();
    showCut();
  },
  health: (processes) => hud.showHealth(processes, (name) => inspector.open({ kind: 'process', name })),
  views(message) {
    views.take(message);
    offer('views', message);
  },
  sight(message) {
    sight.take(message);
    pictures.take(message);
    for (const layer of ['sightings', 'unseen']) offer(layer, message);
  },
  estimate(message) {
    estimate.take(message);
    pictures.takeFeatures(message);
    offer('estimate', message);
    if (message && !known.estimate) charts.offer(['estimate.error_m', 'estimate.bound_m']);
  },
  ghost(message) {
    if (message) ghost.take(message);
    else ghost.clear();
    offer('ghost', message);
  },
};

function takeFrame(frame) {
  counts.frames += 1;
  counts.dropped = frame.dropped;
  for (const topic of Object.keys(topics)) { // the session comes before its data
    if (!(topic in frame)) continue;
    try {
      topics[topic](frame[topic]);
      known[topic] = frame[topic];
    } catch (error) {
      counts.malformed += 1;
      console.warn(`${topic} was not understood: ${error.message}`);
    }
  }
}

function takeReply(message) {
  if (message.detail) inspector.show(message.detail);
  if (message.refused) hud.toast(`refused: ${message.refused}`);
  if (message.goal) {
    counts.goals.push(message.goal);
    hud.toast(message.goal.refused ? `goal refused: ${message.goal.refused}` : `goal ${message.goal.sent} sent`);
  }
}

/** Hides the layers that few flights have. */
function offerNothing() {
  for (const layer of ['ghost', 'views', 'estimate', 'sightings', 'unseen']) offer(layer, false);
}

/** Starts over: another bridge, another flight, or its log. */
function forget() {
  for (const key of Object.keys(known)) delete known[key];
  for (const part of [obstacles, trajectories, proofs, tracks, views, estimate, sight, pictures, vehicle, regions, ghost, cameras]) part.clear();
  hud.forget();
  timeline.takeEvents([]);
  offerNothing();
}

// Layers -------------------------------------------------------------------------------------------------------------

function sendSubscriptions() {
  send({ layers: ON_DEMAND.filter((name) => layers[name]) });
  send({ series: charts.names() });
}

function setLayer(name, on) {
  layers[name] = on;
  for (const part of [trajectories, proofs, tracks, views, estimate, sight, pictures, regions, ghost]) part.show(name, on);
  if (name === 'obstacles') obstacles.show(on);
  if (ON_DEMAND.includes(name)) send({ layers: ON_DEMAND.filter((other) => layers[other]) });
  if (name === 'planes') proofs.takePlanes(on ? known.plan : null, obstacles.pickedId);
  if (name === 'planes' && on) hud.toast('planes exist only where bounding boxes do not separate plan and obstacle');
  if (name === 'search' && on && !known.search) hud.toast('the planner publishes it with --set planner.publish_search=true');
}
makeSwitches(document.getElementById('layers'), setLayer);
offerNothing();

let cutShare = 1;
function showCut() {
  const has = regions.top > 0;
  document.getElementById('cutrow').hidden = !has;
  const height = cutShare * regions.top;
  document.getElementById('cutat').textContent = cutShare < 1 ? `${height.toFixed(1)} m` : '';
  regions.cutAt(cutShare < 1 ? height : null);
}

// Requests of the user -----------------------------------------------------------------------------------------------

const controls = new Controls(cameras, {
  hasPath: () => known.path?.curve.length > 0,
  fit: () => cameras.fit(trajectories.extent(new THREE.Box3())),
  toggle: () => player.toggle(),
  step: (plans) => player.step(plans),
  restAt: (t) => player.restAt(t),
  cut(share) {
    cutShare = share;
    showCut();
  },
  goal: (mode) => send({ goal: { mode } }),
  aim: () => !document.getElementById('goalmode').disabled && pointer.aim(!pointer.aiming),
  escape: () => inspector.close(),
  now: () => player.now(),
  say: hud.toast,
  changed: () => free.look(),
});

document.getElementById('eventlist').onclick = () => {
  const loud = timeline.events.filter(({ kind }) => kind !== QUIET);
  const quiet = timeline.events.length - loud.length;
  inspector.list('Events', loud, jump, `and ${quiet} more changes of the outcome, in the band`);
};

function pickObstacle(id) {
  obstacles.pick(id);
  proofs.takePlanes(layers.planes ? known.plan : null, id);
}

const pointer = new Pointer(canvas, world, {
  pick(ray) {
    const picks = [
      { hit: vehicle.hit(ray), pick: { kind: 'vehicle' } },
      { hit: obstacles.hit(ray), pick: { kind: 'obstacle' } },
      { hit: ray.intersectObject(trajectories.goal)[0], pick: { kind: 'goal' } },
      { hit: ray.intersectObject(trajectories.localGoal)[0], pick: { kind: 'plan' } },
      { hit: regions.hit(ray), pick: { kind: 'map' } },
    ].filter(({ hit, pick }) => hit && !(pick.kind === 'map' && hit.layer === 'regions'));
    picks.sort((a, b) => a.hit.distance - b.hit.distance);
    const first = picks[0] ?? { hit: regions.hit(ray), pick: { kind: 'map' } }; // regions are translucent: objects behind them come first
    if (!first.hit) return inspector.close();
    if (first.pick.kind === 'obstacle') first.pick.id = first.hit.id;
    pickObstacle(first.pick.id);
    const words = { obstacle: (detail) => obstacleInWords(first.hit.id, known, detail.clearance_m), map: () => mapInWords(first.hit, known) };
    inspector.open(first.pick, words[first.pick.kind]);
  },
  orbit(ray) {
    const hit = obstacles.hit(ray);
    if (!hit) return;
    pickObstacle(hit.id);
    const centre = obstacles.where(hit.id, clock.at_us);
    cameras.controls.target.copy(centre);
    controls.setCamera('orbit');
  },
  height: () => known.place?.[2] ?? vehicle.p.z,
  aim: (at) => send({ goal: { mode: 'go', position: at.toArray() } }),
});

// Drawing ------------------------------------------------------------------------------------------------------------

let last = performance.now();
let isFilmed = false; // pictures are requested one by one
let framesDrawn = 0;
let touched = false; // by the user, who may have switched a layer, or cleared the canvas by resizing
for (const event of ['pointerdown', 'pointerup', 'click', 'keydown', 'input', 'change', 'resize']) {
  addEventListener(event, () => (touched = true), { capture: true });
}
function draw(now) {
  if (isFilmed) return;
  picture(now, (now - last) * 1e-3);
  last = now;
  requestAnimationFrame(draw);
}

/** @param now  ms  @param seconds  since the last picture */
function picture(now, seconds) {
  stream.drawn();
  const paused = known.player && !known.player.playing;
  const speed = paused ? 0 : (known.player?.speed ?? known.session?.pace ?? 1);
  const now_us = clock.at_us + (now - clock.arrived_ms) * 1e3 * speed;
  const drawn = { ...proofs.counts, tracks: tracks.count };
  for (const name of ON_DEMAND) showCount(name, layers[name] ? drawn[name] : null);
  vehicle.draw(now_us);
  vehicle.showBody(cameras.mode !== 'first');
  trajectories.draw(now * 1e-3, world.camera, innerHeight);
  if (vehicle.state) {
    const centre = cameras.mode === 'orbit' ? obstacles.where(obstacles.pickedId, now_us) : null;
    cameras.follow(vehicle.p, vehicle.state.v, centre, seconds);
    ghost.draw(flightTime(now_us));
  }
  const isRead = hud.draw(now) || !world.thrifty; // without a GPU every change of a panel costs as much as the scene
  if (isRead) pictures.draw(now_us);
  if (isRead && (vehicle.state || known.player)) showTime(flightTime(known.player?.at_us ?? clock.at_us));
  cameras.update();
  obstacles.draw(now_us, world.camera);
  const size = { width: innerWidth, height: innerHeight };
  tags.show([...obstacles.tags(now_us, world.camera, size), ...tracks.draw(now_us, world.camera, size)]);
  const news = touched || counts.frames !== framesDrawn;
  if (!world.adapt(now, !paused, news)) return;
  touched = false;
  framesDrawn = counts.frames;
  world.render();
  counts.drawn += 1;
}

/** Draws the flight at t, `seconds` after the last picture. For tern-viewer --video. */
function film(t, seconds) {
  if (!isFilmed) document.body.classList.add('film');
  isFilmed = true;
  send({ player: { play: false } });
  jump(t);
  hud.hurry();
  picture(performance.now(), seconds);
}

/** Sets the common cursor of charts, timeline and clock. @param t  s of the flight */
function showTime(t) {
  charts.setNow(t, known.state ? flightTime(known.state.at_us) : t, hud.numbers());
  timeline.setNow(t);
  hud.showClock(t);
  hud.showWhy(known.session?.why, Boolean(known.result) || known.player?.at_us >= known.player?.end_us);
  if (!known.player) return player.show(t, known.chart ? flightSpan(known.chart) : [t, t]);
  player.draw();
  controls.writeLink();
}

/** The state of the page, for the console and the tests. */
window.tern = {
  send,
  known,
  counts,
  charts,
  timeline,
  jump,
  film,
  setCamera: (mode, eye) => controls.setCamera(mode, eye),
  setLayer,
  world,
  status: () => ({
    ...counts,
    obstacles: obstacles.count,
    hulls: proofs.counts.hulls,
    tracks: tracks.count,
    sightings: sight.count,
    planes: proofs.counts.planes,
    nodes: proofs.counts.search,
    regions: regions.group.children.length,
    vehicle: vehicle.state ? vehicle.p.toArray() : null,
    ghost: ghost.ball.visible ? ghost.ball.position.toArray() : null,
    events: timeline.events.length,
    calls: world.renderer.info.render.calls,
  }),
};

const handlers = {
  open() {
    counts.connections += 1;
    sendSubscriptions();
  },
  close: hud.showGone,
  frame: takeFrame,
  reply: takeReply,
  malformed(text, error) {
    counts.malformed += 1;
    console.warn(`a message was not understood (${error.message}): ${text.slice(0, 80)}`);
  },
};
const tape = await readTape();
stream = tape ? new Tape(tape, handlers) : new Stream(`ws://${location.host}/stream`, handlers);
stream.open?.();
requestAnimationFrame(draw);
