// SPDX-License-Identifier: MIT
// Synthetic runs as viewer/README.md describes them, and pages with them in it.
import { gzipSync } from "node:zlib";
import { random } from "./random.mjs";
import { mapPoints, PEOPLE, personAt, SCANS, scanPoints, sensorAt, stampOf } from "./street.mjs";

const VOXEL = 0.2;
const LOW = [-8, -24, -4], STEP = 0.0016;
const UNKNOWN = 0, STATIC = 1, DYNAMIC = 2, NONE = 0xffffffff;
const KEY_FRAMES = Array.from({ length: SCANS / 3 }, (_, k) => 3 * k);
const FORGOTTEN = 5;  // of the key frames, the first are no longer known one by one

const quantised = (place) => place.map((p, c) => Math.max(0, Math.min(65535, Math.round((p - LOW[c]) / STEP))));
const bits = (settled, truth, instant) => settled | (truth << 2) | (instant << 4);

const expectedPasses = ({ occupied, owned, switches }) => 0.3 * (1 + switches) ** 0.95 * occupied ** 0.37 * owned ** 0.33;
const dynamicScore = (voxel) => Math.max(-1.8, Math.min(1, 2.8 * Math.log((voxel.free + 1) / (expectedPasses(voxel) + 1))));

/** Voxels in the order in which points fall into them. */
class Voxels {
  rows = new Map();
  list = [];

  constructor(seed) {
    this.random = random(seed);
  }

  of({ place, moving, row }) {
    const key = place.map((p) => Math.floor(p / VOXEL)).join();
    let index = this.rows.get(key);
    if (index === undefined) {
      index = this.list.length;
      this.rows.set(key, index);
      this.list.push(this.#made(moving, row));
    }
    const voxel = this.list[index];
    voxel.first = Math.min(voxel.first, row);
    voxel.last = Math.max(voxel.last, row);
    return index;
  }

  #made(moving, row) {
    const r = this.random;
    const many = (low, high) => Math.floor(low + r() * (high - low));
    if (!moving) {
      const passes = r() < 0.1 ? KEY_FRAMES.filter(() => r() < 0.03) : [];
      return { moving, first: row, last: row, occupied: many(12, 180), free: passes.length, owned: many(4, 60), switches: Math.min(2 * passes.length, many(0, 3)), passes };
    }
    const near = KEY_FRAMES.map((_, k) => k).filter((k) => k >= FORGOTTEN && Math.abs(KEY_FRAMES[k] - row) > 3 && r() < 0.55);
    return { moving, first: row, last: row, occupied: many(1, 5), free: near.length + FORGOTTEN, owned: many(1, 3), switches: many(1, 3), passes: near };
  }
}

const probabilityOf = (voxel) => {
  const score = 3 * 3 * dynamicScore(voxel) * (voxel.moving ? 1 : 0.9);
  return Math.round(254 / (1 + Math.exp(score)));
};

/** What the filter would say of points, with the errors and corrections of a real one. */
function verdictOf(point, voxel, r) {
  let settled = probabilityOf(voxel) >= 127 ? STATIC : DYNAMIC;
  if (r() < 0.004) settled = settled === STATIC ? DYNAMIC : STATIC;
  if (r() < 0.004) settled = UNKNOWN;
  const instant = r() < (point.moving ? 0.18 : 0.01) ? (settled === STATIC ? DYNAMIC : STATIC) : settled;
  return { settled, instant };
}

const array = (type, columns, data) => ({ type, columns, rows: data.length / columns, data });

/** The people, number 1 the first, each seen in all scans and known in every tenth. */
function objects() {
  const rows = Array.from({ length: SCANS / 10 }, (_, k) => 10 * k);
  const numbers = PEOPLE.map((_, k) => k + 1);
  const way = (k) => { const [from, to] = [personAt(k, 0), personAt(k, SCANS - 1)]; return Math.hypot(to[0] - from[0], to[1] - from[1]); };
  return {
    "object-number": array("uint32", 1, Uint32Array.from(numbers)),
    "object-row": array("uint32", 3, Uint32Array.from(numbers.flatMap((n) => [0, SCANS - 1, 2 * n]))),
    "object-facts": array("float32", 6, Float32Array.from(numbers.flatMap((n) => [1000 * n, 0.6, 0.5, 1.7, way(n - 1), Math.abs(PEOPLE[n - 1].speed)]))),
    "object-begin": array("uint32", 1, Uint32Array.from([...numbers, 0], (_, k) => k * rows.length)),
    "object-place": array("float32", 3, Float32Array.from(numbers.flatMap((n) => rows.flatMap((row) => [...personAt(n - 1, row), -0.8])))),
    "object-place-row": array("uint32", 1, Uint32Array.from(numbers.flatMap(() => rows))),
  };
}

