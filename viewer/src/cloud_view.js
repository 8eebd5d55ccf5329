// SPDX-License-Identifier: MIT
// A view with clouds and lines in it: what a finished run and a live one have in common.
import { DYNAMIC, STATIC, UNKNOWN } from "./data.js";
import { Overlay } from "./overlay.js";
import { pick, project } from "./pick.js";
import { View } from "./view.js";

const LAYERS = { unknown: UNKNOWN, static: STATIC, dynamic: DYNAMIC };
const VERDICT_COLOURINGS = ["verdict", "instant", "error"];
const MAP_DIMMED = 0.72;
const MIDST = 0.99;  // of the points lie in the box that is fitted into the view

/** Box around the middle of a cloud's points along each axis; a sample of them is enough. */
export function midstOf(cloud) {
  const n = Math.min(cloud.end, 40_000);
  const box = [[], []];
  for (let c = 0; c < 3; ++c) {
    const values = Float32Array.from({ length: n }, (_, i) => cloud.low[c] + cloud.step * cloud.positions[3 * i + c]).filter(Number.isFinite).sort();
    const cut = Math.floor((values.length * (1 - MIDST)) / 2);
    box[0].push(values[cut] ?? 0);
    box[1].push(values[values.length - 1 - cut] ?? 1);
  }
  return box;
}

/** A subclass has `clouds`, {name: Cloud or null}, of which `scan` is that of the slider; and sensorAt(), point(). */
export class CloudView {
  clouds = {};
  row = -1;
  settings = null;
  midst = null;  // [low, high] of the box that matters
  pointWorld = 0.05;  // size of a point of the map, m

  constructor(run, element, orbit, offset) {
    this.run = run;
    this.view = new View(element, orbit, offset);
    this.overlay = new Overlay(this.view);
  }

  get name() {
    return this.run.meta.name;
  }

  addCloud(name, cloud) {
    this.clouds[name] = cloud;
    cloud.setUniforms({ heightScale: [this.midst[0][2], this.midst[1][2]] });
    this.view.add(cloud);
  }

  showRow(row) {
    this.row = row;
    const sensor = this.sensorAt(row);
    if (sensor) this.overlay.setSensor(sensor);
    this.apply();
  }

  /** Brings what is drawn in line with the controls. */
  apply(settings = this.settings) {
    if (!settings) return;
    this.settings = settings;
    const sensor = this.sensorAt(this.row);
    for (const line of ["path", "alarms"]) this.overlay.setVisible(line, settings.path);
    this.overlay.setVisible("sensor", settings.scan && sensor !== null);
    const { scan } = this.clouds;
    if (scan) scan.object.visible = this.scanIsShown;
    for (const cloud of Object.values(this.clouds)) this.#applyTo(cloud, cloud === scan, sensor);
    this.view.redraw();
  }

  #applyTo(cloud, isScan, sensor) {
    const { settings } = this;
    const colour = this.hasColouring(settings.colour) ? settings.colour : "verdict";
    const world = this.pointWorld * settings.size, least = Math.max(1, settings.size);
    cloud.setColouring(isScan && !VERDICT_COLOURINGS.includes(colour) ? "verdict" : colour);
    cloud.setLayers(this.layersOf(settings, isScan).map((name) => LAYERS[name]));
    cloud.showGroups(settings.groups);
    cloud.setCuts({ height: settings.height, range: settings.range, fromPath: settings.rangeFrom === "path", sensor: sensor ?? [0, 0, 0] });
    cloud.setUniforms(isScan ? { pointWorld: 1.6 * world, pointLeast: 2.2 * least } : { pointWorld: world, pointLeast: least });
    cloud.setUniforms({ markCorrected: settings.corrections, fade: !isScan && this.scanIsShown && settings.dim ? MAP_DIMMED : 0 });
  }

  layersOf(settings) {
    return Object.keys(LAYERS).filter((name) => settings[name]);
  }

  setTheme(theme) {
    this.view.setTheme(theme);
    this.overlay.setTheme(theme);
  }

  get #size() {
    const { clientWidth: width, clientHeight: height } = this.view.canvas;
    return { width, height };
  }

  /** The point under (x, y), as point() describes it; null where there is none. */
  pickAt(x, y, tolerance = 7) {
    const matrix = this.view.clipMatrix;
    const hits = [];
    for (const [source, cloud] of Object.entries(this.clouds)) {
      const hit = cloud.object.visible && pick(cloud, matrix, this.#size, [x, y], tolerance);
      if (hit) hits.push({ ...hit, source });
    }
    if (hits.length === 0) return null;
    // A point of the scan lies on its own one of the map: the scan's says more.
    const rank = ({ source, depth }) => depth - (source === "scan" ? 0.1 : 0);
    const { source, index } = hits.reduce((best, hit) => (rank(hit) < rank(best) ? hit : best));
    return this.point(source, index);
  }

  project(place) {
    return project(this.view.clipMatrix, this.#size, place);
  }
}
