// SPDX-License-Identifier: MIT
// The pictures of a page: their cells, what pointers do in them, the legend over them.
import { thinned } from "./about.js";
import { h } from "./dom.js";
import { legend } from "./legend.js";
import { steer } from "./orbit_input.js";
import { currentTheme, watchTheme } from "./theme.js";

/** px: without a pointer one aims less well. */
export const AROUND_MIDDLE = 24;

/** As many columns as make the cells of a pleasant shape. */
function arrange(stage, n) {
  const misfit = (columns) => {
    const rows = Math.ceil(n / columns);
    return Math.abs(Math.log(((stage.clientWidth / columns) * rows) / stage.clientHeight / 1.3)) + 0.3 * (columns * rows - n);
  };
  const choose = () => {
    const columns = Array.from({ length: n }, (_, i) => i + 1).reduce((best, c) => (misfit(c) < misfit(best) ? c : best), 1);
    stage.style.gridTemplateColumns = `repeat(${columns}, minmax(0, 1fr))`;
  };
  choose();
  new ResizeObserver(choose).observe(stage);
}

/** An element per run, with its name if there are several. */
export function cellsOf(metas, stage) {
  arrange(stage, metas.length);
  return metas.map((meta) => {
    const cell = h("div", { class: "cell", role: "group", "aria-label": meta.name },
      h("div", { class: "caption" }, metas.length > 1 ? h("h2", {}, meta.name) : null, meta.points_total > meta.points_shown ? h("p", {}, thinned(meta)) : null));
    stage.append(cell);
    return cell;
  });
}

/** Turns, chooses and centres by mouse and fingers; gives what chooses at (x, y). */
export function bindCanvas(session, view, open) {
  const { canvas } = view.view;
  canvas.setAttribute("aria-label", `Points of ${view.name}. Enter explains the one in the middle.`);
  canvas.setAttribute("role", "application");
  const choose = (x, y, tolerance) => {
    const point = view.pickAt(x, y, tolerance);
    session.select(point);
    if (point) open("point");
  };
  steer(canvas, session.orbit, {
    click: choose,
    doubleClick: (x, y) => {
      const point = view.pickAt(x, y, 12);
      if (point) session.orbit.set({ target: point.position.map((p, c) => p + view.view.offset[c]) });
    },
  });
  return choose;
}

/** `heights()` and `duration()`: what the ends of those scales mean. */
export function showLegend(session, stage, { heights, duration }) {
  const box = h("div", { class: "legend", role: "region", "aria-label": "Legend" });
  stage.append(box);
  const draw = () => box.replaceChildren(...legend(session.store.values, currentTheme(), { heights: heights(), duration: duration() }));
  session.store.watch(["colour", "corrections"], draw);
  watchTheme(draw);
}
