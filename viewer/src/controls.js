// SPDX-License-Identifier: MIT
// The panel "View": what is drawn, and how.
import { COLOURINGS } from "./colours.js";
import { checkbox, h } from "./dom.js";
import { count, metres } from "./format.js";
import { groupSection } from "./groups.js";
import { spanInput } from "./span_input.js";

const section = (title, ...children) => h("section", {}, h("h2", {}, title), ...children);

function layerBoxes(store, layers) {
  const boxes = layers.map(({ name, label, amount, hint }) => {
    const box = checkbox(label, store.get(name), (on) => store.set({ [name]: on }), hint);
    box.element.dataset.layer = name;
    if (amount !== undefined) box.element.append(h("small", {}, count(amount)));
    store.watch([name], (values) => (box.input.checked = values[name]));
    return box.element;
  });
  return boxes;
}

function colourSelect(store, colourings) {
  const options = colourings.map(({ id, label }) => h("option", { value: id }, label));
  const select = h("select", { id: "colour", "aria-label": "Colour by", onchange: () => store.set({ colour: select.value }) }, options);
  store.watch(["colour"], ({ colour }) => (select.value = colour));
  return select;
}

function rangeFromSelect(store) {
  const select = h("select", { "aria-label": "Range is measured from", onchange: () => store.set({ rangeFrom: select.value }) },
    h("option", { value: "sensor" }, "from the sensor"),
    h("option", { value: "path" }, "from the trajectory"));
  store.watch(["rangeFrom"], ({ rangeFrom }) => (select.value = rangeFrom));
  return select;
}

function sizeInput(store) {
  const input = h("input", {
    type: "range", min: 0.4, max: 4, step: 0.1, value: 1, "aria-label": "Point size",
    oninput: () => store.set({ size: Number(input.value) }),
  });
  store.watch(["size"], ({ size }) => (input.value = size));
  return h("label", { class: "field" }, h("div", { class: "field-head" }, h("span", {}, "Point size")), input);
}

/**
 * `layers`: [{name, label, amount, hint}]; `groups`: {kind, names}, or null; `heights`: [lowest, highest] m; `reach`: the largest range, m;
 * `camera`: [{label, key, act}].
 */
export function controls({ store, layers, groups, scanLayers, colourings, heights, reach, camera }) {
  const known = COLOURINGS.filter(({ id }) => colourings.some((c) => c.id === id));
  const height = spanInput({ label: "Height", low: heights[0], high: heights[1], words: metres, change: (span) => store.set({ height: span }) });
  const range = spanInput({ label: "Range", low: 0, high: reach, words: metres, change: (span) => store.set({ range: span }) });
  store.watch(["height"], (values) => height.set(values.height));
  store.watch(["range"], (values) => range.set(values.range));
  const follow = checkbox("Follow the sensor", false, (on) => store.set({ follow: on }), "Key F");
  store.watch(["follow"], (values) => (follow.input.checked = values.follow));
  return [
    section("Colour by", colourSelect(store, known)),
    section("Points", ...layerBoxes(store, layers), sizeInput(store)),
    groups ? groupSection(store, groups) : "",
    scanLayers.length ? section("Scan and sensor", ...layerBoxes(store, scanLayers)) : "",
    section("Cut", height.element, range.element, rangeFromSelect(store)),
    section("Camera",
      h("div", { class: "buttons" }, camera.map(({ label, key, act }) =>
        h("button", { type: "button", onclick: act, title: `Key ${key}` }, label))),
      follow.element),
  ];
}
