// A ground station made of npm's node-mavlink: uploads, downloads and starts missions, and checks every answer of
// tern-mission. Usage: node ground_station.mjs PORT
import assert from 'node:assert/strict';
import { createSocket } from 'node:dgram';
import { PassThrough } from 'node:stream';
import mavlink from 'node-mavlink';

const { minimal, standard, common, MavLinkPacketParser, MavLinkPacketSplitter, MavLinkProtocolV2 } = mavlink;
const kAccepted = 0, kUnsupported = 3, kInvalid = 5, kDenied = 2; // MAV_MISSION_RESULT; the last one is a MAV_RESULT
const kPatienceMs = 20_000;
const registry = { ...minimal.REGISTRY, ...standard.REGISTRY, ...common.REGISTRY };
const protocol = new MavLinkProtocolV2(255, 190);
const socket = createSocket('udp4');
const bytes = new PassThrough();
const received = []; // messages that nobody has asked for yet
let asks = null; // the message that is awaited
let vehicle = null; // its address
let sequence = 0;

socket.on('message', (datagram, from) => {
  vehicle = from;
  bytes.write(datagram);
});
bytes.pipe(new MavLinkPacketSplitter()).pipe(new MavLinkPacketParser()).on('data', (packet) => {
  const type = registry[packet.header.msgid];
  if (type === undefined) return;
  received.push(packet.protocol.data(packet.payload, type));
  asks?.();
});

/** Returns the next message of a type; those before it are passed over, but the texts of STATUSTEXT are kept. */
const texts = [];
async function next(type) {
  const deadline = Date.now() + kPatienceMs;
  for (;;) {
    while (received.length > 0) {
      const message = received.shift();
      if (message instanceof common.StatusText) texts.push([message.id, message.chunkSeq, message.text]);
      if (message instanceof type) return message;
    }
    const left = deadline - Date.now();
    assert(left > 0, `no ${type.name} within ${kPatienceMs} ms`);
    await new Promise((resolve) => {
      const timer = setTimeout(resolve, left);
      asks = () => {
        clearTimeout(timer);
        asks = null;
        resolve();
      };
    });
  }
}
/** Returns what the vehicle has said since the last call. */
const said = () => texts.splice(0).map(([, , text]) => text).join('');

function send(Type, fields) {
  const message = Object.assign(new Type(), { targetSystem: 1, targetComponent: 1, missionType: 0 }, fields);
  socket.send(protocol.serialize(message, sequence++ & 255), vehicle.port, vehicle.address);
}
const waypoint = (latitude, longitude, altitude) => ({
  command: 16, frame: 6, autocontinue: 1, current: 0, param1: 0, param2: 0, param3: 0, param4: NaN,
  x: Math.round(latitude * 1e7), y: Math.round(longitude * 1e7), z: altitude,
});
const speed = { command: 178, frame: 2, autocontinue: 1, current: 0, param1: 1, param2: 3, param3: -1, param4: 0, x: 0, y: 0, z: 0 };

/** Uploads items; returns the result. */
async function upload(items) {
  send(common.MissionCount, { count: items.length });
  for (let k = 0; k < items.length; ++k) {
    assert.equal((await next(common.MissionRequestInt)).seq, k);
    send(common.MissionItemInt, { ...items[k], seq: k });
  }
  return (await next(common.MissionAck)).type;
}
async function download() {
  send(common.MissionRequestList, {});
  const { count } = await next(common.MissionCount);
  const items = [];
  for (let seq = 0; seq < count; ++seq) {
    send(common.MissionRequestInt, { seq });
    items.push(await next(common.MissionItemInt));
  }
  return items;
}
async function start(first) {
  send(common.CommandLong, { command: 300, _param1: first, _param2: 0, confirmation: 0 });
  return (await next(common.CommandAck)).result;
}

socket.bind(Number(process.argv[2]), '127.0.0.1');
await next(minimal.Heartbeat);
const mission = [waypoint(47.3977, 8.5458649, 2), waypoint(47.3977899, 8.5458649, 3), waypoint(47.3977, 8.5456, 1)];
let result = await upload(mission);
while (result !== kAccepted) { // until the mapper has sent its map
  assert.match(said(), /no map yet/);
  await next(minimal.Heartbeat);
  result = await upload(mission);
}
for (const [k, item] of (await download()).entries()) {
  for (const field of ['command', 'x', 'y', 'z']) assert.equal(item[field], mission[k][field], `${field} of item ${k}`);
}
said();
for (const missionType of [1, 2]) { // fences, rally points
  send(common.MissionCount, { count: 4, missionType });
  const ack = await next(common.MissionAck);
  assert.deepEqual([ack.type, ack.missionType], [kUnsupported, missionType]);
  assert.match(said(), /fences and rally points cannot be uploaded/);
}
assert.equal(await upload([mission[0], { ...speed, param2: 90 }, mission[1]]), kInvalid);
assert.match(said(), /has a speed of 90 m\/s; that of the vehicle is/);
assert.equal(await upload([mission[0], speed, { ...mission[1], command: 82 }]), kInvalid);
assert.match(said(), /MAV_CMD_NAV_SPLINE_WAYPOINT \(82\): cannot be flown/);
assert.equal((await download()).length, 3, 'the mission before is kept');
assert.equal(await start(1), kDenied);
assert.equal(await start(0), kAccepted);
send(common.MissionClearAll, { missionType: 255 });
assert.equal((await next(common.MissionAck)).type, kAccepted);
assert.equal((await download()).length, 0);
console.log('the ground station and tern-mission agree');
process.exit(0);
