// Wires the stream to the scene and the panels.
import * as THREE from 'three';
import './style.css';
import { Charts } from './charts.js';
import * as hud from './hud.js';
import { Inspector } from './inspector.js';
import { Obstacles } from './obstacles.js';
import { watchFreeArea } from './panels.js';
import { Player } from './player.js';
import { Proofs } from './proofs.js';
import { Regions } from './regions.js';
import { Stream } from './stream.js';
import { Trajectories } from './trajectories.js';
import { Vehicle } from './vehicle.js';
import { World } from './world.js';

const LAYERS = { regions: true, minvo: true, committed: true, sphere: true, hulls: false, planes: false, search: false };
const ON_DEMAND = ['hulls', 'planes', 'search']; // the bridge makes these only while someone looks

const canvas = document.getElementById('view');
const world = new World(canvas);
watchFreeArea((area) => world.setFree(area));
const regions = new Regions(world.scene);
const trajectories = new Trajectories(world.scene);
const proofs = new Proofs(world.scene);
const vehicle = new Vehicle(world.scene);
const obstacles = new Obstacles(world, vehicle.p);
const charts = new Charts();
const layers = { ...LAYERS };
const known = {}; // the newest of each topic
const counts = { frames: 0, drawn: 0, malformed: 0, connections: 0, dropped: 0, goals: [] };
let clock = { at_us: 0, arrived_ms: 0 }; // the vehicle's clock when its last state came

const stream = new Stream(`ws://${location.host}/stream`, {
  open() {
    counts.connections += 1;
    tellLayers();
  },
  close: hud.showGone,
  frame: takeFrame,
  reply: takeReply,
  malformed(text, error) {
    counts.malformed += 1;
    console.warn(`a message was not understood (${error.message}): ${text.slice(0, 80)}`);
  },
});
const send = (command) => stream.send(command);
const player = new Player(send);
const inspector = new Inspector(send);
inspector.closed = () => pickObstacle(undefined);

/** What each topic does; null takes back what it said. */
const topics = {
  session(session) {
    if (known.session && known.session.epoch !== session.epoch) forget();
    hud.showSession(session);
  },
  player: (state) => player.take(state),
  goal: (goal) => trajectories.takeGoal(goal),
  request(request) {
    if (!request) return;
    trajectories.takeRequest(request);
    vehicle.setRadius(request.radius);
  },
  state(state) {
    if (!state) return vehicle.clear();
    vehicle.take(state);
    clock = { at_us: state.at_us, arrived_ms: performance.now() };
    trajectories.takeState(state);
    if (known.goal) world.head(state.p, known.goal.p);
    hud.takeState(state, known.goal);
  },
  truth: (set) => (set ? obstacles.take(set) : obstacles.clear()),
  tracks(set) {
    if (set && !known.truth) obstacles.take(set); // on an aircraft nobody tells the truth
  },
  plan(plan) {
    if (!plan) return;
    trajectories.takePlan(plan);
    proofs.takePlanes(layers.planes ? plan : null, obstacles.pickedId);
    hud.showPlan(plan);
  },
  timing: (timing) => timing && hud.showTiming(timing),
  result: (result) => hud.showResult(result),
  hulls: (hulls) => proofs.takeHulls(hulls),
  search: (search) => proofs.takeSearch(search),
  map: (map) => (map ? regions.take(map) : regions.clear()),
  health: (processes) => hud.showHealth(processes, (name) => inspector.open({ kind: 'process', name })),
  chart(chart) {
    if (!chart) return;
    charts.take(chart);
    hud.showClock(chart.elapsed_s);
  },
  path(curve) {
    if (curve) trajectories.takePath(curve);
  },
};

