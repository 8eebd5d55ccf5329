// SPDX-License-Identifier: MIT
// The panels beside the overview of a city.
import { checkbox, h } from "./dom.js";
import { bytes, count, fixed, metres, plural } from "./format.js";
import { MEASURES, trackColour } from "./city_map.js";

const LISTED = 200;

const section = (title, ...children) => h("section", {}, h("h2", {}, title), ...children);
const row = (name, value) => h("div", {}, h("dt", {}, name), h("dd", {}, value));

export const pageOf = ({ name }) => `report/${encodeURIComponent(name)}.html`;

/** What is drawn. */
export function viewPanel(store, city, map) {
  const colour = h("select", { id: "colour", "aria-label": "Colour by", onchange: () => store.set({ colour: colour.value }) },
    Object.entries(MEASURES).map(([id, { label }]) => h("option", { value: id }, label)));
  store.watch(["colour"], (values) => (colour.value = values.colour));
  const drive = h("select", { id: "drive", "aria-label": "Drive", onchange: () => store.set({ drive: Number(drive.value) }) },
    h("option", { value: -1 }, "all"), city.drives.map(({ name }, k) => h("option", { value: k }, name)));
  store.watch(["drive"], (values) => (drive.value = values.drive));
  const boxes = [["tracks", "Trajectories"], ["outlines", "Outlines and names"]].map(([name, label]) => {
    const box = checkbox(label, store.get(name), (on) => store.set({ [name]: on }));
    store.watch([name], (values) => (box.input.checked = values[name]));
    return box.element;
  });
  return [
    section("Colour by", colour),
    section("Drive", drive, h("p", { class: "muted" }, "Tiles that the drive did not see are dimmed.")),
    section("Lines", ...boxes),
    section("Camera", h("div", { class: "buttons" },
      h("button", { type: "button", title: "Key 0", onclick: () => map.fit() }, "All"),
      h("button", { type: "button", title: "Key +", onclick: () => map.zoom(1.5) }, "Nearer"),
      h("button", { type: "button", title: "Key −", onclick: () => map.zoom(1 / 1.5) }, "Farther"))),
  ];
}

const driveName = (city, k) => h("span", {}, h("i", { class: "swatch", style: `background:${trackColour(k)}` }), city.drives[k].name);

function aboutTile(city, tile) {
  return [
    h("h2", { class: "run-name" }, `Tile ${tile.name}`),
    h("p", {}, h("a", { class: "open-tile", href: pageOf(tile) }, "Open this tile in 3D")),
    h("dl", { class: "facts" }, row("side", metres(tile.side)), row("voxels", count(tile.voxels)), row("scans", count(tile.scans)),
      row("heights", `${fixed(tile.bottom, 1)} to ${fixed(tile.top, 1)} m`)),
    section(`Seen by ${tile.drives.length} of ${plural(city.drives.length, "drive")}`,
      h("ul", { class: "drives" }, tile.drives.slice(0, LISTED).map((k) => h("li", {}, driveName(city, k))))),
  ];
}

const noTile = () => h("div", { class: "empty-state" }, h("h2", {}, "Which tile?"),
  h("p", {}, "Click a tile. Here it says what the tile holds and which drives saw it."),
  h("p", { class: "muted" }, "Double click opens it in 3D."));

export function tilePanel(store, city, tiles) {
  const element = h("div", { "aria-live": "polite" });
  store.watch(["selected"], ({ selected }) => element.replaceChildren(...(tiles[selected] ? aboutTile(city, tiles[selected]) : [noTile()])));
  return element;
}

/** Links to the pages, the largest tiles first. */
export function tilesPanel(store, tiles) {
  const list = h("ul", { class: "tiles" }), note = h("p", { class: "muted" });
  const filter = h("input", { type: "search", placeholder: "name", "aria-label": "Name of a tile", oninput: () => fill() });
  function fill() {
    const { drive } = store.values;
    const found = tiles.map((tile, i) => ({ tile, i }))
      .filter(({ tile }) => tile.name.includes(filter.value.trim()) && (drive < 0 || tile.drives.includes(drive)))
      .sort((a, b) => b.tile.voxels - a.tile.voxels);
    list.replaceChildren(...found.slice(0, LISTED).map(({ tile, i }) => h("li", {},
      h("a", { href: pageOf(tile), onfocus: () => store.set({ selected: i }), onmouseenter: () => store.set({ selected: i }) }, tile.name),
      h("small", {}, `${plural(tile.voxels, "voxel")}, ${plural(tile.scans, "scan")}, ${plural(tile.drives.length, "drive")}`))));
    note.textContent = found.length > LISTED ? `The ${LISTED} with the most voxels of ${count(found.length)}.` : plural(found.length, "tile");
  }
  store.watch(["drive"], fill);
  return h("div", {}, filter, note, list);
}

function tree(value, depth = 0) {
  if (value === null || typeof value !== "object") return String(typeof value === "number" && !Number.isInteger(value) ? Number(value.toPrecision(5)) : value);
  const entries = Object.entries(value);
  const shown = entries.slice(0, 50).map(([name, inner]) => h("div", {}, h("dt", {}, name), h("dd", {}, tree(inner, depth + 1))));
  if (entries.length > 50) shown.push(h("div", {}, h("dt", {}, "…"), h("dd", {}, `${count(entries.length - 50)} more`)));
  return h("dl", { class: depth ? "tree" : "facts" }, shown);
}

export function runPanel(city, tiles, licences) {
  const sum = (name) => tiles.reduce((total, tile) => total + tile[name], 0);
  const { timing } = city;
  return h("div", {}, h("article", {},
    h("h2", { class: "run-name" }, city.name),
    h("dl", { class: "facts" }, row("tiles", count(tiles.length)), row("voxels", count(sum("voxels"))), row("voxel", metres(city.voxel_size)),
      row("drives", count(city.drives.length)), row("scans", count(city.drives.reduce((total, { scans }) => total + scans, 0))),
      timing?.peak_rss_bytes ? row("memory", bytes(timing.peak_rss_bytes)) : null, row("version", city.version)),
    section("Drives", h("ul", { class: "drives" }, city.drives.slice(0, LISTED).map(({ scans }, k) =>
      h("li", {}, driveName(city, k), h("small", {}, plural(scans, "scan")))))),
    city.scores ? h("details", {}, h("summary", {}, "Metrics"), tree(city.scores)) : null,
    timing ? h("details", {}, h("summary", {}, "Timing"), tree(timing)) : null), licences);
}
