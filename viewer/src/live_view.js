// SPDX-License-Identifier: MIT
// Scans as they come: the newest bright, what stayed of all others below it.
import { Cloud } from "./cloud.js";
import { CloudView, midstOf } from "./cloud_view.js";
import { finalOf } from "./data.js";
import { Ring } from "./ring.js";

const RECENT = 3_000_000;  // newest points
const OLDER = 750_000, EVERY = 8;  // and of all points every eighth, which lasts twice as long
const COLOURINGS = ["verdict", "instant", "height"];
const PATH_EVERY = 5;  // scans, after which the line is made anew

function thinnedBy(every, positions, verdicts) {
  const n = Math.floor(verdicts.length / every);
  const result = { positions: new Float32Array(3 * n), verdicts: new Uint8Array(n) };
  for (let i = 0; i < n; ++i) {
    for (let c = 0; c < 3; ++c) result.positions[3 * i + c] = positions[3 * i * every + c];
    result.verdicts[i] = verdicts[i * every];
  }
  return result;
}

/** A verdict given at once stands until it is corrected. */
const atOnce = (verdict) => (verdict & 0b1111) | (finalOf(verdict) << 4);

export class LiveView extends CloudView {
  scans = [];  // {index, stamp, sensor, counts, n, recent, older}, where recent and older are begins in the rings, or -1

  constructor(name, element, orbit) {
    super({ meta: { name, scans: 0, live: true }, arrays: {} }, element, orbit, [0, 0, 0]);
    this.midst = [[-20, -20, -2], [20, 20, 6]];
    this.addCloud("recent", new Ring(RECENT));
    this.addCloud("older", new Ring(OLDER));
    const { recent } = this.clouds;
    const scan = new Cloud({ positions: recent.positions, verdicts: recent.verdicts, low: recent.low, step: recent.step, shares: recent });
    scan.setRange(0, 0);
    this.addCloud("scan", scan);
    this.corrected = 0;
  }

  get #rings() {
    return { recent: this.clouds.recent, older: this.clouds.older };
  }

  takeScan({ index, stamp, sensor, counts, positions, verdicts }) {
    const said = verdicts.map(atOnce).subarray(0, RECENT);
    const few = thinnedBy(EVERY, positions, said);
    const scan = { index, stamp, sensor, counts, n: said.length, recent: -1, older: -1 };
    scan.recent = this.#write("recent", positions.subarray(0, 3 * said.length), said);
    scan.older = this.#write("older", few.positions, few.verdicts);
    this.scans.push(scan);
    this.run.meta.scans = this.scans.length;
    if (this.scans.length === 2 || this.scans.length % PATH_EVERY === 0) this.#drawPath();
    if (this.scans.length === 1 || this.scans.length === 30) this.#measure();
  }

  /** Writes into a ring; scans whose points are overwritten by that lose them. */
  #write(ring, positions, verdicts) {
    const n = verdicts.length;
    const begin = this.#rings[ring].write(positions, verdicts);
    for (const scan of this.scans) {
      const length = ring === "recent" ? scan.n : Math.floor(scan.n / EVERY);
      if (scan[ring] >= 0 && scan[ring] < begin + n && begin < scan[ring] + length) scan[ring] = -1;
    }
    return begin;
  }

  /** Settled verdicts of a scan that came before; how many changed, or null if there is no such scan. */
  takeCorrection({ index, verdicts }) {
    const scan = this.scans.findLast((other) => other.index === index);
    if (!scan || scan.n !== verdicts.length) return null;
    if (scan.recent < 0) return 0;
    const { recent, older } = this.#rings;
    const now = verdicts.map((verdict, i) => (verdict & 0b1111) | (recent.verdicts[scan.recent + i] & 0b110000));
    const changed = now.reduce((n, verdict, i) => n + (finalOf(verdict) !== finalOf(recent.verdicts[scan.recent + i]) ? 1 : 0), 0);
    recent.rewrite(scan.recent, now);
    if (scan.older >= 0) older.rewrite(scan.older, thinnedBy(EVERY, new Float32Array(3 * now.length), now).verdicts);
    this.corrected += changed;
    this.view.redraw();
    return changed;
  }

  #drawPath() {
    this.overlay.setPath(Float32Array.from(this.scans.flatMap(({ sensor }) => sensor)));
  }

  #measure() {
    const { recent } = this.clouds;
    this.midst = midstOf(recent);
    for (const cloud of Object.values(this.clouds)) cloud.setUniforms({ heightScale: [this.midst[0][2], this.midst[1][2]] });
  }

  hasColouring(id) {
    return COLOURINGS.includes(id);
  }

  sensorAt(row) {
    return this.scans[row]?.sensor ?? null;
  }

  /** Rows whose points are still here. */
  get rowsHeld() {
    return this.scans.flatMap(({ recent }, row) => (recent >= 0 ? [row] : []));
  }

  showRow(row) {
    const scan = this.scans[row];
    if (scan?.recent >= 0) this.clouds.scan.setRange(scan.recent, scan.recent + scan.n);
    super.showRow(row);
  }

  get scanIsShown() {
    return Boolean(this.settings?.scan && this.scans[this.row]?.recent >= 0);
  }

  /** What was removed from earlier scans would hide what moves now. */
  layersOf(settings, isScan) {
    return super.layersOf(settings).filter((name) => isScan || name !== "dynamic" || settings.trail);
  }

  point(source, index) {
    const cloud = this.clouds[source];
    const ring = source === "older" ? "older" : "recent";
    const length = (n) => (ring === "older" ? Math.floor(n / EVERY) : n);
    const row = this.scans.findLastIndex((scan) => scan[ring] >= 0 && scan[ring] <= index && index < scan[ring] + length(scan.n));
    return { owner: this, source, index, position: cloud.position(index), verdict: cloud.verdicts[index], row: row < 0 ? undefined : row };
  }
}
