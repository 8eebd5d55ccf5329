// SPDX-License-Identifier: MIT
import { ALL_GROUPS } from "./groups.js";

/** Values that several parts of the page read and change, and who wants to know of it. */
export class Store {
  #listeners = new Set();

  constructor(values) {
    this.values = { ...values };
  }

  get(name) {
    return this.values[name];
  }

  set(patch) {
    const changed = new Set(Object.keys(patch).filter((name) => !Object.is(this.values[name], patch[name])));
    if (changed.size === 0) return;
    Object.assign(this.values, patch);
    for (const { names, tell } of this.#listeners) {
      if (names.some((name) => changed.has(name))) tell(this.values);
    }
  }

  /** Tells of every change of one of `names`, and once now. */
  watch(names, tell) {
    this.#listeners.add({ names, tell });
    tell(this.values);
  }
}

/** What the controls set. */
export const DEFAULTS = {
  colour: "verdict",
  static: true,
  dynamic: true,
  unknown: true,
  path: true,
  scan: false,  // the points of the scan at the slider
  dim: true,  // the map, while a scan is shown
  corrections: false,
  groups: ALL_GROUPS,  // sensors or drives whose points are shown
  height: null,  // [lowest, highest] shown, m; null: all
  range: null,  // [nearest, farthest] shown, m; null: all
  rangeFrom: "sensor",
  size: 1,
  follow: false,
  row: 0,  // of the path
  playing: false,  // in a live view: showing the newest
  trail: false,  // in a live view: what was removed from earlier scans
  speed: 1,
};
