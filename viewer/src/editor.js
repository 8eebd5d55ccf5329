// SPDX-License-Identifier: MIT
// Corrections by hand in the page that `dynamicfilter serve --edit` shows: docs/editing.md.
import * as THREE from "three";
import { finalOf } from "./data.js";
import { CellIndex } from "./edit_cells.js";
import { EditList } from "./edit_list.js";
import { editPanel } from "./edit_panel.js";
import { EditServer } from "./edit_server.js";
import { bindTools, pointsWithin } from "./edit_tools.js";
import { plural } from "./format.js";

const KEYS = { j: "static", k: "dynamic", u: "unknown" };

function highlight() {
  const points = new THREE.Points(new THREE.BufferGeometry(),
    new THREE.PointsMaterial({ color: "#3fe0ff", size: 4, sizeAttenuation: false, depthTest: false, depthWrite: false }));
  points.frustumCulled = false;
  points.visible = false;
  return points;
}

export class Editor {
  #list = new EditList();
  #selection = null;  // {points: of the map, cut, how}
  #oneScan = false;
  #marked = highlight();
  #indices = [];  // {index, rowOf} of the clouds
  tool = "instance";

  constructor(session, token) {
    this.session = session;
    this.server = new EditServer(token);
    this.panel = editPanel(this);
    this.panel.setTool(this.tool);
    this.panel.setChosen(null);
  }

  /** Once all points are there. */
  async start() {
    [this.view] = this.session.views;
    this.view.view.overlay.add(this.#marked);
    let saved;
    try {
      saved = await this.server.load();
    } catch (error) {
      return this.panel.say(error.message, "wrong");
    }
    this.document = saved.document;
    this.#addIndices(saved.document.cell_size);
    this.#list.watch((edits, before) => this.#changed(edits, before));
    this.#list.load(saved.document.edits);
    this.#tellApplied(saved.applied);
    bindTools(this.view.view.element, this.view.view.canvas, () => this.tool, (polygon) =>
      this.#chooseMap(pointsWithin(this.view.view, this.view.clouds.map, polygon), this.tool));
    this.session.store.watch(["selection"], ({ selection }) => this.#chooseInstance(selection));
    window.addEventListener("keydown", (event) => this.#key(event));
  }

  #addIndices(edge) {
    const { arrays, meta } = this.view.run;
    const { map, scan } = this.view.clouds;
    this.#indices = [{ index: new CellIndex(map, meta.origin, edge), rowOf: (i) => arrays["map-scan"]?.[i] }];
    if (!scan) return;
    const rows = new Uint32Array(scan.positions.length / 3), begin = arrays["frame-begin"];
    arrays["path-frame"].forEach((frame, row) => frame >= 0 && rows.fill(row, begin[frame], begin[frame + 1]));
    this.#indices.push({ index: new CellIndex(scan, meta.origin, edge), rowOf: (i) => rows[i] });
  }

  choose(tool) {
    this.tool = tool;
    this.panel.setTool(tool);
  }

  setOneScan(on) {
    this.#oneScan = on;
  }

  #chooseInstance(point) {
    if (!point) return this.#select(null);
    if (this.tool !== "instance") return;
    const { index } = this.#indices[0], verdict = finalOf(point.verdict);
    const { origin } = this.view.run.meta;
    const cell = point.source === "map" ? index.cellOf(point.index) : point.position.map((p, c) => Math.floor((p + origin[c]) / index.edge));
    const { keys, cut } = index.instanceAt(cell, verdict);
    this.#select({ points: index.pointsOf(keys, [verdict]), cut, how: "click" });
  }

  #chooseMap(points, how) {
    this.#forget();
    this.#select(points.length ? { points, cut: false, how } : null);
  }

  #select(selection) {
    this.#selection = selection?.points.length ? selection : null;
    this.panel.setChosen(this.#selection);
    this.#light((this.#selection?.points ?? []).flatMap((i) => this.view.clouds.map.position(i)));
  }

  /** The point that was clicked, too. */
  #forget() {
    this.session.select(null);
    this.#select(null);
  }

  #light(places) {
    this.#marked.geometry.dispose();
    this.#marked.geometry = new THREE.BufferGeometry().setAttribute("position", new THREE.Float32BufferAttribute(places, 3));
    this.#marked.visible = places.length > 0;
    this.view?.view.redraw();
  }

  mark(label) {
    if (!this.#selection) return;
    const { row } = this.session.store.values;
    const edit = { label, how: this.#selection.how, ...(this.#oneScan ? { scans: [row, row] } : {}), cells: this.#indices[0].index.cellsOf(this.#selection.points) };
    this.#forget();
    this.#list.add(edit);
  }

  undo() {
    this.#list.undo();
  }

  redo() {
    this.#list.redo();
  }

  remove(edit) {
    this.#list.remove(edit);
  }

  /** Lights up the cells of an edit, and looks at them. */
  show(edit) {
    const { origin } = this.view.run.meta, edge = this.document.cell_size, places = [];
    for (const numbers of Object.values(edit.cells)) {
      for (let at = 0; at < numbers.length; at += 4) {
        for (let k = 0; k < numbers[at + 3]; ++k) places.push(...[numbers[at] + k, numbers[at + 1], numbers[at + 2]].map((n, c) => (n + 0.5) * edge - origin[c]));
      }
    }
    if (places.length) this.session.orbit.set({ target: [0, 1, 2].map((c) => places[c] + this.view.view.offset[c]), distance: 18 });
    this.#light(places);
  }

  async apply() {
    this.panel.setBusy(true);
    this.panel.say("Writing labels and maps …");
    try {
      const { changed } = await this.server.apply();
      this.panel.say(`Applied: ${plural(changed, "label")} on disk ${changed === 1 ? "is" : "are"} not the filter's.`, "right");
    } catch (error) {
      this.panel.say(error.message, "wrong");
    }
    this.panel.setBusy(false);
  }

  #changed(edits, before) {
    this.panel.setList(this.#list);
    this.#recolour(edits, before);
    if (this.document.edits === edits) return;
    this.document = { ...this.document, edits };
    this.panel.say("Saving …");
    this.server.save(this.document).then(() => this.document.edits === edits && this.#tellApplied(false), (error) => this.panel.say(error.message, "wrong"));
  }

  #tellApplied(applied) {
    this.panel.say(applied ? "Labels and maps on disk are those shown here."
      : "Saved in edits.json. Labels and maps on disk are not changed yet: press Apply.", applied ? "right" : "");
  }

  /** What was only added to is not painted anew from the beginning. */
  #recolour(edits, before) {
    const grown = edits.length > before.length && before.every((edit, i) => edit === edits[i]);
    for (const { index, rowOf } of this.#indices) {
      if (!grown) index.cloud.verdicts.set(index.base);
      for (const edit of grown ? edits.slice(before.length) : edits) index.apply(edit, rowOf);
      index.cloud.geometry.getAttribute("verdict").needsUpdate = true;
    }
    this.view.view.redraw();
  }

  #key(event) {
    if (event.target.matches("select, textarea, [type=text]")) return;
    const key = event.key.toLowerCase();
    if (event.ctrlKey || event.metaKey) {
      if (key === "z") event.shiftKey ? this.redo() : this.undo();
      else if (key === "y") this.redo();
      else return;
    } else if (key === "escape") {
      return this.#select(null);
    } else if (KEYS[key] && !event.altKey) {
      this.mark(KEYS[key]);
    } else {
      return;
    }
    event.preventDefault();
  }

  /** For tests and scripts. */
  state() {
    return { edits: this.#list.edits.length, chosen: this.#selection?.points.length ?? 0, tool: this.tool };
  }
}
