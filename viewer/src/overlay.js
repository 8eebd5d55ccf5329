// SPDX-License-Identifier: MIT
// Lines over the clouds: the trajectory, the sensor, a line of sight, the way of an object, a voxel's box.
import * as THREE from "three";
import { Line2 } from "three/examples/jsm/lines/Line2.js";
import { LineGeometry } from "three/examples/jsm/lines/LineGeometry.js";
import { LineMaterial } from "three/examples/jsm/lines/LineMaterial.js";
import { LineSegments2 } from "three/examples/jsm/lines/LineSegments2.js";
import { LineSegmentsGeometry } from "three/examples/jsm/lines/LineSegmentsGeometry.js";
import { kindColour } from "./colours.js";

const material = (width, opacity = 1) =>
  new LineMaterial({ linewidth: width, transparent: true, opacity, depthTest: false, depthWrite: false });

const boxEdges = new THREE.EdgesGeometry(new THREE.BoxGeometry(1, 1, 1)).attributes.position.array;

/** A ring on the screen, whatever the distance. */
function disc() {
  const canvas = document.createElement("canvas");
  canvas.width = canvas.height = 64;
  const context = canvas.getContext("2d");
  context.arc(32, 32, 20, 0, 2 * Math.PI);
  context.fillStyle = "#fff";
  context.fill();
  context.lineWidth = 8;
  context.strokeStyle = "#000";
  context.stroke();
  const sprite = new THREE.Sprite(new THREE.SpriteMaterial({
    map: new THREE.CanvasTexture(canvas), sizeAttenuation: false, depthTest: false, transparent: true,
  }));
  sprite.scale.setScalar(0.025);
  return sprite;
}

export class Overlay {
  constructor(view) {
    this.view = view;
    this.path = new Line2(new LineGeometry(), material(2, 0.85));
    this.alarms = new LineSegments2(new LineSegmentsGeometry(), material(5));
    this.sight = new Line2(new LineGeometry(), material(2.5));
    this.way = new Line2(new LineGeometry(), material(4));
    this.box = new LineSegments2(new LineSegmentsGeometry().setPositions(boxEdges), material(2));
    this.sensor = disc();
    for (const object of this.#objects) {
      object.visible = false;
      object.frustumCulled = false;
      view.overlay.add(object);
    }
  }

  get #objects() {
    return [this.path, this.alarms, this.way, this.box, this.sight, this.sensor];
  }

  setTheme(theme) {
    this.path.material.color.set(kindColour(theme, "path"));
    this.alarms.material.color.set(kindColour(theme, "alarm"));
    this.sight.material.color.set(kindColour(theme, "corrected"));
    this.way.material.color.set(kindColour(theme, "corrected"));
    this.box.material.color.set(kindColour(theme, "mark"));
  }

  /** Rows of x, y, z; a line takes no fewer than two. */
  setPath(positions) {
    if (positions.length < 6) return;
    this.path.geometry.dispose();
    this.path.geometry = new LineGeometry().setPositions(positions);
    this.view.redraw();
  }

  /** Marks the parts of the path from row `first` to row `last` of each alarm. */
  setAlarms(positions, alarms) {
    const at = (row) => positions.subarray(3 * row, 3 * row + 3);
    const ends = [];
    for (const { first, last } of alarms) {
      for (let row = first; row < last; ++row) ends.push(...at(row), ...at(row + 1));
    }
    if (ends.length === 0) return;
    this.alarms.geometry.dispose();
    this.alarms.geometry = new LineSegmentsGeometry().setPositions(ends);
    this.view.redraw();
  }

  setVisible(what, visible) {
    this[what].visible = visible;
    this.view.redraw();
  }

  setSensor(place) {
    this.sensor.position.set(...place);
    this.view.redraw();
  }

  showSight(from, to) {
    this.sight.geometry.dispose();
    this.sight.geometry = new LineGeometry().setPositions([...from, ...to]);
    this.setVisible("sight", true);
  }

  /** The way of an object: rows of x, y, z. */
  showWay(positions) {
    if (positions.length < 6) return;
    this.way.geometry.dispose();
    this.way.geometry = new LineGeometry().setPositions(positions);
    this.setVisible("way", true);
  }

  showBox(middle, edge) {
    this.box.position.set(...middle);
    this.box.scale.setScalar(edge);
    this.setVisible("box", true);
  }
}
