// SPDX-License-Identifier: MIT
// The panel "Plots". Everything over time jumps to the scan that is clicked.
import uPlot from "uplot";
import "uplot/dist/uPlot.min.css";
import { kindColour } from "./colours.js";
import { h } from "./dom.js";
import { compact, count, plural, short } from "./format.js";
import { heatmap } from "./heatmap.js";
import { countSeries, evidenceHistogram, probabilityHistogram, scoreSeries } from "./series.js";
import { currentTheme, watchTheme } from "./theme.js";

const HEIGHT = 150;
/** Colours of lines, told apart by dash too. */
const LINES = [["dynamic", []], ["corrected", [5, 3]], ["static", [2, 2]], ["unknown", [8, 3, 2, 3]]];

const style = (name) => getComputedStyle(document.documentElement).getPropertyValue(name).trim();

function axes(unit) {
  const common = { stroke: style("--muted"), grid: { stroke: style("--line"), width: 1 }, ticks: { show: false }, font: "11px system-ui" };
  return [{ ...common, size: 26, values: (_, ticks) => ticks.map((t) => `${t} s`) },
    { ...common, size: 46, values: (_, ticks) => ticks.map((t) => (t === null ? "" : unit === "%" ? `${Math.round(100 * t)}` : compact(t))) }];
}

class TimePlot {
  #plot = null;

  constructor({ title, lines, times, jump, unit, current }) {
    Object.assign(this, { lines, times, jump, unit, current });
    this.box = h("div", { class: "plot" });
    this.element = h("section", {}, h("h2", {}, title), this.box);
  }

  draw() {
    const width = this.box.clientWidth;
    if (width === 0) return;
    this.#plot?.destroy();
    const theme = currentTheme();
    const series = this.lines.map(({ label }, i) => {
      const [kind, dash] = LINES[i % LINES.length];
      return { label, stroke: kindColour(theme, kind), dash, width: 1.5, points: { show: false }, spanGaps: false,
        value: (_, v) => (v === null ? "–" : this.unit === "%" ? (100 * v).toFixed(1) : count(v)) };
    });
    this.#plot = new uPlot({
      width, height: HEIGHT, axes: axes(this.unit),
      scales: { x: { time: false }, y: { range: this.unit === "%" ? [0, 1] : (_, __, most) => [0, Math.max(1, most * 1.05)] } },
      series: [{ label: "time", value: (_, v) => (v === null ? "–" : `${v.toFixed(1)} s`) }, ...series],
      cursor: { drag: { x: true, y: false } },
      hooks: { draw: [(plot) => this.#drawCursor(plot)] },
    }, [this.times, ...this.lines.map(({ values }) => values)], this.box);
    this.#plot.over.addEventListener("click", () => {
      const row = this.#plot.cursor.idx;
      if (row !== null && row !== undefined) this.jump(row);
    });
    this.#plot.over.addEventListener("mouseleave", () => this.#showCurrent());
    this.#showCurrent();
  }

  fitWidth() {
    const width = this.box.clientWidth;
    if (!this.#plot) this.draw();
    else if (width > 0) this.#plot.setSize({ width, height: HEIGHT });
  }

  /** The numbers of the scan shown, while the pointer asks for no other. */
  #showCurrent() {
    requestAnimationFrame(() => this.#plot?.setLegend({ idx: this.current() }, false));
  }

  /** A line at the scan shown. */
  #drawCursor(plot) {
    const x = plot.valToPos(this.times[this.current()] ?? 0, "x", true);
    const { ctx, bbox } = plot;
    if (x < bbox.left || x > bbox.left + bbox.width) return;
    ctx.fillStyle = style("--text");
    ctx.fillRect(Math.round(x), bbox.top, Math.max(1, devicePixelRatio), bbox.height);
  }

  refresh() {
    this.#plot?.redraw(false, false);
    this.#showCurrent();
  }
}

