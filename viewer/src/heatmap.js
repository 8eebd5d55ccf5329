// SPDX-License-Identifier: MIT
import { scaleImage } from "./colours.js";
import { h } from "./dom.js";
import { count } from "./format.js";

const CELL = 22;  // px of the image; the page scales it

const nameOf = (bin, last) => (bin < 2 ? String(bin) : bin === last ? `${2 ** (bin - 1)}+` : String(2 ** (bin - 1)));

/** Voxels by n_occ and n_free; brighter: more of them, on a logarithmic scale. */
export function heatmap({ cells, size, most }) {
  const canvas = h("canvas", { width: size * CELL, height: size * CELL, role: "img", "aria-label": "Voxels by how often they were seen occupied and seen through" });
  const told = h("p", { class: "muted", role: "status" }, "Static things lie to the right and low; what moved is high and to the left.");
  const { image } = scaleImage(256);
  const binAt = (event) => {
    const box = canvas.getBoundingClientRect();
    const clamp = (x) => Math.max(0, Math.min(size - 1, Math.floor(x * size)));
    return [clamp((event.clientX - box.left) / box.width), size - 1 - clamp((event.clientY - box.top) / box.height)];
  };
  canvas.addEventListener("pointermove", (event) => {
    const [occupied, free] = binAt(event);
    told.textContent = `${count(cells[free * size + occupied])} voxels: seen occupied ${nameOf(occupied, size - 1)}, seen through ${nameOf(free, size - 1)} times (or up to the next step)`;
  });

  function draw() {
    const context = canvas.getContext("2d");
    context.fillStyle = getComputedStyle(document.documentElement).getPropertyValue("--sunken");
    context.fillRect(0, 0, canvas.width, canvas.height);
    for (let free = 0; free < size; ++free) {
      for (let occupied = 0; occupied < size; ++occupied) {
        const n = cells[free * size + occupied];
        if (n === 0) continue;
        const at = 4 * Math.round((255 * Math.log(1 + n)) / Math.log(1 + most));
        context.fillStyle = `rgb(${image[at]},${image[at + 1]},${image[at + 2]})`;
        context.fillRect(occupied * CELL, (size - 1 - free) * CELL, CELL - 1, CELL - 1);
      }
    }
  }
  draw();
  const ticks = (order) => order.map((bin) => h("span", {}, nameOf(bin, size - 1)));
  const bins = Array.from({ length: size }, (_, i) => i);
  return {
    draw,
    element: h("section", { class: "heatmap" }, h("h2", {}, "Evidence of the voxels"),
      h("div", { class: "heatmap-grid" },
        h("span", { class: "axis-y" }, "seen through, n_free"), h("div", { class: "ticks-y" }, ticks([...bins].reverse())), canvas,
        h("div", { class: "ticks-x" }, ticks(bins)), h("span", { class: "axis-x" }, "seen occupied, n_occ")), told),
  };
}
