// client_tests.mjs: Foxglove's own client (@foxglove/ws-protocol) at tern-viewer's server, while the known scene flies.
// Run it by client.sh, which installs the packages, in a network namespace of its own.
import ws_protocol from '@foxglove/ws-protocol';
import { parse } from '@foxglove/rosmsg';
import { MessageReader, MessageWriter } from '@foxglove/rosmsg2-serialization';
import assert from 'node:assert/strict';
import { spawn } from 'node:child_process';
import { readFileSync } from 'node:fs';
import http from 'node:http';
import { after, before, test } from 'node:test';
import { WebSocket } from 'ws';

const { FoxgloveClient } = ws_protocol;

const bin = process.env.TERN_BIN;
const PORT = 8791, URL_ = `ws://127.0.0.1:${PORT}`, PATIENCE_MS = 120_000;
const RULE = '='.repeat(80);
const POSE = ['std_msgs/Header header', 'geometry_msgs/Pose pose', RULE, 'MSG: std_msgs/Header', 'builtin_interfaces/Time stamp',
  'string frame_id', RULE, 'MSG: builtin_interfaces/Time', 'int32 sec', 'uint32 nanosec', RULE, 'MSG: geometry_msgs/Pose',
  'geometry_msgs/Point position', 'geometry_msgs/Quaternion orientation', RULE, 'MSG: geometry_msgs/Point', 'float64 x',
  'float64 y', 'float64 z', RULE, 'MSG: geometry_msgs/Quaternion', 'float64 x', 'float64 y', 'float64 z', 'float64 w'].join('\n');

const programs = [], sockets = [];
function start(program, ...args) {
  const child = spawn(`${bin}/${program}`, args, { stdio: ['ignore', 'pipe', 'pipe'] });
  const process_ = { child, said: '' };
  for (const stream of [child.stdout, child.stderr]) stream.on('data', (text) => (process_.said += text));
  programs.push(process_);
  return process_;
}

async function eventually(what, holds) {
  for (const deadline = Date.now() + PATIENCE_MS; !holds(); ) {
    assert(Date.now() < deadline, `not in time: ${what instanceof Function ? what() : what}`);
    await new Promise((resolve) => setTimeout(resolve, 20));
  }
}

/** A client that has the server's channels; `newest` is the newest message of each topic, `statuses` what it was told. */
async function connect(subprotocol = 'foxglove.sdk.v1', url = URL_) {
  const ws = new WebSocket(url, [subprotocol]);
  sockets.push(ws);
  const client = new FoxgloveClient({ ws });
  const c = { ws, client, channels: new Map(), subscriptions: new Map(), newest: new Map(), counts: new Map(), statuses: [] };
  client.on('serverInfo', (info) => (c.info = info));
  client.on('advertise', (channels) => channels.forEach((channel) => c.channels.set(channel.topic, channel)));
  client.on('status', (status) => c.statuses.push(status));
  client.on('error', (error) => (c.error = error));
  client.on('message', ({ subscriptionId, timestamp, data }) => {
    const { topic, reader } = c.subscriptions.get(subscriptionId);
    c.newest.set(topic, { timestamp, value: reader.readMessage(data) });
    c.counts.set(topic, (c.counts.get(topic) ?? 0) + 1);
  });
  c.subscribe = (topic) => {
    const { id, schema, encoding, schemaEncoding } = c.channels.get(topic);
    assert.deepEqual([encoding, schemaEncoding], ['cdr', 'ros2msg']);
    c.subscriptions.set(client.subscribe(id), { topic, reader: new MessageReader(parse(schema, { ros2: true })) });
  };
  await eventually('the server tells its channels', () => c.channels.size > 0 || c.error);
  assert.equal(c.error, undefined);
  return c;
}

/** The status of an HTTP answer to a request for a WebSocket with these headers. */
function refusal(headers) {
  return new Promise((resolve) => {
    http.get({ port: PORT, host: '127.0.0.1', headers: { Connection: 'Upgrade', Upgrade: 'websocket', 'Sec-WebSocket-Version': '13',
      'Sec-WebSocket-Key': 'dGhlIHNhbXBsZSBub25jZQ==', 'Sec-WebSocket-Protocol': 'foxglove.sdk.v1', ...headers } },
    (response) => resolve(response.statusCode)).on('upgrade', (response) => resolve(response.statusCode));
  });
}

