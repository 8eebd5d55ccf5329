// SPDX-License-Identifier: MIT
// Where the camera is. One for all views of a page, in metres from the page's origin.

export const FIELD_OF_VIEW = (50 * Math.PI) / 180;
const STEEPEST = Math.PI / 2 - 1e-3;  // looking straight down leaves no direction to be up

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

  /** Looks obliquely at a box so that all of it is in view. */
  fit([low, high], aspect) {
    const target = low.map((l, c) => (l + high[c]) / 2);
    const half = high.map((x, c) => (x - low[c]) / 2);
    const alongX = half[0] > half[1];
    const yaw = alongX ? -Math.PI / 2 - 0.35 : -0.35;  // the long side lies across the screen
    const across = alongX ? half[0] : half[1], deep = alongX ? half[1] : half[0];
    const tangent = Math.tan(FIELD_OF_VIEW / 2);
    const distance = 1.12 * Math.max(across / (tangent * Math.max(aspect, 0.3)), 0.55 * deep / tangent) + 0.35 * deep;
    this.set({ target, yaw, pitch: 0.55, distance: Math.max(distance, 2) });
  }
}
