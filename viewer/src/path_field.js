// SPDX-License-Identifier: MIT
// Horizontal distance from the trajectory, as an image over the scene: one look-up per point, on the GPU and here.
import * as THREE from "three";

const SIZE = 192;
const SAMPLES = 400;

/** Points of the path, evenly chosen, that stand for all of it. */
function sampled(path) {
  const rows = path.length / 3;
  const n = Math.min(rows, SAMPLES);
  return Array.from({ length: n }, (_, k) => {
    const row = Math.round((k * (rows - 1)) / Math.max(n - 1, 1));
    return [path[3 * row], path[3 * row + 1]];
  });
}

export function pathField(path, low, high) {
  const extent = [0, 1].map((c) => Math.max(high[c] - low[c], 1));
  const marks = sampled(path);
  const metres = new Float32Array(SIZE * SIZE);
  let reach = 1;
  for (let row = 0; row < SIZE; ++row) {
    const y = low[1] + ((row + 0.5) / SIZE) * extent[1];
    for (let column = 0; column < SIZE; ++column) {
      const x = low[0] + ((column + 0.5) / SIZE) * extent[0];
      let least = Infinity;
      for (const [px, py] of marks) least = Math.min(least, (x - px) ** 2 + (y - py) ** 2);
      metres[row * SIZE + column] = Math.sqrt(least);
      reach = Math.max(reach, metres[row * SIZE + column]);
    }
  }
  const texture = new THREE.DataTexture(
    Uint16Array.from(metres, (m) => THREE.DataUtils.toHalfFloat(m / reach)), SIZE, SIZE, THREE.RedFormat, THREE.HalfFloatType);
  texture.minFilter = texture.magFilter = THREE.LinearFilter;
  texture.needsUpdate = true;
  const cell = (value, c) => Math.min(SIZE - 1, Math.max(0, Math.floor(((value - low[c]) / extent[c]) * SIZE)));
  return {
    texture,
    reach,
    box: [low[0], low[1], 1 / extent[0], 1 / extent[1]],
    at: (x, y) => metres[cell(y, 1) * SIZE + cell(x, 0)],
  };
}