const pose = (x, y, z, frame_id = 'map') => ({ header: { stamp: { sec: 0, nanosec: 0 }, frame_id },
  pose: { position: { x, y, z }, orientation: { x: 0, y: 0, z: 0, w: 1 } } });
const cdr = (message) => new MessageWriter(parse(POSE, { ros2: true })).writeMessage(message);
const json = (message) => new TextEncoder().encode(JSON.stringify(message));

let viewer, scene;
before(async () => {
  viewer = start('tern-viewer', '--listen', '127.0.0.1:8790', '--foxglove', `${PORT}`, '--allow-goals');
  await eventually('tern-viewer listens', () => /Foxglove connects to/.test(viewer.said) || viewer.child.exitCode !== null);
  assert.equal(viewer.child.exitCode, null, viewer.said);
  scene = start('viewer_known_scene_process');
});
after(() => {
  sockets.forEach((ws) => ws.terminate()); // without, each waits half a minute for the server's farewell
  programs.forEach(({ child }) => child.kill('SIGKILL'));
});

test('a client reads every topic of a flight by the definitions that the server sends', async () => {
  const c = await connect('foxglove.websocket.v1');
  assert.deepEqual(c.info.capabilities, ['clientPublish']);
  const topics = ['/odom', '/tf', '/plan', '/trajectory', '/map_cloud', '/tern/obstacles', '/tern/committed', '/tern/plan',
    '/tern/hulls', '/tern/regions', '/PLAN', '/UAV_STATE', '/HORIZON_REQUEST', '/HEARTBEAT'];
  topics.forEach(c.subscribe);
  const missing = () => topics.filter((topic) => !c.newest.has(topic));
  await eventually(() => `messages of ${missing()}`, () => missing().length === 0);
  const plan = c.newest.get('/plan').value, from = plan.poses[0].pose.position;
  assert(plan.poses.length > 5 && Number.isFinite(from.x));
  assert.equal(c.newest.get('/odom').value.header.frame_id, 'map');
  assert(c.newest.get('/tern/obstacles').value.entities[0].cubes.length > 0);
  assert(c.newest.get('/PLAN').value.control_points.length === c.newest.get('/PLAN').value.control_point_count);
  assert(c.newest.get('/odom').timestamp > 1_000_000_000n * 1_000_000_000n, 'the time is nanoseconds since the epoch');
  c.client.close();
});

test('a topic without subscribers is not sent, and a subscription ends', async () => {
  const c = await connect();
  c.subscribe('/odom');
  c.subscribe('/tf');
  await eventually('both come', () => c.counts.get('/odom') > 2 && c.counts.get('/tf') > 2);
  const [id] = [...c.subscriptions].find(([, { topic }]) => topic === '/odom');
  c.client.unsubscribe(id);
  const tf = c.counts.get('/tf');
  await eventually('the other goes on', () => c.counts.get('/tf') > tf + 20);
  const odom = c.counts.get('/odom'), later = c.counts.get('/tf');
  await eventually('the other goes on', () => c.counts.get('/tf') > later + 20);
  assert.equal(c.counts.get('/odom'), odom);
  c.client.close();
});

test('a goal is published as CDR and as JSON, and reaches the bus', async () => {
  const c = await connect();
  for (const [encoding, write, x] of [['cdr', cdr, 3.5], ['json', json, 4.25]]) {
    const channel = c.client.advertise({ topic: '/goal_pose', encoding, schemaName: 'geometry_msgs/msg/PoseStamped' });
    c.client.sendMessage(channel, write(pose(x, -1.5, 2.0)));
    await eventually(`${encoding}: the goal is on the bus`, () => scene.said.includes(`${x.toFixed(3)} -1.500 2.000`));
  }
  assert(c.statuses.every(({ level }) => level === 0), JSON.stringify(c.statuses));
  c.client.close();
});

