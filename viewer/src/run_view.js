// SPDX-License-Identifier: MIT
// A run in a view of its own: its map, the scan at the slider, its trajectory.
import { Cloud } from "./cloud.js";
import { colouringsOf } from "./colours.js";
import { DYNAMIC, STATIC, UNKNOWN } from "./data.js";
import { Overlay } from "./overlay.js";
import { pathField } from "./path_field.js";
import { pick, project } from "./pick.js";
import { View } from "./view.js";

const LAYERS = { unknown: UNKNOWN, static: STATIC, dynamic: DYNAMIC };
const VERDICT_COLOURINGS = ["verdict", "instant", "error"];
const MIDST = 0.99;  // of the points lie in the box that is fitted into the view

/** Box around the middle of the points along each axis; a sample of them is enough. */
function midstOf(cloud) {
  const n = Math.min(cloud.positions.length / 3, 40_000);
  const box = [[], []];
  for (let c = 0; c < 3; ++c) {
    const values = Float32Array.from({ length: n }, (_, i) => cloud.low[c] + cloud.step * cloud.positions[3 * i + c]).sort();
    const cut = Math.floor((n * (1 - MIDST)) / 2);
    box[0].push(n ? values[cut] : 0);
    box[1].push(n ? values[n - 1 - cut] : 1);
  }
  return box;
}

/** 32 bit integers cannot be read as floats by a shader; for a colour, 16 are enough. */
const timesOf = (rows, scans) => Uint16Array.from(rows, (row) => (65535 * row) / Math.max(scans - 1, 1));

export class RunView {
  constructor(run, element, orbit, offset) {
    this.run = run;
    this.view = new View(element, orbit, offset);
    this.overlay = new Overlay(this.view);
    this.map = null;
    this.scan = null;
    this.row = -1;
    this.settings = null;
  }

  get name() {
    return this.run.meta.name;
  }

  /** The map's points: enough for a first picture. */
  async loadMap() {
    const { run } = this;
    await run.loadAll(["map-position", "map-verdict"]);
    const { low, step, spacing, voxel_size: voxel } = run.meta;
    this.map = new Cloud({ positions: run.arrays["map-position"], verdicts: run.arrays["map-verdict"], low, step });
    this.pointWorld = Math.max(spacing || 0, (voxel || 0.2) / 4, 0.04);
    this.midst = midstOf(this.map);
    this.map.setUniforms({ heightScale: [this.midst[0][2], this.midst[1][2]] });
    this.view.add(this.map);
    this.apply();
  }

  async loadPath() {
    const { run } = this;
    await run.loadAll(["path-position", "path-stamp", "path-index", "path-frame", "path-counts", "path-scores"]);
    const path = run.arrays["path-position"];
    if (!path?.length) return;
    this.overlay.setPath(path);
    const { low, step } = run.meta;
    this.field = pathField(path, low, low.map((l) => l + 65535 * step));
    this.map.setPathField(this.field);
    this.apply();
  }

  /** What colours the points; then the scans. */
  async loadRest() {
    const { run, map } = this;
    await run.loadAll(["map-scan", "map-intensity", "map-voxel", "voxel-probability"]);
    const { arrays } = run;
    if (arrays["map-intensity"]) map.setAttribute("intensity", arrays["map-intensity"], 1, true);
    if (arrays["map-scan"]) map.setAttribute("time", timesOf(arrays["map-scan"], run.meta.scans), 1, true);
    const probability = arrays["voxel-probability"];
    if (arrays["map-voxel"] && probability) {
      const ofPoint = Uint8Array.from(arrays["map-voxel"], (voxel) => probability[voxel] ?? 255);
      map.setAttribute("probability", ofPoint, 1, true);
    }
    this.view.redraw();
    await run.loadAll(["frame-begin", "frame-position", "frame-verdict", "frame-voxel"]);
    if (arrays["frame-position"] && arrays["frame-begin"]) this.#addScans();
  }

  async loadEvidence() {
    await this.run.loadAll(["voxel-evidence", "voxel-span", "pass-begin", "pass"]);
  }

