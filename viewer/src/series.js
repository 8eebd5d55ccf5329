// SPDX-License-Identifier: MIT
// What the plots show, from the arrays of a run.
import { NO_COUNT } from "./data.js";

const column = (array, columns, c) => {
  const values = new Float64Array(array.length / columns);
  for (let i = 0; i < values.length; ++i) values[i] = array[columns * i + c];
  return values;
};

const ratio = (a, b) => (a + b > 0 ? a / (a + b) : null);

/** Removed points of each scan and how many of its points were corrected later, null where that is not known; null without scans. */
export function countSeries(run) {
  const counts = run.arrays["path-counts"];
  if (!counts?.length) return null;
  return { removed: column(counts, 4, 1), corrected: Array.from(column(counts, 4, 3), (n) => (n === NO_COUNT ? null : n)) };
}

/**
 * Scores of each scan as {iou, recall, precision} of the final (`which` 0) or the instant (1) verdict, null where undefined.
 * `found`: moving points that were removed; `wrong`: static points that were removed.
 */
export function scoreSeries(run, which) {
  const scores = run.arrays["path-scores"];
  if (!scores?.length) return null;
  const result = { iou: [], recall: [], precision: [] };
  for (let at = 4 * which; at < scores.length; at += 8) {
    const [found, missed, , wrong] = scores.subarray(at, at + 4);
    result.iou.push(ratio(found, missed + wrong));
    result.recall.push(ratio(found, missed));
    result.precision.push(ratio(found, wrong));
  }
  return result;
}

/** Voxels by log2 of n_occ (columns) and n_free (rows): {cells, size, most}; null without evidence. */
export function evidenceHistogram(run) {
  const evidence = run.arrays["voxel-evidence"];
  if (!evidence?.length) return null;
  const size = 12;  // 0, 1, 2-3, 4-7, ... 1024 and more
  const cells = new Float64Array(size * size);
  const bin = (n) => Math.min(size - 1, n === 0 ? 0 : 1 + Math.floor(Math.log2(n)));
  for (let at = 0; at < evidence.length; at += 4) ++cells[bin(evidence[at + 1]) * size + bin(evidence[at])];
  return { cells, size, most: cells.reduce((a, b) => Math.max(a, b), 0) };
}

/** Voxels by probability, in tenths. */
export function probabilityHistogram(run) {
  const probability = run.arrays["voxel-probability"];
  if (!probability?.length) return null;
  const bins = new Float64Array(20);
  for (const p of probability) if (p !== 255) ++bins[Math.min(19, Math.floor((20 * p) / 254))];
  return bins;
}
