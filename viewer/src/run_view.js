// SPDX-License-Identifier: MIT
// A finished run in a view of its own: its map, the scan at the slider, its trajectory.
import { Cloud } from "./cloud.js";
import { CloudView, midstOf } from "./cloud_view.js";
import { colouringsOf } from "./colours.js";
import { bitsOfMap, rowIsShown } from "./groups.js";
import { pathField } from "./path_field.js";

/** 32 bit integers cannot be read as floats by a shader; for a colour, 16 are enough. */
const timesOf = (rows, scans) => Uint16Array.from(rows, (row) => (65535 * row) / Math.max(scans - 1, 1));

export class RunView extends CloudView {
  /** The map's points: enough for a first picture. */
  async loadMap() {
    const { run } = this;
    await run.loadAll(["map-position", "map-verdict"]);
    const { low, step, spacing, voxel_size: voxel } = run.meta;
    const map = new Cloud({ positions: run.arrays["map-position"], verdicts: run.arrays["map-verdict"], low, step });
    this.pointWorld = Math.max(spacing || 0, (voxel || 0.2) / 4, 0.04);
    this.midst = midstOf(map);
    this.addCloud("map", map);
    this.apply();
  }

  async loadPath() {
    const { run } = this;
    await run.loadAll(["path-position", "path-stamp", "path-index", "path-frame", "path-sensor", "path-counts", "path-scores"]);
    const path = run.arrays["path-position"];
    if (!path?.length) return;
    this.overlay.setPath(path);
    this.overlay.setAlarms(path, this.run.meta.alarms ?? []);
    const { low, step } = run.meta;
    this.field = pathField(path, low, low.map((l) => l + 65535 * step));
    this.clouds.map.setPathField(this.field);
    this.apply();
  }

  /** What colours the points; then the scans. */
  async loadRest() {
    const { run } = this;
    const { map } = this.clouds;
    await run.loadAll(["map-scan", "map-intensity", "map-scans", "map-drives", "map-groups", "map-voxel", "voxel-probability"]);
    const { arrays } = run;
    if (arrays["map-intensity"]) map.setAttribute("intensity", arrays["map-intensity"], 1, true);
    if (arrays["map-scans"]) map.setAttribute("intensity", arrays["map-scans"], 1, true);
    if (arrays["map-drives"]) map.setAttribute("time", arrays["map-drives"], 1, true);
    if (arrays["map-scan"]) map.setAttribute("time", timesOf(arrays["map-scan"], run.meta.scans), 1, true);
    const groups = bitsOfMap(run);
    if (groups) map.setGroups(groups);
    const probability = arrays["voxel-probability"];
    if (arrays["map-voxel"] && probability) {
      const ofPoint = Uint8Array.from(arrays["map-voxel"], (voxel) => probability[voxel] ?? 255);
      map.setAttribute("probability", ofPoint, 1, true);
    }
    this.apply();
    await run.loadAll(["frame-begin", "frame-position", "frame-verdict", "frame-voxel"]);
    if (arrays["frame-position"] && arrays["frame-begin"]) this.#addScans();
  }

  async loadObjects() {
    await this.run.loadAll(["object-number", "object-row", "object-facts", "object-begin", "object-place", "object-place-row"]);
  }

  async loadEvidence() {
    await this.run.loadAll(["voxel-evidence", "voxel-score", "voxel-span", "pass-begin", "pass"]);
  }

  #addScans() {
    const { arrays, meta } = this.run;
    const scan = new Cloud({ positions: arrays["frame-position"], verdicts: arrays["frame-verdict"], low: meta.low, step: meta.step });
    scan.object.visible = false;
    if (this.field) scan.setPathField(this.field);
    this.addCloud("scan", scan);
    this.apply();
  }

  hasColouring(id) {
    return colouringsOf(this.run).some((colouring) => colouring.id === id);
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
    const begin = this.run.arrays["frame-begin"];
    const frame = this.frameOf(row);
    if (this.clouds.scan && frame >= 0) this.clouds.scan.setRange(begin[frame], begin[frame + 1]);
    super.showRow(row);
  }

  get scanIsShown() {
    const { settings, row } = this;
    return Boolean(settings?.scan && this.clouds.scan && this.frameOf(row) >= 0 && rowIsShown(this.run, row, settings.groups));
  }

  point(source, index) {
    const { arrays } = this.run;
    const isMap = source === "map";
    return {
      owner: this,
      source,
      index,
      position: this.clouds[source].position(index),
      verdict: this.clouds[source].verdicts[index],
      voxel: arrays[isMap ? "map-voxel" : "frame-voxel"]?.[index],
      row: isMap ? arrays["map-scan"]?.[index] : this.row,
    };
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
    for (let i = ofPoint.indexOf(voxel); i >= 0; i = ofPoint.indexOf(voxel, i + 1)) vote(this.clouds.map.position(i));
    const [cell] = [...votes].reduce((best, entry) => (entry[1] > best[1] ? entry : best));
    return cell.split(",").map((c) => (Number(c) + 0.5) * edge);
  }
}
