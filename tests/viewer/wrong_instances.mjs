// SPDX-License-Identifier: MIT
// What a run got wrong, by its files on disk.
import { readdirSync, readFileSync } from "node:fs";
import { join } from "node:path";

export const STATIC = 9, DYNAMIC = 251;
const EDGE = 0.2;

const wordsOf = (file) => {
  const bytes = readFileSync(file);
  return { ints: new Uint32Array(bytes.buffer, bytes.byteOffset, bytes.length / 4), floats: new Float32Array(bytes.buffer, bytes.byteOffset, bytes.length / 4) };
};
const kindOf = (label) => ((label & 0xffff) === DYNAMIC ? DYNAMIC : (label & 0xffff) <= 1 ? 0 : STATIC);

/** Calls act({cell, place, label, truth, scan}) for all points of a recording in KITTI's layout. */
export function eachPoint(data, run, act) {
  const poses = readFileSync(join(data, "poses.txt"), "utf8").trim().split("\n").map((line) => line.split(" ").map(Number));
  readdirSync(join(run, "labels")).filter((name) => name.endsWith(".label")).sort().forEach((name, scan) => {
    const { floats } = wordsOf(join(data, "velodyne", name.replace(".label", ".bin")));
    const labels = wordsOf(join(run, "labels", name)).ints, truth = wordsOf(join(data, "labels", name)).ints;
    const T = poses[scan];
    for (let i = 0; i < labels.length; ++i) {
      const [x, y, z] = floats.subarray(4 * i, 4 * i + 3);
      const place = [0, 4, 8].map((r) => T[r] * x + T[r + 1] * y + T[r + 2] * z + T[r + 3]);
      act({ place, cell: place.map((p) => Math.floor(p / EDGE)).join(), label: kindOf(labels[i]), truth: kindOf(truth[i]), scan });
    }
  });
}

/** Clusters of removed points most of which the truth calls static, the largest first: [{place, points, wrong}]. */
export function wrongInstances(data, run) {
  const byCell = new Map();
  eachPoint(data, run, ({ place, cell, label, truth }) => {
    if (label !== DYNAMIC) return;
    if (!byCell.has(cell)) byCell.set(cell, { cell, place, points: 0, wrong: 0 });
    const found = byCell.get(cell);
    ++found.points;
    if (truth === STATIC) ++found.wrong;
  });
  const instances = [];
  for (const [key, first] of byCell) {
    byCell.delete(key);
    const cells = [first];
    for (const { cell } of cells) {
      const [x, y, z] = cell.split(",").map(Number);
      for (let d = 0; d < 27; ++d) {
        const beside = [x + (d % 3) - 1, y + (Math.floor(d / 3) % 3) - 1, z + Math.floor(d / 9) - 1].join();
        if (!byCell.has(beside)) continue;
        cells.push(byCell.get(beside));
        byCell.delete(beside);
      }
    }
    const { place } = cells.reduce((a, b) => (b.points > a.points ? b : a));
    const sum = (name) => cells.reduce((total, cell) => total + cell[name], 0);
    instances.push({ place, points: sum("points"), wrong: sum("wrong") });
  }
  return instances.filter(({ points, wrong }) => wrong > 0.9 * points).sort((a, b) => b.wrong - a.wrong);
}

export function scoresOf(data, run) {
  const counts = { wrong: 0, all: 0 };
  eachPoint(data, run, ({ label, truth }) => {
    if (!truth) return;
    ++counts.all;
    if (label !== truth) ++counts.wrong;
  });
  return counts;
}
