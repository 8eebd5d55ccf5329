// SPDX-License-Identifier: MIT
// A server that speaks the contract of viewer/README.md, as far as the page is concerned.
import { createServer } from "node:http";
import { VIEWER } from "./support.mjs";

const DYNAMIC = 2, MOST_BYTES = 1 << 20;

function record(number, kind, size, fill) {
  const bytes = Math.ceil((12 + size) / 4) * 4;
  const buffer = Buffer.alloc(bytes);
  [bytes, number, kind].forEach((value, i) => buffer.writeUInt32LE(value, 4 * i));
  fill(buffer);
  return { number, buffer };
}

const NOT_RECORDED = 3;

export function scanRecord(number, { index, stamp, sensor, places, verdicts }) {
  const n = verdicts.length;
  return record(number, 1, 40 + 13 * n, (b) => {
    b.writeUInt32LE(index, 12);
    b.writeDoubleLE(stamp, 16);
    sensor.forEach((value, c) => b.writeFloatLE(value, 24 + 4 * c));
    const dynamic = verdicts.filter((v) => v === DYNAMIC).length;
    [n - dynamic, dynamic, 0, n].forEach((value, c) => b.writeUInt32LE(value, 36 + 4 * c));
    places.flat().forEach((value, i) => b.writeFloatLE(value, 52 + 4 * i));
    b.set(verdicts.map((v) => v | (NOT_RECORDED << 2) | (v << 4)), 52 + 12 * n);
  });
}

export function correctionRecord(number, { index, verdicts }) {
  return record(number, 2, 8 + verdicts.length, (b) => {
    b.writeUInt32LE(index, 12);
    b.writeUInt32LE(verdicts.length, 16);
    b.set(verdicts, 20);
  });
}

export class LiveServer {
  records = [];
  report = "";
  state = { name: "street, live", input: "recordings/street", total: 60, done: false, newest: 0, version: "0.0.0-test", report: false };
  #server = null;
  #sockets = new Set();

  async start(port = 0) {
    this.#server = createServer((request, answer) => this.#answer(request, answer));
    this.#server.on("connection", (socket) => {
      this.#sockets.add(socket);
      socket.on("close", () => this.#sockets.delete(socket));
    });
    await new Promise((done) => this.#server.listen(port, "127.0.0.1", done));
    this.port = this.#server.address().port;
    return `http://127.0.0.1:${this.port}/`;
  }

  async stop() {
    if (!this.#server.listening) return;
    const closed = new Promise((done) => this.#server.close(done));
    for (const socket of this.#sockets) socket.destroy();
    await closed;
  }

  push(record) {
    this.records.push(record);
    this.state.newest = Math.max(this.state.newest, record.number);
  }

  #answer({ url }, answer) {
    const { pathname, searchParams } = new URL(url, "http://localhost");
    if (pathname === "/state") return answer.end(JSON.stringify(this.state));
    if (pathname === "/live") return answer.writeHead(200, { "Content-Type": "application/octet-stream" }).end(this.#after(Number(searchParams.get("after"))));
    if (pathname === "/report.html" && this.state.report) return answer.writeHead(200, { "Content-Type": "text/html; charset=utf-8" }).end(this.report);
    if (pathname === "/") return answer.writeHead(200, { "Content-Type": "text/html; charset=utf-8" }).end(VIEWER);
    return answer.writeHead(404).end();
  }

  #after(number) {
    const parts = [];
    let bytes = 0;
    for (const { number: own, buffer } of this.records) {
      if (own <= number) continue;
      if (bytes > 0 && bytes + buffer.length > MOST_BYTES) break;
      parts.push(buffer);
      bytes += buffer.length;
    }
    return Buffer.concat(parts);
  }
}
