// check_mcap.mjs FILE: reads an MCAP file with @mcap/core, compares it with the format of tern-export, and prints its topics.
import { McapIndexedReader, McapStreamReader } from "@mcap/core";
import { decompress } from "fzstd";
import assert from "node:assert/strict";
import { createReadStream } from "node:fs";
import { open } from "node:fs/promises";

const schemas = new Map(), channels = new Map(), counts = new Map();
let statistics, footer, last = 0n, drawn = 0;

function fits(schema, value, at) {
  const kinds = [schema.type].flat(), kind = value === null ? "null" : Array.isArray(value) ? "array" : typeof value;
  const ok = kinds.includes(kind) || (kinds.includes("integer") && Number.isInteger(value));
  assert(ok, `${at} is ${kind}, its schema says ${kinds}`);
  if (kind === "object") for (const [name, part] of Object.entries(schema.properties)) fits(part, value[name], `${at}.${name}`);
  if (kind === "array") value.forEach((item, k) => fits(schema.items, item, `${at}[${k}]`));
}

const decompressHandlers = { zstd: (packed, size) => decompress(packed, new Uint8Array(Number(size))) };
const reader = new McapStreamReader({ validateCrcs: true, decompressHandlers });
for await (const bytes of createReadStream(process.argv[2])) {
  reader.append(bytes);
  for (let record; (record = reader.nextRecord()); ) {
    if (record.type === "Schema") {
      assert.equal(record.encoding, "jsonschema");
      schemas.set(record.id, JSON.parse(new TextDecoder().decode(record.data)));
    } else if (record.type === "Channel") {
      assert.equal(record.messageEncoding, "json");
      channels.set(record.id, record);
    } else if (record.type === "Message") {
      const { topic, schemaId } = channels.get(record.channelId);
      const schema = schemas.get(schemaId), message = JSON.parse(new TextDecoder().decode(record.data));
      fits(schema, message, topic);
      if (schema.title.startsWith("foxglove.")) drawn++;
      counts.set(record.channelId, (counts.get(record.channelId) ?? 0n) + 1n);
      if (record.logTime > last) last = record.logTime;
    } else if (record.type === "Statistics") statistics = record;
    else if (record.type === "Footer") footer = record;
  }
}
assert(reader.done() && footer?.summaryStart > 0n, "the file has no proper end");
assert.deepEqual([...statistics.channelMessageCounts].sort(), [...counts].sort());
assert.equal(statistics.messageEndTime, last);
assert(drawn > 0, "nothing for Foxglove to draw");

// Reads it again by its index, as Foxglove does.
const file = await open(process.argv[2]);
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

for (const { id, topic, schemaId } of channels.values()) console.log(`${topic} ${schemas.get(schemaId).title} ${counts.get(id)}`);
