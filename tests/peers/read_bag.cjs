// SPDX-License-Identifier: MIT
// Prints what others' readers find in a bag, as write_bags prints what it wrote: for each message
// topic, type, time of recording, stamp, frame, and the number and FNV-1a of its values.
"use strict";
const fs = require("node:fs");
const { McapIndexedReader, McapStreamReader } = require("@mcap/core");
const { loadDecompressHandlers } = require("@mcap/support");
const { Bag } = require("@foxglove/rosbag");
const { FileReader } = require("@foxglove/rosbag/node");
const { parse, md5 } = require("@foxglove/rosmsg");
const { MessageReader } = require("@foxglove/rosmsg2-serialization");
const { describe, nanoseconds } = require("./message_values.cjs");

function print(topic, type, recorded, message) {
  console.log(describe(topic, type, recorded, message));
}

/// Both ways through the file: by its index, and from front to back with all checksums.
async function readMcap(path) {
  const bytes = fs.readFileSync(path);
  const decompressHandlers = await loadDecompressHandlers();
  const readable = {
    size: async () => BigInt(bytes.length),
    read: async (offset, size) => bytes.subarray(Number(offset), Number(offset + size)),
  };
  const reader = await McapIndexedReader.Initialize({ readable, decompressHandlers });
  const readers = new Map();
  for (const channel of reader.channelsById.values()) {
    if (!channel.metadata.get("offered_qos_profiles")) throw new Error("no offered_qos_profiles");
    const schema = reader.schemasById.get(channel.schemaId);
    const definition = parse(new TextDecoder().decode(schema.data), { ros2: true });
    readers.set(channel.id, new MessageReader(definition));
  }
  let count = 0;
  for await (const message of reader.readMessages()) {
    const channel = reader.channelsById.get(message.channelId);
    const type = reader.schemasById.get(channel.schemaId).name.replace("/msg/", "/");
    print(channel.topic, type, message.logTime,
          readers.get(channel.id).readMessage(message.data));
    ++count;
  }
  const stream = new McapStreamReader({ decompressHandlers, validateCrcs: true });
  stream.append(bytes);
  let streamed = 0;
  for (let record; (record = stream.nextRecord()); ) streamed += record.type === "Message" ? 1 : 0;
  const declared = Number(reader.statistics.messageCount);
  if (!stream.done() || streamed !== count || declared !== count) {
    throw new Error(`${count} messages by index, ${streamed} in the file, ${declared} declared`);
  }
}

async function readRosbag(path) {
  const handlers = await loadDecompressHandlers();
  const decompress = { lz4: (buffer, size) => handlers.lz4(buffer, BigInt(size)) };
  const bag = new Bag(new FileReader(path), { decompress, parse: true });
  await bag.open();
  for (const connection of bag.connections.values()) {
    const sum = md5(parse(connection.messageDefinition));
    if (sum !== connection.md5sum) {
      throw new Error(`${connection.type}: md5 ${sum}, but the bag has ${connection.md5sum}`);
    }
  }
  for await (const event of bag.messageIterator()) {
    const type = bag.connections.get(event.connectionId).type;
    print(event.topic, type, nanoseconds(event.timestamp), event.message);
  }
}

const path = process.argv[2];
(path.endsWith(".mcap") ? readMcap(path) : readRosbag(path)).catch((error) => {
  console.error(error);
  process.exit(1);
});