/**
 * One run as {meta, arrays, known}. `known`: points of the map that tests look for, {place, voxel, row, passes}.
 * `wrong`: share of further errors, so that runs differ. `sensors`: names of those that take turns, two scans each, so
 * that the playback has scans of all.
 */
export function makeRun({ name = "street", points = 120_000, framePoints = 2500, seed = 1, evidence = true, truth = true, origin = [1000, 2000, 50], wrong = 0, alarms = [], sensors = [] } = {}) {
  const r = random(seed + 7);
  const voxels = new Voxels(seed + 3);
  const position = new Uint16Array(3 * points), verdict = new Uint8Array(points), intensity = new Uint8Array(points);
  const scan = new Uint32Array(points), voxelOf = new Uint32Array(points);
  const counts = { static: 0, dynamic: 0, unknown: 0 };
  const rows = new Uint32Array(4 * SCANS), scores = new Uint32Array(8 * SCANS);
  const known = [];
  let i = 0;
  for (const point of mapPoints(points, seed)) {
    const voxel = voxels.of(point);
    let { settled, instant } = verdictOf(point, voxels.list[voxel], r);
    if (r() < wrong) settled = DYNAMIC;
    position.set(quantised(point.place), 3 * i);
    verdict[i] = bits(settled, truth ? (point.moving ? DYNAMIC : STATIC) : 0, instant);
    intensity[i] = point.moving ? 120 + 60 * r() : 40 + 12 * ((Math.floor(point.place[0]) * 7) % 16) + 20 * r();
    scan[i] = point.row;
    voxelOf[i] = i === 5 ? NONE : voxel;
    ++counts[["unknown", "static", "dynamic"][settled]];
    if (point.moving && settled === DYNAMIC && known.length < 300) known.push({ index: i, place: point.place, voxel, row: point.row });
    ++i;
  }
  const frames = playback(voxels, framePoints, r, truth, rows, scores);
  for (const point of known) point.passes = voxels.list[point.voxel].passes.map((k) => KEY_FRAMES[k]);
  const path = Array.from({ length: SCANS }, (_, row) => sensorAt(row));
  const arrays = {
    "map-position": array("uint16", 3, position), "map-verdict": array("uint8", 1, verdict), "map-intensity": array("uint8", 1, intensity),
    "map-scan": array("uint32", 1, scan), "map-voxel": array("uint32", 1, voxelOf),
    "voxel-probability": array("uint8", 1, Uint8Array.from(voxels.list, probabilityOf)),
    ...(evidence ? counters(voxels.list) : {}),
    "path-position": array("float32", 3, Float32Array.from(path.flat())), "path-stamp": array("float64", 1, Float64Array.from(path, (_, row) => stampOf(row))),
    "path-index": array("uint32", 1, Uint32Array.from(path, (_, row) => row + 10)),
    "path-frame": array("int32", 1, Int32Array.from(path, (_, row) => (row % 2 === 0 ? row / 2 : -1))),
    "path-counts": array("uint32", 4, rows), ...(truth ? { "path-scores": array("uint32", 8, scores) } : {}),
    ...(sensors.length ? { "path-sensor": array("uint8", 1, Uint8Array.from(path, (_, row) => (row >> 1) % sensors.length)) } : {}),
    ...frames, ...objects(),
  };
  const meta = {
    name, command: "run", version: "0.0.0-test", input: "recordings/street", format: "kitti", preset: evidence ? "default" : "paper", created: "2026-01-02T03:04:05Z",
    origin, low: LOW, step: STEP, voxel_size: VOXEL, occupancy_threshold: 0.5, scans: SCANS, has_truth: truth, has_instant: true, has_evidence: evidence, alarms, ...(sensors.length ? { groups: { kind: "sensor", names: sensors } } : {}),
    points_total: Math.round(9.4 * points), points_shown: points, spacing: 0.12,
    frame_points_total: SCANS * framePoints, frame_points_shown: (SCANS / 2) * framePoints, frames_shown: SCANS / 2, counts,
    keyframes: KEY_FRAMES, keyframes_total: KEY_FRAMES.length + FORGOTTEN,
    scores: truth ? scoresOf(wrong) : null, timing: timingOf(wrong),
    config: "preset = \"default\"\n\n[back_end]\nvoxel_size = 0.2  # m\nmax_scans = 400\n\n[output]\nkeep_unknown = true\n",
    notes: ["no stamps in the recording: 10 Hz assumed"], rejected: ["000017: 412 of 4096 points are not finite <b>"], dropped: [],
  };
  return { meta, arrays, known };
}

