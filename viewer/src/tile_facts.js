// SPDX-License-Identifier: MIT
// What the page of one tile says of it, and the way to the others.
import { h } from "./dom.js";
import { count, metres, percent, plural } from "./format.js";
import "./city.css";

const WHERE = ["north", "east", "south", "west"];

export const overviewLink = ({ tile }) => h("a", { href: tile.overview }, "All tiles");

function neighbours({ neighbours: list }) {
  const groups = WHERE.map((where) => [where, list.filter((other) => other.where === where)]).filter(([, names]) => names.length);
  if (groups.length === 0) return null;
  return h("section", {}, h("h2", {}, "Tiles around it"), h("dl", { class: "facts" }, groups.map(([where, names]) =>
    h("div", {}, h("dt", {}, where), h("dd", {}, h("span", { class: "neighbours" }, names.map(({ name }) =>
      h("a", { href: `${encodeURIComponent(name)}.html` }, name))))))));
}

/** The panel "Run" of a tile's page. */
export function tileFacts({ tile }) {
  return h("div", {},
    h("dl", { class: "facts" },
      [["side", metres(tile.side)], ["voxels", count(tile.voxels)], ["scans", count(tile.scans)]].map(([name, value]) =>
        h("div", {}, h("dt", {}, name), h("dd", {}, value)))),
    h("section", {}, h("h2", {}, `Seen by ${tile.drives.length} of ${plural(tile.drives_total, "drive")}`),
      h("ul", { class: "drives" }, tile.drives.map(({ name, voxels }) =>
        h("li", {}, h("span", {}, name), h("small", {}, `${percent(voxels / Math.max(1, tile.voxels), 1)} % of the voxels`))))),
    neighbours(tile));
}
