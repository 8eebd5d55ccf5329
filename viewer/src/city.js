// SPDX-License-Identifier: MIT
// The overview of a run over many drives. Each tile has a page of its own, which is the report's.
import { licences } from "./about.js";
import { frame } from "./app.js";
import { CityMap, greatest, MEASURES } from "./city_map.js";
import { pageOf, runPanel, tilePanel, tilesPanel, viewPanel } from "./city_panels.js";
import { scaleGradient } from "./colours.js";
import { h } from "./dom.js";
import { count, fixed, plural } from "./format.js";
import { onGestures } from "./gestures.js";
import { Store } from "./store.js";
import { toggleTheme, watchTheme } from "./theme.js";
import "./city.css";

const DEFAULTS = { colour: "height", drive: -1, tracks: true, outlines: true, selected: -1 };

function steer(map, { choose, openTile }) {
  onGestures(map.canvas, {
    drag: (dx, dy) => map.pan(dx, dy),
    pinch: ({ dx, dy, scale, x, y }) => {
      map.pan(dx, dy);
      if (scale !== 1) map.zoom(scale, x, y);
    },
    click: (x, y) => choose(map.tileAt(x, y)),
    doubleClick: (x, y) => openTile(map.tileAt(x, y)),
    wheel: (scale, x, y) => map.zoom(scale, x, y),
  });
}

function bindKeys(map, openSelected) {
  const step = 60;  // px
  const acts = {
    ArrowLeft: () => map.pan(step, 0), ArrowRight: () => map.pan(-step, 0), ArrowUp: () => map.pan(0, step), ArrowDown: () => map.pan(0, -step),
    "+": () => map.zoom(1.3), "=": () => map.zoom(1.3), "-": () => map.zoom(1 / 1.3), 0: () => map.fit(), l: toggleTheme, Enter: openSelected,
  };
  window.addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.altKey || event.metaKey || event.target.closest("input, select, a, button, [role=tablist]")) return;
    const act = acts[event.key];
    if (!act) return;
    event.preventDefault();
    act();
  });
}

/** What the colours mean. */
function legend(store, city, map, stage) {
  const box = h("div", { class: "legend", role: "region", "aria-label": "Legend" });
  stage.append(box);
  store.watch(["colour"], ({ colour }) => {
    const { label, value } = MEASURES[colour];
    const ends = value ? ["0", count(greatest(map.tiles, value))] : city.heights.map((height) => `${fixed(height, 1)} m`);
    box.replaceChildren(h("h2", {}, label), h("div", { class: "scale", style: `background:${scaleGradient(value ? "cividis" : "viridis")}` }),
      h("div", { class: "scale-ends" }, ends.map((text) => h("span", {}, text))));
  });
}

function expose(store, map) {
  let done, failed;
  const ready = new Promise((resolve, reject) => ([done, failed] = [resolve, reject]));
  ready.catch(() => {});  // the page says it itself
  const settled = () => new Promise((drawn) => {
    const look = () => (map.idle ? drawn() : setTimeout(look, 20));
    setTimeout(look, 20);
  });
  window.viewer = {
    ready, settled,
    state: () => ({ ...store.values, centre: map.centre, scale: map.scale }),
    set: (patch) => store.set(patch),
    stats: () => ({ tiles: map.tiles.length, frames: map.frames }),
    show: (centre, scale) => map.show(centre, scale),
    project: (place) => map.project(place),
    tileAt: (x, y) => map.tiles[map.tileAt(x, y)]?.name ?? null,
  };
  return { done, failed };
}

export async function startCity(run) {
  const city = run.meta;
  const store = new Store(DEFAULTS);
  const panels = [["view", "View"], ["tile", "Tile"], ["tiles", "Tiles"], ["run", "Run"]].map(([id, label]) => ({ id, label, element: h("div", { class: id === "view" ? "controls" : null }) }));
  const part = (id) => panels.find((panel) => panel.id === id).element;
  document.title = `${city.name} – DynamicFilter`;
  const page = frame({
    title: city.name, subtitle: `${plural(city.tiles.length, "tile")} · ${plural(city.drives.length, "drive")}`, panels,
    timeline: h("div", { class: "timeline empty" }), help: false,
  });
  const cell = h("div", { class: "cell city" });
  page.stage.append(cell);
  page.say("Reading the trajectories …");
  let automation = null;
  try {
    await run.loadAll(["track-position", "track-begin"]);
    const tracks = { begin: run.arrays["track-begin"] ?? [0], positions: run.arrays["track-position"] ?? [] };
    const map = new CityMap(cell, { tiles: city.tiles, origin: city.origin, tracks }, store.values);
    automation = expose(store, map);
    const openTile = (i) => map.tiles[i] && location.assign(pageOf(map.tiles[i]));
    steer(map, {
      choose: (i) => {
        store.set({ selected: i });
        if (i >= 0) page.open("tile");
      },
      openTile,
    });
    bindKeys(map, () => openTile(store.get("selected")));
    part("view").append(...viewPanel(store, city, map));
    part("tile").append(tilePanel(store, city, map.tiles));
    part("tiles").append(tilesPanel(store, map.tiles));
    part("run").append(runPanel(city, map.tiles, licences()));
    legend(store, city, map, page.stage);
    page.say("Reading the pictures …");
    await run.load("tile-picture");
    map.setPictures(run.arrays["tile-picture"] ?? new Uint8Array());
    store.watch(["colour"], () => map.repaint());
    store.watch(["drive", "tracks", "outlines", "selected"], () => map.redraw());
    watchTheme(() => map.redraw());
    page.say("");
    automation.done();
  } catch (error) {
    page.say(`This page cannot be shown whole: ${error.message}`);
    automation?.failed(error);
    throw error;
  }
}
