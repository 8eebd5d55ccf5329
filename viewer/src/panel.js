// SPDX-License-Identifier: MIT
// The panel "Point": what explain.js has to say, and the scans to go and look.
import { NO_VOXEL } from "./data.js";
import { h } from "./dom.js";
import { voxelFacts } from "./evidence.js";
import { explain, verdictWord } from "./explain.js";
import { fixed, plural } from "./format.js";

const MOST_LISTED = 200;
const WITHOUT_VOXEL = 0.1;  // m, of the box around a point

const QUESTIONS = {
  run: ["Why is this point gone?", "Click a point. Here it says what was decided, by which evidence, and which scans saw through its place."],
  tile: ["How sure is this point?", "Click a point. Here it says with which probability its voxel is static."],
};

const empty = (isTile) => h("div", { class: "empty-state" },
  h("h2", {}, QUESTIONS[isTile ? "tile" : "run"][0]),
  h("p", {}, QUESTIONS[isTile ? "tile" : "run"][1]),
  h("p", { class: "muted" }, "Double click puts it in the middle of the view."));

function scoreBar(score) {
  const share = 50 * (1 + score);
  return h("div", { class: "score", role: "img", "aria-label": `own score ${fixed(score, 2)} between −1, stays, and 1, came or went` },
    h("div", { class: "score-track" }, h("i", { style: `left:${share}%` })),
    h("div", { class: "score-ends" }, h("span", {}, "stays"), h("span", {}, "came or went")));
}

function passList(session, point, passes, facts, select) {
  const { owner } = point;
  const { meta } = owner.run;
  if (passes === undefined) return null;
  const forgotten = (meta.keyframes_total ?? 0) - (meta.keyframes?.length ?? 0);
  const chips = passes.slice(0, MOST_LISTED).map((row) =>
    h("button", { type: "button", class: "chip", "data-row": row, onclick: () => select(row) }, scanNumber(owner.run, row)));
  const notes = [];
  if (passes.length > MOST_LISTED) notes.push(`The first ${MOST_LISTED} of ${passes.length}.`);
  if (facts.evidence && facts.evidence.free > passes.length) {
    notes.push(forgotten > 0
      ? `${plural(facts.evidence.free - passes.length, "more pass", "more passes")} counted: of ${meta.keyframes_total} key frames the newest ${meta.keyframes.length} are known one by one, and some stand for several.`
      : "Some scans stand for several like them.");
  }
  return h("section", {},
    h("h2", {}, "Scans that saw through it"),
    h("p", { class: "muted" }, "Choose one: the slider goes there and the line of sight is drawn."),
    h("div", { class: "chips" }, chips),
    notes.length ? h("p", { class: "muted" }, notes.join(" ")) : null);
}

const scanNumber = (run, row) => String(run.arrays["path-index"]?.[row] ?? row);

function scanWords(run, row) {
  const stamps = run.arrays["path-stamp"];
  return stamps?.[row] === undefined ? `scan ${scanNumber(run, row)}` : `scan ${scanNumber(run, row)} (${fixed(stamps[row] - stamps[0], 1)} s)`;
}

function counterTable(counters) {
  return h("dl", { class: "counters" }, counters.map(([name, value, meaning]) =>
    h("div", {}, h("dt", {}, name), h("dd", {}, value), h("small", {}, meaning))));
}

function about(session, point) {
  const { owner, verdict } = point;
  const { run } = owner;
  const facts = point.voxel !== undefined && point.voxel !== NO_VOXEL ? voxelFacts(run, point.voxel) : {};
  const told = explain(point, facts, run.meta, (row) => scanWords(run, row));
  const world = point.position.map((p, c) => fixed(p + (run.meta.origin?.[c] ?? 0), 2)).join(", ");
  const sensor = owner.sensorAt(point.row ?? -1);
  const range = sensor ? `, ${fixed(Math.hypot(...sensor.map((s, c) => s - point.position[c])), 1)} m from the sensor` : "";
  const goTo = (row) => {
    session.goTo(owner, row);
    owner.overlay.showSight(owner.sensorAt(row), point.position);
    for (const chip of document.querySelectorAll(".chip")) chip.setAttribute("aria-pressed", chip.dataset.row === String(row));
  };
  return [
    session.views.length > 1 ? h("p", { class: "muted" }, run.meta.name) : null,
    h("div", { class: `verdict ${verdictWord(told.verdict)}` }, h("h2", {}, told.title)),
    h("p", { class: "reason" }, told.reason),
    told.score === undefined ? null : scoreBar(told.score),
    ...told.notes.map(({ text, kind }) => h("p", { class: `note ${kind}` }, text)),
    point.row === undefined || run.meta.scans === 0 ? null
      : h("p", {}, "Seen in ", h("button", { type: "button", class: "link", onclick: () => goTo(point.row) }, scanWords(run, point.row)), `${range}.`),
    passList(session, point, facts.passes, facts, goTo),
    told.counters.length ? h("section", {}, h("h2", {}, "Its voxel"), counterTable(told.counters)) : null,
    run.meta.has_evidence || run.meta.live || run.meta.scans === 0 ? null
      : h("p", { class: "muted" }, `${run.meta.preset ? `The preset ${run.meta.preset}` : "This run"} keeps no counters of each voxel, so it cannot be said which scans saw through it.`),
    facts.evidence ? h("p", { class: "muted" }, "The probability is not a function of these counts alone: the voxels within two cells vote too, most of all those that came and went at the same time.") : null,
    h("p", { class: "muted place" }, `x, y, z: ${world} m · verdict bits ${verdict}`),
  ].filter(Boolean);
}

/** A box around the point's voxel, at the same place of the world in all views. */
function markPlace({ views }, point) {
  const { owner, voxel, position } = point;
  const edge = owner.run.meta.voxel_size;
  const hasVoxel = voxel !== undefined && voxel !== NO_VOXEL && edge;
  const middle = hasVoxel ? owner.voxelMiddle(point) : position;
  for (const { overlay, view } of views) {
    overlay.showBox(middle.map((m, c) => m + owner.view.offset[c] - view.offset[c]), hasVoxel ? edge : WITHOUT_VOXEL);
  }
}

export function pointPanel(session, isTile = false) {
  const element = h("div", { class: "told", "aria-live": "polite" });
  session.store.watch(["selection"], ({ selection: point }) => {
    element.replaceChildren(...(point ? about(session, point) : [empty(isTile)]));
    if (!point) return;
    element.closest(".panel")?.scrollTo({ top: 0 });
    markPlace(session, point);
  });
  return element;
}