function timePlots(run, jump, current) {
  const stamps = run.arrays["path-stamp"];
  if (!stamps?.length) return [];
  const times = Float64Array.from(stamps, (t) => t - stamps[0]);
  const plots = [];
  const add = (title, lines, unit) => plots.push(new TimePlot({ title, lines, times, jump, current, unit }));
  const counts = countSeries(run);
  if (counts) {
    add("Points removed per scan", [{ label: "removed", values: counts.removed }]);
    if (counts.corrected.some((n) => n !== null) && run.meta.has_instant) add("Points whose first verdict was corrected later", [{ label: "corrected", values: counts.corrected }]);
  }
  const settled = scoreSeries(run, 0), instant = run.meta.has_instant ? scoreSeries(run, 1) : null;
  if (settled) {
    const both = (name) => [{ label: "final", values: settled[name] }, instant && { label: "at once", values: instant[name] }].filter(Boolean);
    add("Moving IoU per scan [%]", both("iou"), "%");
    add("Recall of moving points [%]", both("recall"), "%");
    add("Precision of the removal [%]", both("precision"), "%");
  }
  return plots;
}

function latency(timing) {
  const stages = Object.entries(timing?.stages ?? {});
  if (stages.length === 0) return null;
  const most = Math.max(...stages.map(([, stage]) => stage.p99 ?? 0)) || 1;
  const rows = stages.map(([name, { p50, p95, p99, count: calls }]) => h("tr", {},
    h("th", { scope: "row" }, name.replaceAll("_", " "), h("small", {}, plural(calls, "call"))),
    h("td", {}, short(p50)), h("td", {}, short(p95)), h("td", {}, short(p99)),
    h("td", { class: "bars", "aria-hidden": "true" }, [p99, p95, p50].map((value, i) => h("i", { class: `bar bar-${i}`, style: `width:${(100 * value) / most}%` })))));
  return h("section", {}, h("h2", {}, "Latency by stage [ms]"),
    h("table", { class: "numbers" }, h("thead", {}, h("tr", {}, ["stage", "p50", "p95", "p99", ""].map((t) => h("th", { scope: "col" }, t)))), h("tbody", {}, rows)));
}

function probabilityBars(run) {
  const bins = probabilityHistogram(run);
  if (!bins) return null;
  const log = (n) => Math.log10(1 + n);
  const most = log(bins.reduce((a, b) => Math.max(a, b), 1));
  const words = (i) => `${count(bins[i])} voxels at ${(i / 20).toFixed(2)} to ${((i + 1) / 20).toFixed(2)}`;
  return h("section", {}, h("h2", {}, "Voxels by probability of being static"),
    h("div", { class: "histogram", role: "img", "aria-label": Array.from(bins, (_, i) => words(i)).join("; ") },
      Array.from(bins, (n, i) => h("i", { class: i < 10 ? "below" : "above", title: words(i), style: `height:${(100 * log(n)) / most}%` }))),
    h("div", { class: "scale-ends" }, h("span", {}, "0 moving"), h("span", {}, "removed | kept"), h("span", {}, "1 static")),
    h("p", { class: "muted" }, "Logarithmic: the bars of rare cases would not be seen otherwise."));
}

/** `view`: a RunView; `jump(row)`. */
export function plotsOf(view, session) {
  const { run } = view;
  const plots = timePlots(run, (row) => session.goTo(view, row), () => view.row);
  const drawAll = () => plots.forEach((plot) => plot.draw());
  const histogram = evidenceHistogram(run);
  const map = histogram && heatmap(histogram);
  const children = [...plots.map((plot) => plot.element), latency(run.meta.timing), probabilityBars(run), map?.element].filter(Boolean);
  const element = h("div", {}, children.length ? children : h("div", { class: "empty-state" }, h("p", {}, "This cloud comes without a run: there is nothing to plot.")));
  session.store.watch(["row"], () => plots.forEach((plot) => plot.refresh()));
  watchTheme(() => requestAnimationFrame(() => {
    drawAll();
    map?.draw();
  }));
  new ResizeObserver(() => plots.forEach((plot) => plot.fitWidth())).observe(element);
  return element;
}
