// SPDX-License-Identifier: MIT
// Points by who saw them: the sensors of a rig, or the drives of a map. Each can be hidden.
import { checkbox, h } from "./dom.js";

export const ALL_GROUPS = -1;  // bits of a 32 bit integer; points that nobody of them saw are shown, too

const TITLES = { sensor: "Sensors", drive: "Dates" };

const isShown = (bits, k) => ((bits >> k) & 1) === 1;
const firstOf = (n) => (n === 32 ? ALL_GROUPS : (1 << n) - 1);

/** With one of `n` more, or one less; with all of them, also what nobody saw. */
function changed(bits, k, on, n) {
  const before = bits & firstOf(n);
  const next = on ? before | (1 << k) : before & ~(1 << k);
  return next === firstOf(n) ? ALL_GROUPS : next;
}

/** The groups that all of the runs have; null if there are none. */
export function groupsOf(metas) {
  const texts = metas.map(({ groups }) => JSON.stringify(groups ?? null));
  return texts.every((text) => text === texts[0]) ? metas[0].groups ?? null : null;
}

/** Bits of the points of the map; undefined without groups. */
export function bitsOfMap({ arrays }) {
  const sensors = arrays["path-sensor"];
  if (!sensors) return arrays["map-groups"];
  return arrays["map-scan"] && Uint32Array.from(arrays["map-scan"], (row) => 1 << sensors[row]);
}

/** A row of the path whose sensor is hidden has no points. */
export const rowIsShown = ({ arrays }, row, bits) => !arrays["path-sensor"] || isShown(bits, arrays["path-sensor"][row]);

function slider(store, { names }) {
  const words = (value) => (value === 0 ? "all" : names[value - 1]);
  const output = h("output", {});
  const input = h("input", {
    type: "range", min: 0, max: names.length, step: 1, value: 0, "aria-label": "Date",
    oninput: () => store.set({ groups: Number(input.value) === 0 ? ALL_GROUPS : 1 << (Number(input.value) - 1) }),
  });
  store.watch(["groups"], ({ groups }) => {
    const alone = names.findIndex((_, k) => groups === 1 << k);
    input.value = alone + 1;
    output.textContent = groups === ALL_GROUPS || alone >= 0 ? words(alone + 1) : "several";
    input.setAttribute("aria-valuetext", output.textContent);
  });
  return h("label", { class: "field" }, h("div", { class: "field-head" }, h("span", {}, "Seen at"), output), input);
}

/** A box for each, and for drives a slider from date to date. */
export function groupSection(store, groups) {
  const boxes = groups.names.map((name, k) => {
    const box = checkbox(name, isShown(store.get("groups"), k), (on) => store.set({ groups: changed(store.get("groups"), k, on, groups.names.length) }));
    box.element.dataset.group = name;
    store.watch(["groups"], (values) => (box.input.checked = isShown(values.groups, k)));
    return box.element;
  });
  return h("section", {}, h("h2", {}, TITLES[groups.kind]), groups.kind === "drive" && groups.names.length > 1 ? slider(store, groups) : null, ...boxes);
}