test('a goal at the ground of the 3D panel is refused before the first request, or flown at the height of the vehicle', async () => {
  const fox = async (port, ...options) => {
    start('tern-viewer', '--listen', `127.0.0.1:${port}`, '--foxglove', `${port + 1}`, '--allow-goals', ...options);
    await eventually('it listens', () => programs.at(-1).said.includes('Foxglove connects to'));
    return connect('foxglove.sdk.v1', `ws://127.0.0.1:${port + 1}`);
  };
  const send = (c) => c.client.sendMessage(c.client.advertise({ topic: '/goal_pose', encoding: 'json', schemaName: 'geometry_msgs/msg/PoseStamped' }),
    json(pose(5.5, 0.5, 0)));
  const boxed = await fox(8800, '--channel-suffix', '_quiet', '--set', 'uav.start=[0, 0, 1]', '--set', 'uav.goal=[6, 0, 1]',
    '--set', 'uav.flight_box.min=[-9, -9, 0]', '--set', 'uav.flight_box.max=[9, 9, 4]'); // it hears no request
  send(boxed);
  await eventually('it is refused', () => boxed.statuses.some(({ message }) => /goal refused: .*flight box/.test(message)));
  const keeping = await fox(8810, '--goal-height', 'keep');
  keeping.subscribe('/odom');
  await eventually('the vehicle is known', () => keeping.newest.has('/odom'));
  const height = keeping.newest.get('/odom').value.pose.pose.position.z;
  send(keeping);
  await eventually('it is sent at that height', () => scene.said.includes(`5.500 0.500 ${height.toFixed(3)}`));
  for (const { client } of [boxed, keeping]) client.close();
});

test('a goal that is none is refused in words, and changes nothing', async () => {
  const c = await connect();
  const before_ = scene.said.split('\n').filter((line) => line.startsWith('goal')).map((line) => line.split(' ').slice(2).join(' '));
  const known = new Set(before_);
  const of = (topic, encoding, schemaName, data) =>
    c.client.sendMessage(c.client.advertise({ topic, encoding, schemaName }), data);
  const type = 'geometry_msgs/msg/PoseStamped';
  of('/goal_pose', 'cdr', type, cdr(pose(NaN, 0, 1)));
  of('/goal_pose', 'cdr', type, cdr(pose(9, 0, 1, 'odom')));
  of('/goal_pose', 'cdr', type, cdr(pose(9, 0, 1)).subarray(0, 40));
  of('/goal_pose', 'json', type, json({ pose: { position: { x: 9, y: 'north', z: 1 } } }));
  of('/goal_pose', 'json', 'std_msgs/msg/String', json({ data: 'go' }));
  of('/cmd_vel', 'json', type, json(pose(9, 9, 1)));
  of('/goal_pose', 'cdr', type, cdr(pose(1e7, 0, 1)));
  await eventually('each is refused', () => c.statuses.length >= 7);
  assert(c.statuses.every(({ level, message }) => level === 2 && message.startsWith('goal refused: ')), JSON.stringify(c.statuses));
  const goals = scene.said.split('\n').filter((line) => line.startsWith('goal')).map((line) => line.split(' ').slice(2).join(' '));
  assert.deepEqual(goals.filter((goal) => !known.has(goal)), []);
  c.client.close();
});

test('foreign pages, other hosts and other subprotocols are refused', async () => {
  assert.equal(await refusal({ Origin: 'https://app.foxglove.dev' }), 403);
  assert.equal(await refusal({ Host: 'tern.example' }), 403);
  assert.equal(await refusal({ 'Sec-WebSocket-Protocol': 'chat' }), 400);
  assert.equal(await refusal({}), 101);
});

test('a stopped client and one that floods cost the viewer no memory and others no message', async () => {
  const memory = () => Number(/VmRSS:\s+(\d+)/.exec(readFileSync(`/proc/${viewer.child.pid}/status`))[1]) / 1024;
  const stopped = await connect(), flood = await connect(), c = await connect();
  for (const topic of stopped.channels.keys()) stopped.subscribe(topic);
  stopped.ws._socket.pause();
  const at_first = memory();
  for (let k = 0; k < 20_000; k++) flood.ws.send(k % 3 === 0 ? '{"op":' : k % 3 === 1 ? '{"op":"getParameters"}' : Buffer.alloc(9, k));
  c.subscribe('/tern/plan');
  await eventually('a hundred plans', () => c.counts.get('/tern/plan') > 100);
  const more = memory() - at_first;
  assert(more < 60, `${more.toFixed(1)} MB more`);
  assert.equal(viewer.child.exitCode, null);
  for (const { client } of [stopped, flood, c]) client.close();
});
