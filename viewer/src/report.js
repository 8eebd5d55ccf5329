// SPDX-License-Identifier: MIT
// The page of one finished run, or of several side by side.
import { about, licences } from "./about.js";
import { frame } from "./app.js";
import { expose } from "./automation.js";
import { colouringsOf } from "./colours.js";
import { controls } from "./controls.js";
import { h } from "./dom.js";
import { editToken } from "./edit_server.js";
import { Editor } from "./editor.js";
import { count, fixed, plural } from "./format.js";
import { errorButtons } from "./errors.js";
import { fromHash, keepHash } from "./hash.js";
import { groupsOf, rowIsShown } from "./groups.js";
import { bindKeys } from "./keys.js";
import { objectPanel } from "./objects.js";
import { pointPanel } from "./panel.js";
import { plotsOf } from "./plots.js";
import { RunView } from "./run_view.js";
import { scoreTable } from "./scores.js";
import { Session } from "./session.js";
import { AROUND_MIDDLE, bindCanvas, cellsOf, showLegend } from "./stage.js";
import { watchTheme } from "./theme.js";
import { overviewLink } from "./tile_facts.js";
import { Timeline } from "./timeline.js";

const MOST_VIEWS = 4;
const SHOWN = ["colour", "static", "dynamic", "unknown", "groups", "path", "scan", "dim", "corrections", "height", "range", "rangeFrom", "size"];

function subtitleOf(metas, total) {
  if (total > metas.length) return `the first ${metas.length} of ${total} maps side by side`;
  if (metas.length > 1) return `${metas.length} maps side by side`;
  const [{ scans, counts, preset, tile }] = metas;
  if (tile) return [overviewLink(metas[0]), ` · ${plural(tile.voxels, "voxel")} · seen by ${tile.drives.length} of ${plural(tile.drives_total, "drive")}`];
  return [scans ? `${count(scans)} scans` : null, counts?.dynamic ? `${count(counts.dynamic)} points removed` : null, preset && `preset ${preset}`].filter(Boolean).join(" · ");
}

const isTile = (metas) => metas.every(({ kind }) => kind === "tile");
const titleOf = ({ kind, name }) => (kind === "tile" ? `Tile ${name}` : name);

/** What can be chosen in any of the runs. */
const allColourings = (runs) => [...new Map(runs.flatMap(colouringsOf).map((c) => [c.id, c])).values()];

const sum = (metas, name) => metas.reduce((total, { counts }) => total + (counts?.[name] ?? 0), 0);

function layersOf(metas) {
  if (isTile(metas)) return [];
  const amount = (name) => (metas.length === 1 && metas[0].counts ? metas[0].counts[name] : undefined);
  const layers = [{ name: "static", label: "Static", amount: amount("static"), hint: "Key Z" },
    { name: "dynamic", label: "Removed", amount: amount("dynamic"), hint: "Key X" }];
  if (sum(metas, "unknown") > 0) layers.push({ name: "unknown", label: "Unknown", amount: amount("unknown"), hint: "Key C" });
  if (metas.some(({ has_instant }) => has_instant)) layers.push({ name: "corrections", label: "Mark corrections", hint: "Key M: where the final verdict is not the front-end's" });
  return layers;
}

const SCAN_LAYERS = [
  { name: "path", label: "Trajectory" },
  { name: "scan", label: "Scan at the slider", hint: "Key P" },
  { name: "dim", label: "Dim the map below them" },
];

function timelineOf(session) {
  return new Timeline(session.store, {
    words: (row) => {
      const { leader } = session;
      const { arrays, meta } = leader.run;
      const seconds = fixed(arrays["path-stamp"][row] - arrays["path-stamp"][0], 1);
      const index = arrays["path-index"]?.[row] ?? row;
      const without = leader.frameOf(row) < 0 ? ", no points here" : "";
      return `scan ${index} · ${seconds} s\n${row + 1} of ${count(meta.scans)}${without}`;
    },
  });
}

function fillTimeline(timeline, { run }, groups) {
  const stamps = Array.from(run.arrays["path-stamp"] ?? []);
  const ofFrames = run.arrays["path-frame"];
  const rows = stamps.map((_, row) => row);
  const played = rows.filter((row) => ofFrames?.[row] >= 0 && rowIsShown(run, row, groups));
  const counts = run.arrays["path-counts"];
  timeline.setRows({ frames: played.length ? played : rows, stamps, amounts: counts ? rows.map((row) => counts[4 * row + 1]) : [], alarms: run.meta.alarms });
}

function panelsOf(session, runs) {
  const metas = runs.map(({ meta }) => meta);
  const plots = h("div", {}), objects = h("div", {}), run = h("div", {}, metas.map((meta) => about({ meta }, metas.length === 1)), licences());
  const panels = [
    { id: "view", label: "View", element: h("div", { class: "controls" }) },
    { id: "point", label: "Point", element: h("div", {}, pointPanel(session, isTile(metas))) },
    ...(runs.some(({ meta }) => meta.scans > 0) ? [{ id: "objects", label: "Objects", element: objects }] : []),
    { id: "plots", label: "Plots", element: plots },
    { id: "run", label: metas.length > 1 ? "Runs" : isTile(metas) ? "Tile" : "Run", element: run },
  ];
  if (metas.length > 1) panels.splice(1, 0, { id: "scores", label: "Scores", element: scoreTable(metas) });
  return panels;
}

