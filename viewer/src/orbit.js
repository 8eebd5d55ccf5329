// SPDX-License-Identifier: MIT
// Where the camera is. One for all views of a page, in metres from the page's origin.

export const FIELD_OF_VIEW = (50 * Math.PI) / 180;
const STEEPEST = Math.PI / 2 - 1e-3;  // looking straight down leaves no direction to be up

const OBLIQUE_YAWS = [-0.35, -0.6, -0.9, -1.2, -1.9, -2.2];

const OBLIQUE_PITCH = 0.75;

const clamp = (x, low, high) => Math.min(high, Math.max(low, x));

export class Orbit {
  target = [0, 0, 0];
  yaw = -0.9;
  pitch = 0.6;
  distance = 50;
  #listeners = new Set();

  watch(tell) {
    this.#listeners.add(tell);
  }

  set(patch) {
    Object.assign(this, patch);
    this.pitch = clamp(this.pitch, -STEEPEST, STEEPEST);
    this.distance = clamp(this.distance, 0.2, 5000);
    for (const tell of this.#listeners) tell(this);
  }

  /** From the target to the camera, of length 1. */
  get direction() {
    const level = Math.cos(this.pitch);
    return [level * Math.cos(this.yaw), level * Math.sin(this.yaw), Math.sin(this.pitch)];
  }

  get eye() {
    return this.direction.map((d, c) => this.target[c] + this.distance * d);
  }

  /** The screen's right and up, in the scene. */
  get axes() {
    const right = [-Math.sin(this.yaw), Math.cos(this.yaw), 0];
    const steep = Math.sin(this.pitch);
    const up = [-steep * Math.cos(this.yaw), -steep * Math.sin(this.yaw), Math.cos(this.pitch)];
    return { right, up };
  }

  rotate(yaw, pitch) {
    this.set({ yaw: this.yaw + yaw, pitch: this.pitch + pitch });
  }

  /** Moves what is seen by this share of the screen's height. */
  pan(x, y) {
    const height = 2 * this.distance * Math.tan(FIELD_OF_VIEW / 2);
    const { right, up } = this.axes;
    this.set({ target: this.target.map((t, c) => t - height * (x * right[c] + y * up[c])) });
  }

  /** Nearer by `factor`; the place at (x, y), in half heights from the middle, stays where it is. */
  zoom(factor, x = 0, y = 0) {
    const distance = clamp(this.distance / factor, 0.2, 5000);
    const shift = (this.distance - distance) * Math.tan(FIELD_OF_VIEW / 2);
    const { right, up } = this.axes;
    this.set({ distance, target: this.target.map((t, c) => t + shift * (x * right[c] + y * up[c])) });
  }

  /** Looks obliquely at a box, from the side from which it fills a screen of this aspect best. */
  fit(box, aspect) {
    const target = box[0].map((low, c) => (low + box[1][c]) / 2);
    const tried = OBLIQUE_YAWS.map((yaw) => {
      Object.assign(this, { yaw, pitch: OBLIQUE_PITCH });
      return { yaw, distance: this.#distanceToHold(box, target, aspect) };
    });
    const best = tried.reduce((a, b) => (b.distance < a.distance ? b : a));
    this.set({ target, yaw: best.yaw, pitch: OBLIQUE_PITCH, distance: 1.04 * best.distance });
  }

  /** How far away all corners of a box are in view. */
  #distanceToHold([low, high], target, aspect) {
    const { right, up } = this.axes;
    const { direction } = this;
    const tangent = Math.tan(FIELD_OF_VIEW / 2);
    let distance = 0;
    for (let corner = 0; corner < 8; ++corner) {
      const d = target.map((t, c) => ((corner >> c) & 1 ? high[c] : low[c]) - t);
      const along = (axis) => Math.abs(axis[0] * d[0] + axis[1] * d[1] + axis[2] * d[2]);
      const nearer = direction[0] * d[0] + direction[1] * d[1] + direction[2] * d[2];
      distance = Math.max(distance, nearer + along(right) / (tangent * aspect), nearer + along(up) / tangent);
    }
    return distance;
  }
}
