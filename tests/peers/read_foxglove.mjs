// SPDX-License-Identifier: MIT
// read_foxglove.mjs SERVER ENCODING: starts SERVER, and compares what Foxglove's client receives
// and decodes with what SERVER says that it sends.
import { spawn } from "node:child_process";
import { once } from "node:events";
import { createInterface } from "node:readline";
import protocol from "@foxglove/ws-protocol";
import { parse } from "@foxglove/rosmsg";
import { MessageReader as Ros1Reader } from "@foxglove/rosmsg-serialization";
import { MessageReader as Ros2Reader } from "@foxglove/rosmsg2-serialization";
import { WebSocket } from "ws";
import values from "./message_values.cjs";

const PATIENCE_MS = 60000;

function readerOf({ encoding, schema, schemaEncoding }) {
  if (encoding === "ros1" && schemaEncoding === "ros1msg") return new Ros1Reader(parse(schema));
  if (encoding === "cdr" && schemaEncoding === "ros2msg") {
    return new Ros2Reader(parse(schema, { ros2: true }));
  }
  throw new Error(`unexpected ${encoding} with ${schemaEncoding}`);
}

/// The lines that the server prints, and its address after them.
async function announced(server) {
  const lines = [];
  for await (const line of createInterface({ input: server.stdout })) {
    if (line.startsWith("ws://")) return { lines, url: line };
    lines.push(line);
  }
  throw new Error("the server ended before it said its address");
}

/// A line for each message, until there are `count` and the server has refused a topic of ours.
function received(url, subprotocol, count) {
  return new Promise((resolve, reject) => {
    const client = new protocol.FoxgloveClient({ ws: new WebSocket(url, [subprotocol]) });
    const lines = [];
    const channels = new Map();
    let refusals = 0;
    const finishIfComplete = () => {
      if (lines.length < count || refusals === 0) return;
      client.close();
      resolve(lines);
    };
    client.on("error", reject);
    client.on("close", () => reject(new Error(`closed after ${lines.length} of ${count}`)));
    client.on("serverInfo", ({ capabilities }) => {
      if (capabilities.length > 0) reject(new Error(`unexpected ${capabilities}`));
      client.advertise({ topic: "/cmd_vel", encoding: "json", schemaName: "a" });
    });
    client.on("advertise", (list) => {
      for (const channel of list) {
        const type = channel.schemaName.replace("/msg/", "/");
        const { topic } = channel;
        channels.set(client.subscribe(channel.id), { topic, type, reader: readerOf(channel) });
      }
    });
    client.on("status", ({ level, message }) => {
      if (level !== protocol.StatusLevel.WARNING) reject(new Error(message));
      ++refusals;
      finishIfComplete();
    });
    client.on("message", ({ subscriptionId, timestamp, data }) => {
      const { topic, type, reader } = channels.get(subscriptionId);
      lines.push(values.describe(topic, type, timestamp, reader.readMessage(data)));
      finishIfComplete();
    });
  });
}

async function compare(program, encoding, subprotocol) {
  const server = spawn(program, [encoding], { stdio: ["pipe", "pipe", "inherit"] });
  try {
    const { lines, url } = await announced(server);
    const found = (await received(url, subprotocol, lines.length)).sort().join("\n");
    const expected = lines.sort().join("\n");
    if (found !== expected) throw new Error(`expected:\n${expected}\nfound:\n${found}`);
    console.log(`${lines.length} messages are the same`);
  } finally {
    server.stdin.end();
    await once(server, "exit");
  }
}

const [program, encoding] = process.argv.slice(2);
const watch = setTimeout(() => {
  console.error("nothing more comes");
  process.exit(1);  // the server ends with its standard input
}, PATIENCE_MS);
for (const subprotocol of ["foxglove.websocket.v1", "foxglove.sdk.v1"]) {
  await compare(program, encoding, subprotocol);
}
clearTimeout(watch);
