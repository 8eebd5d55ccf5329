// SPDX-License-Identifier: MIT
// The records of /live. Their bytes come over a network: sizes are checked before anything is read.

const HEAD = 12, SCAN_HEAD = 52, CORRECTION_HEAD = 20;
const SCAN = 1, CORRECTION = 2;

const padded = (bytes) => Math.ceil(bytes / 4) * 4;

function scanOf(view, at, bytes) {
  if (bytes < SCAN_HEAD) return null;
  const n = view.getUint32(at + 48, true);
  if (padded(SCAN_HEAD + 13 * n) !== bytes) return null;
  const vector = (from, get) => [0, 4, 8].map((step) => view[get](at + from + step, true));
  const begin = view.byteOffset + at + SCAN_HEAD;
  return {
    index: view.getUint32(at + 12, true),
    stamp: view.getFloat64(at + 16, true),
    sensor: vector(24, "getFloat32"),
    counts: vector(36, "getUint32"),
    positions: new Float32Array(view.buffer.slice(begin, begin + 12 * n)),
    verdicts: new Uint8Array(view.buffer.slice(begin + 12 * n, begin + 13 * n)),
  };
}

function correctionOf(view, at, bytes) {
  if (bytes < CORRECTION_HEAD) return null;
  const n = view.getUint32(at + 16, true);
  if (padded(CORRECTION_HEAD + n) !== bytes) return null;
  const begin = view.byteOffset + at + CORRECTION_HEAD;
  return { index: view.getUint32(at + 12, true), verdicts: new Uint8Array(view.buffer.slice(begin, begin + n)) };
}

/**
 * The records of a body that came after number `after`: {records: [{kind, number, ...}], newest, damaged}. `newest` is what
 * to ask for next: beyond a damaged record too, or it would come again for ever.
 */
export function parseRecords(buffer, after) {
  const view = new DataView(buffer);
  const records = [];
  let newest = after, damaged = 0;
  for (let at = 0; at < view.byteLength;) {
    const left = view.byteLength - at;
    const bytes = left >= HEAD ? view.getUint32(at, true) : 0;
    if (bytes < HEAD || bytes % 4 !== 0 || bytes > left) return { records, newest: newest + 1, damaged: damaged + 1 };
    const number = view.getUint32(at + 4, true), kind = view.getUint32(at + 8, true);
    const content = kind === SCAN ? scanOf(view, at, bytes) : kind === CORRECTION ? correctionOf(view, at, bytes) : undefined;
    if (number <= newest || content === null) ++damaged;
    else if (content) records.push({ kind: kind === SCAN ? "scan" : "correction", number, ...content });
    newest = Math.max(newest, number);
    at += bytes;
  }
  return { records, newest, damaged };
}