function takeFrame(frame) {
  counts.frames += 1;
  counts.dropped = frame.dropped;
  for (const [topic, value] of Object.entries(frame)) {
    if (!topics[topic]) continue;
    try {
      topics[topic](value);
      known[topic] = value;
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

/** Another bridge, another flight. */
function forget() {
  for (const key of Object.keys(known)) delete known[key];
  for (const part of [obstacles, trajectories, proofs, vehicle, regions]) part.clear();
}

// Layers -------------------------------------------------------------------------------------------------------------

function tellLayers() {
  send({ layers: ON_DEMAND.filter((name) => layers[name]) });
}

function setLayer(name, on) {
  layers[name] = on;
  trajectories.show(name, on);
  proofs.show(name, on);
  if (name === 'regions') regions.group.visible = on;
  if (ON_DEMAND.includes(name)) tellLayers();
  if (name === 'search' && on && !known.search) hud.toast('the planner tells with --set planner.publish_search=true');
}

const boxes = document.getElementById('layers');
for (const [name, on] of Object.entries(LAYERS)) {
  const label = document.createElement('label');
  const box = Object.assign(document.createElement('input'), { type: 'checkbox', checked: on, name });
  box.onchange = () => setLayer(name, box.checked);
  label.append(box, name);
  boxes.append(label);
  setLayer(name, on);
}

// Cameras, keys ------------------------------------------------------------------------------------------------------

const cameras = [...document.querySelectorAll('[data-camera]')];
function setCamera(mode) {
  world.setCamera(mode);
  for (const button of cameras) button.classList.toggle('on', button.dataset.camera === mode);
}
for (const button of cameras) button.onclick = () => setCamera(button.dataset.camera);

window.addEventListener('keydown', (event) => {
  if (event.target.matches('input, select, button')) return;
  const action = {
    1: () => setCamera('follow'),
    2: () => setCamera('top'),
    3: () => setCamera('free'),
    g: () => document.getElementById('goalmode').click(),
    ' ': () => player.toggle(),
    ArrowLeft: () => send({ player: { step: -1 } }),
    ArrowRight: () => send({ player: { step: 1 } }),
    Escape: () => inspector.close(),
  }[event.key];
  if (!action) return;
  event.preventDefault();
  action();
});

// Picking and goals --------------------------------------------------------------------------------------------------

const raycaster = new THREE.Raycaster();
let pressed = null;
let aiming = false;

document.getElementById('goalmode').onclick = () => aim(!aiming);
function aim(on) {
  aiming = on;
  document.body.classList.toggle('aiming', on);
  document.getElementById('goalmode').classList.toggle('on', on);
}

function pickObstacle(id) {
  obstacles.pick(id);
  proofs.takePlanes(layers.planes ? known.plan : null, id);
}

function pick() {
  const picks = [
    { hit: vehicle.hit(raycaster), pick: { kind: 'vehicle' } },
    { hit: obstacles.hit(raycaster), pick: { kind: 'obstacle' } },
    { hit: raycaster.intersectObject(trajectories.goal)[0], pick: { kind: 'goal' } },
    { hit: raycaster.intersectObject(trajectories.localGoal)[0], pick: { kind: 'plan' } },
  ].filter(({ hit }) => hit);
  picks.sort((a, b) => a.hit.distance - b.hit.distance);
  const first = picks[0] ?? { hit: regions.hit(raycaster), pick: { kind: 'map' } };
  if (!first.hit) return inspector.close();
  if (first.pick.kind === 'obstacle') first.pick.id = first.hit.id;
  pickObstacle(first.pick.id);
  inspector.open(first.pick);
}

/** The goal is where the ray meets the height of the last goal. */
function sendGoal() {
  const height = known.goal?.p[2] ?? vehicle.p.z;
  const at = raycaster.ray.intersectPlane(new THREE.Plane(new THREE.Vector3(0, 0, 1), -height), new THREE.Vector3());
  if (at) send({ goal: { mode: 'go', position: at.toArray() } });
  aim(false);
}

canvas.addEventListener('pointerdown', (event) => (pressed = [event.clientX, event.clientY]));
canvas.addEventListener('pointerup', (event) => {
  const dragged = !pressed || Math.hypot(event.clientX - pressed[0], event.clientY - pressed[1]) > 4;
  if (dragged || event.button !== 0) return;
  raycaster.setFromCamera(
    new THREE.Vector2((2 * event.clientX) / innerWidth - 1, 1 - (2 * event.clientY) / innerHeight), world.camera);
  if (aiming) sendGoal();
  else pick();
});

// Drawing ------------------------------------------------------------------------------------------------------------

let last = performance.now();
function draw(now) {
  const paused = known.player && !known.player.playing;
  const speed = paused ? 0 : (known.player?.speed ?? 1);
  const now_us = clock.at_us + (now - clock.arrived_ms) * 1e3 * speed;
  vehicle.draw(now_us);
  trajectories.draw(now * 1e-3);
  const seconds = (now - last) * 1e-3;
  last = now;
  if (vehicle.state) world.follow(vehicle.p, seconds);
  world.aim(seconds);
  obstacles.draw(now_us, world.camera);
  world.render();
  hud.draw(now);
  counts.drawn += 1;
  stream.drawn();
  requestAnimationFrame(draw);
}
requestAnimationFrame(draw);

/** For the console and the tests: what the page knows and shows. */
window.tern = {
  send,
  known,
  counts,
  setCamera,
  setLayer,
  world,
  status: () => ({
    ...counts,
    obstacles: obstacles.count,
    hulls: proofs.hullCount,
    planes: proofs.planeCount,
    nodes: proofs.nodeCount,
    regions: regions.group.children.length,
    vehicle: vehicle.state ? vehicle.p.toArray() : null,
    calls: world.renderer.info.render.calls,
  }),
};