  #addScans() {
    const { arrays, meta } = this.run;
    this.scan = new Cloud({
      positions: arrays["frame-position"], verdicts: arrays["frame-verdict"], low: meta.low, step: meta.step,
    });
    this.scan.object.visible = false;
    if (this.field) this.scan.setPathField(this.field);
    this.scan.setUniforms({ heightScale: [this.midst[0][2], this.midst[1][2]] });
    this.view.add(this.scan);
    this.apply();
  }

  sensorAt(row) {
    const path = this.run.arrays["path-position"];
    return path && row >= 0 && 3 * row + 2 < path.length ? Array.from(path.subarray(3 * row, 3 * row + 3)) : null;
  }

  frameOf(row) {
    return this.run.arrays["path-frame"]?.[row] ?? -1;
  }

  /** The row of the recording's scan `index`, or of the last one before it. */
  rowOfIndex(index) {
    const indices = this.run.arrays["path-index"] ?? [];
    let low = 0, high = indices.length;
    while (low < high) {
      const middle = (low + high) >> 1;
      if (indices[middle] <= index) low = middle + 1;
      else high = middle;
    }
    return Math.max(0, low - 1);
  }

  /** Shows a row of the path: its sensor, and its points where the playback has them. */
  showRow(row) {
    this.row = row;
    const begin = this.run.arrays["frame-begin"];
    const frame = this.frameOf(row);
    if (this.scan && frame >= 0) this.scan.setRange(begin[frame], begin[frame + 1]);
    const sensor = this.sensorAt(row);
    if (sensor) this.overlay.setSensor(sensor);
    this.apply();
  }

  get scanIsShown() {
    return Boolean(this.settings?.scan && this.scan && this.frameOf(this.row) >= 0);
  }

  apply(settings = this.settings) {
    if (!settings) return;
    this.settings = settings;
    const { map, scan, overlay } = this;
    overlay.setVisible("path", settings.path);
    overlay.setVisible("sensor", settings.scan && this.sensorAt(this.row) !== null);
    if (!map) return;
    if (scan) scan.object.visible = this.scanIsShown;
    const colour = colouringsOf(this.run).some(({ id }) => id === settings.colour) ? settings.colour : "verdict";
    const layers = Object.keys(LAYERS).filter((name) => settings[name]).map((name) => LAYERS[name]);
    const cuts = {
      height: settings.height, range: settings.range, fromPath: settings.rangeFrom === "path",
      sensor: this.sensorAt(this.row) ?? [0, 0, 0],
    };
    map.setColouring(colour);
    scan?.setColouring(VERDICT_COLOURINGS.includes(colour) ? colour : "verdict");
    const world = this.pointWorld * settings.size;
    map.setUniforms({ fade: this.scanIsShown && settings.dim ? 0.72 : 0, pointWorld: world, pointLeast: Math.max(1, settings.size) });
    scan?.setUniforms({ pointWorld: 1.6 * world, pointLeast: 2.2 * Math.max(1, settings.size) });
    for (const cloud of [map, scan]) {
      if (!cloud) continue;
      cloud.setLayers(layers);
      cloud.setCuts(cuts);
      cloud.setUniforms({ markCorrected: settings.corrections });
    }
    this.view.redraw();
  }

  setTheme(theme) {
    this.view.setTheme(theme);
    this.overlay.setTheme(theme);
  }

  get #size() {
    const { clientWidth: width, clientHeight: height } = this.view.canvas;
    return { width, height };
  }

  /** The point under (x, y): {owner, source, index, position, verdict, voxel, row}, or null. */
  pickAt(x, y, tolerance = 7) {
    const matrix = this.view.clipMatrix;
    const hits = [];
    for (const source of ["scan", "map"]) {
      const cloud = this[source];
      if (!cloud?.object.visible) continue;
      const hit = pick(cloud, matrix, this.#size, [x, y], tolerance);
      if (hit) hits.push({ ...hit, source });
    }
    if (hits.length === 0) return null;
    const { source, index } = hits.reduce((best, hit) => (hit.depth < best.depth - 0.1 ? hit : best));
    return this.point(source, index);
  }

  point(source, index) {
    const { arrays } = this.run;
    const stored = source === "map" ? "map" : "frame";
    return {
      owner: this,
      source,
      index,
      position: this[source].position(index),
      verdict: this[source].verdicts[index],
      voxel: arrays[`${stored}-voxel`]?.[index],
      row: source === "map" ? arrays["map-scan"]?.[index] : this.row,
    };
  }

  project(place) {
    return project(this.view.clipMatrix, this.#size, place);
  }

  /** Middle of a point's voxel: that of most points in it, as a quantised point may lie just outside. */
  voxelMiddle({ voxel, position }) {
    const edge = this.run.meta.voxel_size;
    const votes = new Map();
    const vote = (place) => {
      const cell = place.map((p) => Math.floor(p / edge)).join();
      votes.set(cell, (votes.get(cell) ?? 0) + 1);
    };
    vote(position);
    const ofPoint = this.run.arrays["map-voxel"];
    for (let i = ofPoint.indexOf(voxel); i >= 0; i = ofPoint.indexOf(voxel, i + 1)) vote(this.map.position(i));
    const [cell] = [...votes].reduce((best, entry) => (entry[1] > best[1] ? entry : best));
    return cell.split(",").map((c) => (Number(c) + 0.5) * edge);
  }
}
