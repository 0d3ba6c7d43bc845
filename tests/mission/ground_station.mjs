// A ground station made of npm's node-mavlink: uploads and downloads missions and fences, starts missions, and checks
// every answer of tern-mission. Usage: node ground_station.mjs PORT
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

const kMission = 0, kFence = 1, kRally = 2; // MAV_MISSION_TYPE
/** Uploads items; returns the result. */
async function upload(items, missionType = kMission) {
  send(common.MissionCount, { count: items.length, missionType });
  for (let k = 0; k < items.length; ++k) {
    assert.equal((await next(common.MissionRequestInt)).seq, k);
    send(common.MissionItemInt, { ...items[k], seq: k, missionType });
  }
  const ack = await next(common.MissionAck);
  assert.equal(ack.missionType, missionType);
  return ack.type;
}
async function download(missionType = kMission) {
  send(common.MissionRequestList, { missionType });
  const { count } = await next(common.MissionCount);
  const items = [];
  for (let seq = 0; seq < count; ++seq) {
    send(common.MissionRequestInt, { seq, missionType });
    items.push(await next(common.MissionItemInt));
  }
  return items;
}
async function clear(missionType) {
  send(common.MissionClearAll, { missionType });
  return (await next(common.MissionAck)).type;
}
/** Waits until the vehicle has said a text. */
async function hear(pattern) {
  for (let heard = said(); !pattern.test(heard); heard += said()) await next(minimal.Heartbeat);
}
/** An item of a fence as QGroundControl sends it: frame 0, no altitude, no autocontinue. */
const fence = (command, size, latitude, longitude) => ({
  command, frame: 0, autocontinue: 0, current: 0, param1: size, param2: 0, param3: 0, param4: 0,
  x: Math.round(latitude * 1e7), y: Math.round(longitude * 1e7), z: 0,
});
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
// What QGroundControl asks first: without MISSION_FENCE it would upload no fences.
send(common.CommandLong, { command: 512, _param1: 148, confirmation: 0 });
assert.equal((await next(common.CommandAck)).result, kAccepted);
assert((BigInt((await next(standard.AutopilotVersion)).capabilities) & 16384n) !== 0n, 'MAV_PROTOCOL_CAPABILITY_MISSION_FENCE');

const field = [[47.397665, 8.545548], [47.397665, 8.545918], [47.397825, 8.545918], [47.397825, 8.545548]];
const fences = [...field.map(([latitude, longitude]) => fence(5001, 4, latitude, longitude)),
  fence(5004, 1.5, 47.397745, 8.5457325), fence(5000, 0, 47.3977, 8.5456)];
said();
assert.equal(await upload(fences, kFence), kAccepted);
assert.equal(await start(0), kDenied);
assert.match(said(), /the uploaded fences are not yet in force/);
await hear(/2 uploaded fences are in force/);
for (const [k, item] of (await download(kFence)).entries()) {
  assert.equal(item.missionType, kFence);
  for (const field of ['command', 'x', 'y', 'param1']) assert.equal(item[field], fences[k][field], `${field} of fence ${k}`);
}
said();
assert.equal(await upload([fence(5004, 2, 47.3977, 8.5456)], kFence), kInvalid);
assert.match(said(), /the vehicle at \(0\.00, 0\.00, 1\.00\) m is in uploaded fence/);
assert.equal(await start(0), kDenied);
assert.match(said(), /the last upload of fences was refused/);
assert.equal(await upload([fence(5004, 2, 47.3977, 8.5458649)], kFence), kInvalid);
assert.match(said(), /waypoint 1 at \(20\.00, 0\.00, 2\.00\) m is in uploaded fence/);
assert.equal(await upload([fence(5003, 0, 47.3977, 8.5458649)], kFence), kInvalid);
assert.match(said(), /MAV_CMD_NAV_FENCE_CIRCLE_INCLUSION \(5003\): a radius of 0 m/);
assert.equal((await download(kFence)).length, fences.length, 'the fences before are kept');
assert.equal(await clear(kFence), kAccepted);
assert.equal((await download(kFence)).length, 0);
assert.equal((await download()).length, mission.length);
send(common.MissionCount, { count: 4, missionType: kRally });
const ack = await next(common.MissionAck);
assert.deepEqual([ack.type, ack.missionType], [kUnsupported, kRally]);
assert.match(said(), /rally points cannot be uploaded/);
assert.equal(await upload([mission[0], { ...speed, param2: 90 }, mission[1]]), kInvalid);
assert.match(said(), /has a speed of 90 m\/s; that of the vehicle is/);
assert.equal(await upload([mission[0], speed, { ...mission[1], command: 82 }]), kInvalid);
assert.match(said(), /MAV_CMD_NAV_SPLINE_WAYPOINT \(82\): cannot be flown/);
assert.equal((await download()).length, 3, 'the mission before is kept');
assert.equal(await start(1), kDenied);
assert.equal(await start(0), kAccepted);
assert.equal(await clear(255), kAccepted);
assert.equal((await download()).length, 0);
console.log('the ground station and tern-mission agree');
process.exit(0);
