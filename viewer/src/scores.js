// SPDX-License-Identifier: MIT
// Tables of scores, of one run or of several side by side.
import { h } from "./dom.js";
import { fixed, percent } from "./format.js";

const READINGS = {
  excluded: "mixed voxels left out", static_wins: "mixed voxels static", majority: "mixed voxels by majority",
};
const POINT_ROWS = [["sa", "static accuracy SA"], ["da", "dynamic accuracy DA"], ["aa", "geometric mean AA"], ["ha", "harmonic mean HA"], ["iou", "moving IoU"]];

const at = (object, path) => path.reduce((value, key) => value?.[key], object);

/** Rows that at least one run has a number for: {group, label, values, words}. All are the better the larger. */
function scoreRows(metas) {
  const rows = [];
  const add = (group, label, path, words) => {
    const values = metas.map((meta) => at(meta, path));
    if (values.some(Number.isFinite)) rows.push({ group, label, values, words });
  };
  const readings = new Set(metas.flatMap(({ scores }) => Object.keys(scores?.voxel ?? {})));
  for (const reading of readings) {
    const group = `Voxels, ${READINGS[reading] ?? reading}`;
    add(group, "preserved PR [%]", ["scores", "voxel", reading, "pr"], percent);
    add(group, "rejected RR [%]", ["scores", "voxel", reading, "rr"], percent);
    add(group, "F1", ["scores", "voxel", reading, "f1"], (x) => fixed(x, 4));
  }
  for (const [key, label] of POINT_ROWS) add("Points [%]", label, ["scores", "point", key], percent);
  add("Points, at once [%]", "moving IoU", ["scores", "instant", "point", "iou"], percent);
  add("Speed", "scans per second", ["timing", "scans_per_second"], (x) => fixed(x, 1));
  return rows;
}

/** Which values of a row are the best as they are printed; none where there is nothing to compare. */
function best({ values, words }) {
  const known = values.filter(Number.isFinite);
  if (known.length < 2) return values.map(() => false);
  const most = words(Math.max(...known));
  return values.map((value) => Number.isFinite(value) && words(value) === most);
}

export function scoreTable(metas) {
  const rows = scoreRows(metas);
  if (rows.length === 0) return h("div", { class: "empty-state" }, h("p", {}, "No scores: the recording has no ground truth."));
  const body = [];
  let group = "";
  for (const row of rows) {
    if (row.group !== group) body.push(h("tr", { class: "group" }, h("th", { colspan: metas.length + 1, scope: "colgroup" }, row.group)));
    group = row.group;
    const winners = best(row);
    body.push(h("tr", {}, h("th", { scope: "row" }, row.label), row.values.map((value, i) =>
      h("td", { class: winners[i] ? "best" : "" }, Number.isFinite(value) ? row.words(value) : "–", winners[i] ? h("span", { class: "sr" }, " (best)") : null))));
  }
  return h("div", { class: "scroll" }, h("table", { class: "numbers scores" },
    metas.length > 1 ? h("thead", {}, h("tr", {}, h("th", {}), metas.map(({ name }) => h("th", { scope: "col" }, name)))) : null, h("tbody", {}, body)));
}
