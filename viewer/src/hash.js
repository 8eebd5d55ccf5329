// SPDX-License-Identifier: MIT
// The view as a link: settings that differ from the usual ones, and the camera.
import { debounce } from "./dom.js";
import { COLOURINGS } from "./colours.js";
import { DEFAULTS } from "./store.js";

const FLAGS = ["static", "dynamic", "unknown", "path", "scan", "dim", "corrections", "follow"];
const KEPT = ["colour", "row", "groups", "size", "height", "range", "rangeFrom", ...FLAGS];

const round = (x) => String(Number(x.toFixed(3)));
const numbers = (text, n) => {
  const list = text.split(",").map(Number);
  return list.length === n && list.every(Number.isFinite) ? list : null;
};

const READERS = {
  colour: (text) => (COLOURINGS.some(({ id }) => id === text) ? text : undefined),
  row: (text) => (/^\d{1,9}$/.test(text) ? Number(text) : undefined),
  groups: (text) => (/^-?\d{1,10}$/.test(text) ? Number(text) | 0 : undefined),
  size: (text) => (Number(text) > 0 && Number(text) <= 4 ? Number(text) : undefined),
  height: (text) => numbers(text, 2) ?? undefined,
  range: (text) => numbers(text, 2) ?? undefined,
  rangeFrom: (text) => (text === "path" ? text : undefined),
  ...Object.fromEntries(FLAGS.map((name) => [name, (text) => (text === "1" ? true : text === "0" ? false : undefined)])),
};

const write = (value) => (typeof value === "boolean" ? (value ? "1" : "0") : Array.isArray(value) ? value.map(round).join() : String(value));

function toHash(values, orbit) {
  const parts = KEPT.filter((name) => values[name] !== DEFAULTS[name]).map((name) => `${name}=${write(values[name])}`);
  const point = values.selection;
  if (point) parts.push(`point=${point.owner.run.number}.${point.source}.${point.index}`);
  parts.push(`camera=${[...orbit.target, orbit.yaw, orbit.pitch, orbit.distance].map(round).join()}`);
  return `#${parts.join("&")}`;
}

function pointOf(text) {
  const [, run, source, index] = /^(\d+)\.(map|scan)\.(\d{1,9})$/.exec(text) ?? [];
  return run ? { run: Number(run), source, index: Number(index) } : null;
}

/** What a link says: {settings, camera, point}; what makes no sense is left out. */
export function fromHash(hash) {
  const settings = {};
  let camera = null, point = null;
  for (const part of hash.slice(1).split("&")) {
    const [name, text = ""] = part.split("=");
    if (name === "camera") camera = numbers(text, 6);
    if (name === "point") point = pointOf(text);
    const value = READERS[name]?.(text);
    if (value !== undefined) settings[name] = value;
  }
  return { settings, point, camera: camera && { target: camera.slice(0, 3), yaw: camera[3], pitch: camera[4], distance: camera[5] } };
}

/** Keeps the address up to date, without an entry in the history for every turn of the view. */
export function keepHash({ store, orbit }) {
  const write = debounce(() => history.replaceState(null, "", toHash(store.values, orbit)), 400);
  store.watch([...KEPT, "selection"], write);
  orbit.watch(write);
}