function counters(list) {
  const begin = Uint32Array.from({ length: list.length + 1 }, () => 0);
  list.forEach(({ passes }, k) => (begin[k + 1] = begin[k] + passes.length));
  return {
    "voxel-evidence": array("uint16", 4, Uint16Array.from(list.flatMap((v) => [v.occupied, v.free, v.owned, v.switches]))),
    "voxel-score": array("float32", 3, Float32Array.from(list.flatMap((v) => [v.free, expectedPasses(v), dynamicScore(v)]))),
    "voxel-span": array("uint32", 2, Uint32Array.from(list.flatMap((v) => [v.first, v.last]))),
    "pass-begin": array("uint32", 1, begin),
    pass: array("uint16", 1, Uint16Array.from(list.flatMap((v) => v.passes))),
  };
}

function playback(voxels, n, r, truth, rows, scores) {
  const begin = [0], position = [], verdict = [], voxelOf = [];
  for (let row = 0; row < SCANS; ++row) {
    for (const point of scanPoints(row, n)) {
      const voxel = voxels.of(point);
      const { settled, instant } = verdictOf(point, voxels.list[voxel], r);
      const column = [2, 0, 1][settled];  // unknown, static, dynamic
      ++rows[4 * row + column];
      if (settled !== instant) ++rows[4 * row + 3];
      if (truth) [settled, instant].forEach((said, k) => ++scores[8 * row + 4 * k + (point.moving ? (said === DYNAMIC ? 0 : 1) : said === DYNAMIC ? 3 : 2)]);
      if (row % 2) continue;
      position.push(...quantised(point.place));
      verdict.push(bits(settled, truth ? (point.moving ? DYNAMIC : STATIC) : 0, instant));
      voxelOf.push(voxel);
    }
    if (row % 2 === 0) begin.push(verdict.length);
  }
  return {
    "frame-begin": array("uint32", 1, Uint32Array.from(begin)), "frame-position": array("uint16", 3, Uint16Array.from(position)),
    "frame-verdict": array("uint8", 1, Uint8Array.from(verdict)), "frame-voxel": array("uint32", 1, Uint32Array.from(voxelOf)),
  };
}

function scoresOf(wrong) {
  const voxel = { pr: 0.9981 - 2 * wrong, rr: 0.9896, f1: 0.9938 - wrong };
  return {
    voxel: { excluded: voxel, static_wins: { ...voxel, rr: 0.981 }, majority: { ...voxel, pr: 0.997 - wrong }, erasor: { ...voxel, f1: null } },
    point: { sa: 0.9962 - wrong, da: 0.9771 + wrong / 4, aa: 0.9866, ha: 0.9865, iou: 0.9417 - wrong }, dynamic_voxel_share: 0.12,
    instant: { point: { iou: 0.91 - wrong } }, voxel_size: 0.2,
  };
}

function timingOf(wrong) {
  const stage = (p50) => ({ count: SCANS, mean: 1.1 * p50, p50, p95: 1.7 * p50, p99: 2.4 * p50, max: 3 * p50 });
  return {
    scans_per_second: 48.2 + 100 * wrong, cpu_seconds: 9.1, voxels: 81234, peak_rss_bytes: 412e6, threads: 2,
    stages: { front_end: stage(6.3), back_end: stage(11.8), neighbours: stage(2.2), contact: stage(0.6) }, front_end: { scans_per_second: 150 },
  };
}

/** A cloud without a run, as a peer's map in a comparison. */
export function makeCloud({ name = "octomap", points = 60_000, seed = 5, origin = [1003, 2000, 50] } = {}) {
  const shift = [0, 1, 2].map((c) => origin[c] - [1000, 2000, 50][c]);
  const position = new Uint16Array(3 * points);
  let i = 0;
  for (const { place } of mapPoints(points, seed, 0.02)) position.set(quantised(place.map((p, c) => p - shift[c])), 3 * i++);
  return {
    meta: { name, origin, low: LOW, step: STEP, scans: 0, has_truth: false, has_instant: false, has_evidence: false, points_total: points, points_shown: points, spacing: 0, counts: { static: points, dynamic: 0, unknown: 0 } },
    arrays: { "map-position": array("uint16", 3, position), "map-verdict": array("uint8", 1, new Uint8Array(points).fill(bits(STATIC, 0, STATIC))) },
  };
}

