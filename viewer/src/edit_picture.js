// SPDX-License-Identifier: MIT
// A small picture of an edit: its cells from obliquely above, the nearer the lighter.

const WIDTH = 72, HEIGHT = 48;
const COLOURS = { static: [182, 191, 200], dynamic: [255, 138, 76], unknown: [227, 156, 193] };

export function pictureOf(edit) {
  const canvas = document.createElement("canvas");
  canvas.width = WIDTH;
  canvas.height = HEIGHT;
  canvas.setAttribute("aria-hidden", "true");
  const places = [];
  for (const numbers of Object.values(edit.cells)) {
    for (let at = 0; at < numbers.length; at += 4) {
      const [x, y, z, count] = numbers.slice(at, at + 4);
      for (let k = 0; k < count; ++k) places.push([0.8 * (x + k) - 0.6 * y, z + 0.25 * (0.6 * (x + k) + 0.8 * y), 0.6 * (x + k) + 0.8 * y]);
    }
  }
  if (places.length === 0) return canvas;
  places.sort((a, b) => b[2] - a[2]);
  const span = (axis) => {
    let low = Infinity, high = -Infinity;
    for (const place of places) [low, high] = [Math.min(low, place[axis]), Math.max(high, place[axis])];
    return [low, high];
  };
  const [left, right] = span(0), [bottom, top] = span(1), [near, far] = span(2);
  const scale = Math.min((WIDTH - 6) / (right - left + 1), (HEIGHT - 6) / (top - bottom + 1), 6);
  const context = canvas.getContext("2d");
  const size = Math.max(1, 0.95 * scale);
  for (const [x, y, depth] of places) {
    const light = 1 - 0.55 * ((depth - near) / (far - near || 1));
    context.fillStyle = `rgb(${COLOURS[edit.label].map((c) => Math.round(c * light)).join()})`;
    context.fillRect(WIDTH / 2 + scale * (x - (left + right) / 2) - size / 2, HEIGHT / 2 - scale * (y - (bottom + top) / 2) - size / 2, size, size);
  }
  return canvas;
}
