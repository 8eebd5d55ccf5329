// SPDX-License-Identifier: MIT
// The panel "Run": where the data come from and what was done to them.
import { h } from "./dom.js";
import { bytes, count, fixed, metres, plural } from "./format.js";
import { scoreTable } from "./scores.js";
import { tileFacts } from "./tile_facts.js";

const LISTED = 50;

/** What is shown of how much, as a sentence. */
export function thinned({ points_shown: shown, points_total: total, spacing }) {
  if (!(total > shown)) return `All ${count(shown)} points of the map are shown.`;
  return `One point a cube of ${metres(spacing)}: ${count(shown)} of ${count(total)} shown.`;
}

function playback(meta) {
  if (!meta.frames_shown) return meta.scans ? "The page holds no scans to play." : null;
  const scans = meta.frames_shown < meta.scans ? `${count(meta.frames_shown)} of ${plural(meta.scans, "scan")}` : plural(meta.scans, "scan");
  const points = meta.frame_points_shown < meta.frame_points_total
    ? `, with ${count(meta.frame_points_shown)} of ${count(meta.frame_points_total)} points` : "";
  return `The slider plays ${scans}${points}.`;
}

function facts(meta) {
  const { counts, timing } = meta;
  const rows = [["input", meta.input], ["format", meta.format], ["preset", meta.preset], ["made", meta.created], ["version", meta.version]];
  if (meta.scans) rows.push(["scans", count(meta.scans)]);
  if (counts) rows.push(["points", `${count(counts.static)} static, ${count(counts.dynamic)} removed, ${count(counts.unknown)} unknown`]);
  if (meta.voxel_size) rows.push(["voxel", metres(meta.voxel_size)]);
  if (timing?.scans_per_second) rows.push(["speed", `${fixed(timing.scans_per_second, 1)} scans/s on ${plural(timing.threads ?? 1, "thread")}`]);
  if (timing?.peak_rss_bytes) rows.push(["memory", bytes(timing.peak_rss_bytes)]);
  if (timing?.online) rows.push(["online", Object.entries(timing.online).map(([name, value]) => `${name} ${value}`).join(", ")]);
  return h("dl", { class: "facts" }, rows.filter(([, value]) => value !== undefined && value !== null && value !== "")
    .map(([name, value]) => h("div", {}, h("dt", {}, name), h("dd", {}, String(value)))));
}

function lines(title, list, kind) {
  if (!list?.length) return null;
  const items = list.slice(0, LISTED).map((line) => h("li", {}, line));
  if (list.length > LISTED) items.push(h("li", { class: "muted" }, `and ${count(list.length - LISTED)} more`));
  return h("details", { class: kind, open: list.length <= 5 }, h("summary", {}, `${title} (${count(list.length)})`), h("ul", {}, items));
}

export function about({ meta }, withScores) {
  return h("article", {},
    h("h2", { class: "run-name" }, meta.name), meta.tile ? tileFacts(meta) : null, facts(meta),
    h("p", { class: "muted" }, [thinned(meta), playback(meta)].filter(Boolean).join(" ")),
    lines("Alarms", meta.alarms?.map(({ text }) => text), "warning"),
    lines("Notes", meta.notes, "notes"), lines("Rejected scans", meta.rejected, "warning"), lines("Dropped scans", meta.dropped, "warning"),
    withScores && meta.scans ? h("section", {}, h("h2", {}, "Scores"), scoreTable([meta])) : null,
    meta.config ? h("details", {}, h("summary", {}, "Settings"), h("pre", { tabindex: 0 }, meta.config)) : null);
}

export const licences = () => h("details", {}, h("summary", {}, "Licences of the page's parts"),
  h("pre", { tabindex: 0 }, document.getElementById("licences").content.textContent));
