// check_mcap.mjs FILE TABLES: reads an MCAP file with @mcap/core and @foxglove/rosmsg2-serialization, by the definitions that it
// carries. Every field of Tern's own messages is compared with the tables that tern-export wrote. Prints its topics.
import { McapIndexedReader, McapStreamReader } from "@mcap/core";
import { parse } from "@foxglove/rosmsg";
import { MessageReader } from "@foxglove/rosmsg2-serialization";
import { decompress } from "fzstd";
import assert from "node:assert/strict";
import { createReadStream, existsSync, readFileSync } from "node:fs";
import { open } from "node:fs/promises";

const [file_name, tables] = process.argv.slice(2);
const schemas = new Map(), channels = new Map(), counts = new Map();
let statistics, footer, last = 0n, compared = 0;

// Tables of one channel, a row at a time: [column without unit, cell] of each.
const rows = new Map();
function row_of(topic, k) {
  if (!rows.has(topic)) {
    const path = `${tables}/${topic.slice(1)}.csv`;
    const lines = existsSync(path) && !readFileSync(path, "utf8").includes('"') ? readFileSync(path, "utf8").trimEnd().split("\n") : [];
    rows.set(topic, { head: (lines.shift() ?? "").split(",").map((name) => name.split(" ")[0]), lines });
  }
  const { head, lines } = rows.get(topic);
  return lines.length === 0 ? [] : lines[k].split(",").map((cell, column) => [head[column], cell]).slice(2);
}

function compare(topic, k, message) {
  for (const [name, cell] of row_of(topic, k)) {
    let value = message;
    for (const part of name.split(".")) value = value?.[part];
    const place = `${topic} ${k} ${name}: ${value} is not ${cell}`;
    const wanted = { inf: Infinity, "-inf": -Infinity, nan: NaN }[cell] ?? Number(cell);
    if (typeof value === "number") assert(Object.is(value, wanted) || Math.abs(value - wanted) < 1e-9, place);
    else if (typeof value === "bigint") assert.equal(value, BigInt(cell), place);
    else assert.equal(String(value), cell, place);
    compared++;
  }
}

const decompressHandlers = { zstd: (packed, size) => decompress(packed, new Uint8Array(Number(size))) };
const reader = new McapStreamReader({ validateCrcs: true, decompressHandlers });
for await (const bytes of createReadStream(file_name)) {
  reader.append(bytes);
  for (let record; (record = reader.nextRecord()); ) {
    if (record.type === "Header") assert.equal(record.profile, "ros2");
    else if (record.type === "Schema") {
      assert.equal(record.encoding, "ros2msg");
      const definition = parse(new TextDecoder().decode(record.data), { ros2: true });
      schemas.set(record.id, { name: record.name, reader: new MessageReader(definition) });
    } else if (record.type === "Channel") {
      assert.equal(record.messageEncoding, "cdr");
      channels.set(record.id, record);
    } else if (record.type === "Message") {
      const { topic, schemaId } = channels.get(record.channelId);
      const k = Number(counts.get(record.channelId) ?? 0n);
      compare(topic, k, schemas.get(schemaId).reader.readMessage(record.data));
      counts.set(record.channelId, BigInt(k + 1));
      if (record.logTime > last) last = record.logTime;
    } else if (record.type === "Statistics") statistics = record;
    else if (record.type === "Footer") footer = record;
  }
}
assert(reader.done() && footer?.summaryStart > 0n, "the file has no proper end");
assert.deepEqual([...statistics.channelMessageCounts].sort(), [...counts].sort());
assert.equal(statistics.messageEndTime, last);
assert(compared > 1000, `only ${compared} fields compared`);

// Reads it again by its index, as Foxglove does.
const file = await open(file_name);
const readable = {
  size: async () => BigInt((await file.stat()).size),
  read: async (offset, size) => (await file.read(Buffer.alloc(Number(size)), 0, Number(size), Number(offset))).buffer,
};
const indexed = await McapIndexedReader.Initialize({ readable, decompressHandlers });
const plans = [...channels.values()].find(({ topic }) => topic === "/PLAN");
let found = 0n;
for await (const message of indexed.readMessages({ topics: ["/PLAN"], validateCrcs: true })) {
  assert.equal(message.channelId, plans.id);
  found++;
}
assert.equal(found, counts.get(plans.id));
await file.close();

for (const { id, topic, schemaId } of channels.values()) console.log(`${topic} ${schemas.get(schemaId).name} ${counts.get(id)}`);
