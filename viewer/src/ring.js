// SPDX-License-Identifier: MIT
// A cloud of bounded size: new points take the place of the oldest.
import { Cloud } from "./cloud.js";

const MOST_RANGES = 500;

export class Ring extends Cloud {
  #head = 0;

  constructor(capacity) {
    super({ positions: new Float32Array(3 * capacity), verdicts: new Uint8Array(capacity), low: [0, 0, 0], step: 1 });
    this.capacity = capacity;
    this.setRange(0, 0);
  }

  /** Writes the points, at most `capacity`, into consecutive slots and returns the first. */
  write(positions, verdicts) {
    const n = verdicts.length;
    if (this.#head + n > this.capacity) this.#head = 0;
    const begin = this.#head;
    this.#head += n;
    this.positions.set(positions, 3 * begin);
    this.setRange(0, Math.max(this.end, this.#head));
    this.changed("position", 3 * begin, 3 * n);
    this.rewrite(begin, verdicts);
    return begin;
  }

  rewrite(begin, verdicts) {
    this.verdicts.set(verdicts, begin);
    this.changed("verdict", begin, verdicts.length);
  }

  changed(name, begin, n) {
    const attribute = this.geometry.getAttribute(name);
    attribute.addUpdateRange(begin, n);
    if (attribute.updateRanges.length > MOST_RANGES) {  // a hidden page draws nothing for hours
      attribute.clearUpdateRanges();
      attribute.addUpdateRange(0, attribute.array.length);
    }
    attribute.needsUpdate = true;
  }
}
