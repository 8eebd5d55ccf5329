// SPDX-License-Identifier: MIT
// Asks the server that the page came from, for as long as the page is open.
import { parseRecords } from "./live_records.js";

const PAUSE = 150, STATE_EVERY = 1000;  // ms
const FIRST_DELAY = 500, LONGEST_DELAY = 5000;  // ms, between tries while nothing answers
const PATIENCE = 10_000;  // ms for an answer

const sleep = (ms) => new Promise((done) => setTimeout(done, ms));

async function get(path) {
  const answer = await fetch(path, { cache: "no-store", signal: AbortSignal.timeout(PATIENCE) });
  if (!answer.ok) throw new Error(`${path}: ${answer.status}`);
  return answer;
}

/** Tells `state(json)`, `records(list, {skipped, damaged})`, `lost(error)` and `back()`. Ends when the run is done and read. */
export async function follow({ state, records, lost, back }) {
  let after = 0, delay = 0, latest = null, askedAt = -Infinity;
  for (;;) {
    try {
      if (performance.now() - askedAt > STATE_EVERY) {
        latest = await (await get("/state")).json();
        askedAt = performance.now();
        if (latest.newest < after) return location.reload();  // another run is behind the address now
        state(latest);
      }
      const body = await (await get(`/live?after=${after}`)).arrayBuffer();
      if (delay > 0) back();
      delay = 0;
      if (body.byteLength > 0) {
        const parsed = parseRecords(body, after);
        const known = parsed.records.length + parsed.damaged;
        records(parsed.records, { skipped: Math.max(0, parsed.newest - after - known), damaged: parsed.damaged });
        after = parsed.newest;
      } else if (latest?.done && latest.report && latest.newest <= after) {
        return undefined;
      } else {
        await sleep(PAUSE);
      }
    } catch (error) {
      if (delay === 0) lost(error);
      delay = Math.min(LONGEST_DELAY, Math.max(FIRST_DELAY, 2 * delay));
      askedAt = -Infinity;
      await sleep(delay);
    }
  }
}