/** The overview of six tiles that two drives saw: heights rise to the north. */
export function makeCity() {
  const edge = 32;
  const squares = [[2, 0, 0, [0]], [2, 1, 0, [0]], [2, 0, 1, [0, 1]], [1, 2, 2, [1]], [1, 3, 2, [1]], [1, 2, 3, [1]]];
  const tiles = squares.map(([level, x, y, drives], i) => ({
    name: `${level}_${x}_${y}`, west: x * 25.6 * 2 ** level, south: y * 25.6 * 2 ** level, side: 25.6 * 2 ** level, voxels: 1000 * (i + 1), scans: 100 * (i + 1), picture: [x * 25.6 * 2 ** level, y * 25.6 * 2 ** level, 25.6 * 2 ** level], edge, drives, bottom: -1, top: 9,
  }));
  const pictures = new Uint8Array(tiles.length * edge * edge);
  tiles.forEach((_, i) => {
    for (let at = 0; at < edge * edge; ++at) pictures[i * edge * edge + at] = at % 7 === 0 ? 0 : 255 - Math.floor(at / edge) * 2;
  });
  const track = Float32Array.from([5, 5, 190, 10, 195, 90, 20, 195, 120, 180, 150, 120]);
  return {
    meta: {
      kind: "city", name: "Map of several drives", command: "run", version: "0", voxel_size: VOXEL, origin: [0, 0, 0], heights: [-1, 9],
      drives: [{ name: "south", scans: 500 }, { name: "north", scans: 700 }], tracks: ["south", "north"], tiles, scores: { tiles: 6 }, timing: null,
    },
    arrays: {
      "tile-picture": array("uint8", 1, pictures),
      "track-position": array("float32", 2, track), "track-begin": array("uint32", 1, Uint32Array.from([0, 3, 6])),
    },
  };
}

/** The page of a tile with a neighbour on one side; a third of its points was seen by both drives. */
export function makeTile({ name, points = 20_000 }) {
  const cloud = makeCloud({ name, points, origin: [1000, 2000, 50] });
  const other = name === "2_0_0" ? { name: "2_1_0", where: "east" } : { name: "2_0_0", where: "west" };
  return {
    meta: {
      ...cloud.meta, kind: "tile", counts: undefined, voxel_size: VOXEL, groups: { kind: "drive", names: ["south", "north"] },
      tile: { overview: "../report.html", side: 102.4, voxels: points, scans: 100, drives: [{ name: "south", voxels: points }], drives_total: 2, neighbours: [other] },
    },
    arrays: {
      ...cloud.arrays, "map-scans": array("uint8", 1, new Uint8Array(points).fill(40)), "map-drives": array("uint8", 1, new Uint8Array(points).fill(128)),
      "map-groups": array("uint32", 1, Uint32Array.from({ length: points }, (_, i) => 1 + (i % 3))),
      "map-voxel": array("uint32", 1, Uint32Array.from({ length: points }, (_, i) => i)), "voxel-probability": array("uint8", 1, new Uint8Array(points).fill(230)),
    },
  };
}

function elements({ meta, arrays }, k) {
  const listed = Object.fromEntries(Object.entries(arrays).map(([name, { type, columns, rows }]) => [name, { type, columns, rows }]));
  const json = JSON.stringify({ ...meta, arrays: listed }).replaceAll("<", "\\u003c");
  const texts = Object.entries(arrays).map(([name, { data }]) => {
    const packed = gzipSync(Buffer.from(data.buffer, data.byteOffset, data.byteLength), { level: 1 }).toString("base64");
    return `<script type="text/plain" id="run-${k}-${name}">${packed}</script>`;
  });
  return [`<script type="application/json" id="run-${k}">${json}</script>`, ...texts].join("\n");
}

/** The viewer with runs in it, as the command writes it. */
export function pageOf(viewer, runs) {
  const at = viewer.indexOf("<!--DATA-->");
  return viewer.slice(0, at) + runs.map(elements).join("\n") + viewer.slice(at + "<!--DATA-->".length);
}

export { SCANS };
