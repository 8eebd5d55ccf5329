// SPDX-License-Identifier: MIT
// What the parts of a report share: the settings, the camera, the runs in view and the point chosen.
import { Orbit } from "./orbit.js";
import { DEFAULTS, Store } from "./store.js";

export class Session {
  constructor(settings = {}) {
    this.store = new Store({ ...DEFAULTS, ...settings, selection: null });
    this.orbit = new Orbit();
    this.views = [];  // RunView
  }

  /** The view whose scans the slider counts: the first that has any. */
  get leader() {
    return this.views.find(({ run }) => run.meta.scans > 0) ?? null;
  }

  /** Shows the row of the leader, and in the other views the same scan of the recording. */
  showRow(row) {
    const { leader, store } = this;
    if (!leader) return;
    const before = leader.sensorAt(leader.row);
    const index = leader.run.arrays["path-index"]?.[row] ?? row;
    for (const view of this.views) {
      if (view.run.meta.scans > 0) view.showRow(view === leader ? row : view.rowOfIndex(index));
    }
    if (store.get("follow")) this.#follow(leader, before);
    for (const { view } of this.views) view.move();
  }

  #follow(leader, before) {
    const now = leader.sensorAt(leader.row);
    if (!before || !now) return;
    this.orbit.set({ target: this.orbit.target.map((t, c) => t + now[c] - before[c]) });
  }

  /** Goes to a row of one run, whichever run the slider counts. */
  goTo(view, row) {
    const { leader } = this;
    const own = view === leader ? row : leader.rowOfIndex(view.run.arrays["path-index"]?.[row] ?? row);
    this.store.set({ row: own, scan: true, playing: false });
  }

  select(point) {
    for (const { overlay } of this.views) {
      overlay.setVisible("box", false);
      overlay.setVisible("sight", false);
      overlay.setVisible("way", false);
    }
    this.store.set({ selection: point });
  }

  /** More is known of the point chosen. */
  refreshSelection() {
    const { selection } = this.store.values;
    if (selection) this.select(selection.owner.point(selection.source, selection.index));
  }

  centreOnSensor() {
    const sensor = this.leader?.sensorAt(this.leader.row);
    if (sensor) this.orbit.set({ target: sensor.map((s, c) => s + this.leader.view.offset[c]) });
  }

  fit() {
    const views = this.views.filter(({ midst }) => midst);
    if (views.length === 0) return;
    const corner = (which, choose) =>
      [0, 1, 2].map((c) => choose(...views.map(({ midst, view }) => midst[which][c] + view.offset[c])));
    this.orbit.fit([corner(0, Math.min), corner(1, Math.max)], views[0].view.aspect);
  }

  top() {
    this.orbit.set({ pitch: Math.PI / 2 });
  }
}
