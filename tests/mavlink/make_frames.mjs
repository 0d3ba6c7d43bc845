// Prints frames that npm's node-mavlink makes, a line each: key link time hex value value … (key 0: unsigned). Values are
// the fields in wire order, arrays one element after the other, text as one word per byte.
import mavlink from 'node-mavlink';

const ids = [0, 1, 20, 22, 23, 31, 32, 49, 76, 77, 84, 111, 115, 230, 245, 253, 331, 33, 40, 42, 43, 44, 45, 46, 47, 51, 73, 148];
const types = {};
for (const part of [mavlink.minimal, mavlink.standard, mavlink.common]) {
  for (const type of Object.values(part)) if (type?.MSG_ID !== undefined) types[type.MSG_ID] = type;
}

let state = 12345n;
function random(below) {
  state = (state * 6364136223846793005n + 1442695040888963407n) & 0xffffffffffffffffn;
  return Number((state >> 33n) % BigInt(below));
}

// Values at the ends of a type's range, zero, and some between. Floats are exact in 32 bits.
function draw(type) {
  const kind = random(5);
  if (type === 'float') return kind === 0 ? 0 : (random(2000001) - 1000000) / 64;
  const bits = Number(type.match(/int(\d+)/)[1]);
  const low = type.startsWith('u') ? 0n : -(1n << BigInt(bits - 1));
  const high = low + (1n << BigInt(bits)) - 1n;
  const value = [0n, low, high, BigInt(random(100)), low + BigInt(random(1 << 30)) % (high - low)][kind];
  return bits === 64 ? value : Number(value);
}

function fill(message, zeros_from) {
  const values = [];
  message.constructor.FIELDS.forEach((field, index) => {
    const element = field.type.replace('[]', '');
    if (element === 'char') {
      const text = Array.from({ length: random(field.length + 1) }, () => String.fromCharCode(33 + random(94))).join('');
      message[field.name] = text;
      for (let k = 0; k < field.length; ++k) values.push(k < text.length ? text.charCodeAt(k) : 0);
      return;
    }
    const one = () => (element === 'uint8_t_mavlink_version' ? 3 : index >= zeros_from ? (element.includes('64') ? 0n : 0) : draw(element));
    const drawn = Array.from({ length: Math.max(field.length, 1) }, one);
    message[field.name] = field.length > 0 ? drawn : drawn[0];
    values.push(...drawn);
  });
  return values;
}

const key = Buffer.from(Array.from({ length: 32 }, (_, k) => (7 * k + 3) & 255));
const time = Date.UTC(2026, 0, 2, 3, 4, 5);
for (const id of ids) {
  for (let turn = 0; turn < 4; ++turn) {
    const protocol = new mavlink.MavLinkProtocolV2(1 + random(255), 1 + random(255), turn === 3 ? 1 : 0);
    const message = new types[id]();
    const fields = types[id].FIELDS.length;
    const values = fill(message, turn === 1 ? 1 + random(fields) : fields);
    if (values.every((v) => v == 0)) continue; // node-mavlink cuts the last byte, too
    let frame = protocol.serialize(message, random(256));
    const signed = turn === 3;
    if (signed) frame = protocol.sign(frame, 5, key, time);
    console.log([signed ? key.toString('hex') : '0', signed ? 5 : 0, signed ? (time - Date.UTC(2015, 0, 1)) * 100 : 0, frame.toString('hex'), ...values].join(' '));
  }
}