/** Heights and ranges that the cuts reach over, in the frame of the first view. */
function extentOf(views) {
  const lows = views.map(({ midst, view }) => midst[0].map((l, c) => l + view.offset[c]));
  const highs = views.map(({ midst, view }) => midst[1].map((x, c) => x + view.offset[c]));
  const low = [0, 1, 2].map((c) => Math.min(...lows.map((l) => l[c]))), high = [0, 1, 2].map((c) => Math.max(...highs.map((x) => x[c])));
  return { heights: [low[2] - 0.5, high[2] + 0.5], reach: Math.max(10, Math.hypot(high[0] - low[0], high[1] - low[1])) };
}

function durationOf({ leader }) {
  const stamps = leader?.run.arrays["path-stamp"];
  return stamps?.length ? stamps.at(-1) - stamps[0] : 0;
}

async function loadAll(session, panels, timeline, say) {
  const { views, leader } = session;
  say("Reading the trajectory …");
  for (const view of views) await view.loadPath();
  if (leader) session.store.watch(["groups"], ({ groups }) => fillTimeline(timeline, leader, groups));
  session.showRow(session.store.get("row"));
  say("Reading the scans …");
  for (const view of views) await view.loadRest();
  session.showRow(session.store.get("row"));
  say("Reading the evidence …");
  for (const view of views) await view.loadEvidence();
  for (const view of views) await view.loadObjects();
  session.refreshSelection();
  const fill = (id, make) => panels.find((panel) => panel.id === id)?.element.append(...views.map((view) =>
    h("article", {}, views.length > 1 ? h("h2", { class: "run-name" }, view.name) : null, make(view))));
  fill("plots", (view) => plotsOf(view, session));
  fill("objects", (view) => objectPanel(session, view));
  say("");
}

/** The point of a link. */
function chooseLinked(session, point) {
  const view = point && session.views[point.run];
  const cloud = view?.clouds[point.source];
  if (cloud && point.index < cloud.positions.length / 3) session.select(view.point(point.source, point.index));
}

/** Until what was asked for is on the screen; not for ever, as a hidden tab draws nothing. */
const nextPicture = () => new Promise((done) => {
  setTimeout(done, 1000);
  requestAnimationFrame(() => requestAnimationFrame(done));
});

export async function startReport(runs) {
  const shown = runs.slice(0, MOST_VIEWS);
  const metas = shown.map(({ meta }) => meta);
  const link = fromHash(location.hash);
  // A tile's points are all static: their verdict says nothing.
  const session = new Session({ ...(isTile(metas) ? { colour: "height" } : {}), ...link.settings });
  const panels = panelsOf(session, shown);
  const editor = editToken() ? new Editor(session, editToken()) : null;
  if (editor) panels.splice(1, 0, { id: "edit", label: "Edit", element: editor.panel.element });
  const timeline = timelineOf(session);
  document.title = `${metas.map(({ name }) => name).join(", ")} – DynamicFilter`;
  const page = frame({ title: metas.length > 1 ? "DynamicFilter" : titleOf(metas[0]), subtitle: subtitleOf(metas, runs.length), panels, timeline: timeline.element });
  const automation = expose(session, editor ? { editor: () => editor.state() } : {});
  const openPoint = (id) => editor || page.open(id);  // who edits keeps that panel open
  try {
    if (isTile(metas)) page.open("run");
    const cells = cellsOf(metas, page.stage);
    const middle = metas[0].origin ?? [0, 0, 0];
    session.views = shown.map((run, i) =>
      new RunView(run, cells[i], session.orbit, (run.meta.origin ?? [0, 0, 0]).map((o, c) => o - middle[c])));
    watchTheme((theme) => session.views.forEach((view) => view.setTheme(theme)));
    session.store.watch(SHOWN, (settings) => session.views.forEach((view) => view.apply(settings)));
    const pickers = session.views.map((view) => bindCanvas(session, view, openPoint));
    page.say("Reading the map …");
    for (const view of session.views) await view.loadMap();
    if (link.camera) session.orbit.set(link.camera);
    else session.fit();
    await nextPicture();
    automation.mapIsShown();
    const extent = extentOf(session.views);
    const colourings = allColourings(shown);
    panels[0].element.append(...controls({
      store: session.store, layers: layersOf(metas), groups: groupsOf(metas), scanLayers: session.leader ? SCAN_LAYERS : [], colourings, ...extent,
      camera: [{ label: "All", key: "0", act: () => session.fit() }, { label: "Top", key: "T", act: () => session.top() },
        { label: "Sensor", key: "G", act: () => session.centreOnSensor() }],
    }));
    const wrong = errorButtons(session, shown);
    if (wrong) panels.find(({ id }) => id === "point").element.prepend(wrong);
    showLegend(session, page.stage, { heights: () => [extent.heights[0] + 0.5, extent.heights[1] - 0.5], duration: () => durationOf(session) });
    session.store.watch(["row"], ({ row }) => {
      for (const { overlay } of session.views) overlay.setVisible("sight", false);
      session.showRow(row);
    });
    session.store.watch(["follow"], ({ follow }) => follow && session.centreOnSensor());
    bindKeys({ session, timeline, colourings: colourings.map(({ id }) => id), pickMiddle: (canvas) => {
      const i = session.views.findIndex(({ view }) => view.canvas === canvas);
      pickers[i](canvas.clientWidth / 2, canvas.clientHeight / 2, AROUND_MIDDLE);
    } });
    await loadAll(session, panels, timeline, page.say);
    await editor?.start();
    chooseLinked(session, link.point);
    keepHash(session);
    automation.done();
  } catch (error) {
    page.say(`This page cannot be shown whole: ${error.message}`);
    automation.failed(error);
    throw error;
  }
}
