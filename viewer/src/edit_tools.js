// SPDX-License-Identifier: MIT
// Rectangle and lasso over a canvas; with the right button, Shift or Ctrl the view moves as ever.
import { project } from "./pick.js";

const SVG = "http://www.w3.org/2000/svg";
const LEAST = 4;  // px

function inside([x, y], polygon) {
  let is = false;
  for (let i = 0, j = polygon.length - 1; i < polygon.length; j = i++) {
    const [xi, yi] = polygon[i], [xj, yj] = polygon[j];
    if (yi > y !== yj > y && x < ((xj - xi) * (y - yi)) / (yj - yi) + xi) is = !is;
  }
  return is;
}

/** Indices of the points of a cloud that are shown, and seen within the polygon, however far away. */
export function pointsWithin(view, cloud, polygon) {
  const { clientWidth: width, clientHeight: height } = view.canvas;
  const matrix = view.clipMatrix, found = [];
  for (let i = cloud.begin; i < cloud.end; ++i) {
    const place = cloud.position(i);
    if (!cloud.shows(i, ...place)) continue;
    const at = project(matrix, { width, height }, place);
    if (at && inside(at, polygon)) found.push(i);
  }
  return found;
}

/** `tool()`: "rectangle", "lasso" or another; `done(polygon)` in px of the canvas. */
export function bindTools(cell, canvas, tool, done) {
  const svg = document.createElementNS(SVG, "svg"), shape = document.createElementNS(SVG, "polygon");
  svg.classList.add("edit-shape");
  svg.append(shape);
  cell.append(svg);
  let path = null;
  const outline = () => {
    if (tool() === "lasso" || path.length === 0) return path;
    const [[x0, y0], [x1, y1]] = [path[0], path.at(-1)];
    return [[x0, y0], [x1, y0], [x1, y1], [x0, y1]];
  };
  const draw = () => shape.setAttribute("points", path ? outline().map((p) => p.join()).join(" ") : "");
  const take = (event) => {
    event.stopPropagation();
    path.push([event.offsetX, event.offsetY]);
    draw();
  };
  const listen = (name, act) => cell.addEventListener(name, act, { capture: true });
  listen("pointerdown", (event) => {
    const draws = event.target === canvas && ["rectangle", "lasso"].includes(tool()) && event.button === 0 && !event.shiftKey && !event.ctrlKey;
    if (!draws || path) return;
    path = [];
    canvas.setPointerCapture(event.pointerId);
    take(event);
  });
  listen("pointermove", (event) => path && take(event));
  listen("pointerup", (event) => {
    if (!path) return;
    take(event);
    const polygon = outline();
    const width = Math.max(...polygon.map(([x]) => x)) - Math.min(...polygon.map(([x]) => x));
    path = null;
    draw();
    if (width >= LEAST) done(polygon);
  });
  listen("pointercancel", () => {
    path = null;
    draw();
  });
}
