// SPDX-License-Identifier: MIT
// The panel "Objects": what moved, one by one, and the way that each of them went.
import { h } from "./dom.js";
import { compact, count, fixed, plural } from "./format.js";

const LISTED = 200;
const CLOSE = 30;  // m, from where one sees a way

/** The objects of a run: {number, first, last, nearest (rows), points, size, path, fastest, places, placeRows}. */
function objectsOf({ arrays }) {
  const numbers = arrays["object-number"];
  if (!numbers) return [];
  const begin = arrays["object-begin"];
  return Array.from(numbers, (number, i) => {
    const [first, last, nearest] = arrays["object-row"].subarray(3 * i, 3 * i + 3);
    const [points, length, width, height, path, fastest] = arrays["object-facts"].subarray(6 * i, 6 * i + 6);
    return { number, first, last, nearest, points, size: [length, width, height], path, fastest,
      places: arrays["object-place"].subarray(3 * begin[i], 3 * begin[i + 1]),
      placeRows: arrays["object-place-row"].subarray(begin[i], begin[i + 1]) };
  });
}

const ORDERS = [
  { id: "points", label: "Most points", before: (a, b) => b.points - a.points },
  { id: "path", label: "Longest way", before: (a, b) => b.path - a.path },
  { id: "fastest", label: "Fastest", before: (a, b) => b.fastest - a.fastest },
  { id: "first", label: "First seen", before: (a, b) => a.first - b.first },
];

/** Where it was in a row, or in the last one before it that is known. */
function placeAt({ places, placeRows }, row) {
  let i = placeRows.findLastIndex((known) => known <= row);
  if (i < 0) i = 0;
  return Array.from(places.subarray(3 * i, 3 * i + 3));
}

/** Goes to the scan that saw most of an object, and draws its way. */
function show(session, view, object) {
  session.select(null);
  session.goTo(view, object.nearest);
  view.overlay.showWay(object.places);
  const target = placeAt(object, object.nearest).map((p, c) => p + view.view.offset[c]);
  session.orbit.set({ target, distance: Math.min(session.orbit.distance, CLOSE) });
}

function rowOf(session, view, object) {
  const stamps = view.run.arrays["path-stamp"];
  const since = stamps[object.first] - stamps[0], seen = stamps[object.last] - stamps[object.first];
  const go = (event) => {
    show(session, view, object);
    for (const button of event.target.closest("table").querySelectorAll("button")) button.setAttribute("aria-pressed", button === event.target);
  };
  return h("tr", {},
    h("th", { scope: "row" }, h("button", { type: "button", class: "chip", "data-object": object.number, onclick: go }, String(object.number))),
    h("td", {}, `${fixed(since, 1)}`, h("small", {}, `for ${fixed(seen, 1)}`)),
    h("td", {}, compact(object.points)),
    h("td", {}, object.size.map((s) => fixed(s, 1)).join("×")),
    h("td", {}, fixed(object.path, 1), h("small", {}, `to ${fixed(object.fastest, 1)} m/s`)));
}

function tableOf(session, view, objects) {
  const heads = ["object", "seen at [s]", "points", "size [m]", "way [m]"];
  return h("div", { class: "scroll" }, h("table", { class: "numbers objects" },
    h("thead", {}, h("tr", {}, heads.map((head) => h("th", { scope: "col" }, head)))),
    h("tbody", {}, objects.slice(0, LISTED).map((object) => rowOf(session, view, object)))));
}

/** `view`: a RunView whose objects are loaded. */
export function objectPanel(session, view) {
  const objects = objectsOf(view.run);
  if (objects.length === 0) {
    return h("div", { class: "empty-state" }, h("p", {}, view.run.meta.scans ? "Nothing moved that was seen in three scans and by 20 points." : "This cloud comes without a run: it is not known what moved."));
  }
  const table = h("div", {});
  const select = h("select", { "aria-label": "Order of the objects", onchange: () => fill() }, ORDERS.map(({ id, label }) => h("option", { value: id }, label)));
  const fill = () => table.replaceChildren(tableOf(session, view, [...objects].sort(ORDERS.find(({ id }) => id === select.value).before)));
  fill();
  const total = view.run.meta.objects_total ?? objects.length;
  const listed = Math.min(LISTED, objects.length);
  return h("section", {},
    h("p", {}, `${plural(total, "object")} moved${listed < total ? `; ${count(listed)} are listed` : ""}. Choose one: the slider goes to the scan that saw most of it, and its way is drawn.`),
    h("div", { class: "field" }, select), table,
    h("p", { class: "muted" }, "The numbers are those of “convert --to objects”, which writes tables, boxes, tracks and labels of all objects."));
}
