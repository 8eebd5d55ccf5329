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
const fnv1a = require("./fnv1a.cjs");

/// x, y, z and intensity of each point.
function pointValues(cloud) {
  const view = new DataView(cloud.data.buffer, cloud.data.byteOffset, cloud.data.byteLength);
  const values = [];
  for (let row = 0; row < cloud.height; ++row) {
    for (let i = 0; i < cloud.width; ++i) {
      for (const name of ["x", "y", "z", "intensity"]) {
        const field = cloud.fields.find((f) => f.name === name);
        const at = row * cloud.row_step + i * cloud.point_step + field.offset;
        values.push(field.datatype === 8 ? view.getFloat64(at, true) : view.getFloat32(at, true));
      }
    }
  }
  return values;
}

const poseValues = (at, turn) => [at.x, at.y, at.z, turn.x, turn.y, turn.z, turn.w];

function valuesOf(type, message) {
  switch (type) {
    case "sensor_msgs/PointCloud2":
      return pointValues(message);
    case "nav_msgs/Odometry":
      return poseValues(message.pose.pose.position, message.pose.pose.orientation);
    case "geometry_msgs/PoseStamped":
      return poseValues(message.pose.position, message.pose.orientation);
    case "tf2_msgs/TFMessage": {
      const { translation, rotation } = message.transforms[0].transform;
      return poseValues(translation, rotation);
    }
    default:
      throw new Error(`unexpected type ${type}`);
  }
}

const nanoseconds = (t) => BigInt(t.sec) * 1000000000n + BigInt(t.nsec ?? t.nanosec);

function print(topic, type, recorded, message) {
  const header = (message.transforms?.[0] ?? message).header;
  const values = valuesOf(type, message);
  const frame = header.frame_id;
  const stamp = nanoseconds(header.stamp);
  console.log(`${topic} ${type} ${recorded} ${stamp} ${frame} ${values.length} ${fnv1a(values)}`);
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
