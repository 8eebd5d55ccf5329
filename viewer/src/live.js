// SPDX-License-Identifier: MIT
// The page of a run under way.
import { licences } from "./about.js";
import { frame } from "./app.js";
import { expose } from "./automation.js";
import { colouringsWhere } from "./colours.js";
import { controls } from "./controls.js";
import { h } from "./dom.js";
import { count, fixed } from "./format.js";
import { bindKeys } from "./keys.js";
import { follow } from "./live_feed.js";
import { LiveView } from "./live_view.js";
import { pointPanel } from "./panel.js";
import { Session } from "./session.js";
import { AROUND_MIDDLE, bindCanvas, cellsOf, showLegend } from "./stage.js";
import { watchTheme } from "./theme.js";
import { Timeline } from "./timeline.js";

const SHOWN = ["colour", "static", "dynamic", "unknown", "path", "scan", "dim", "corrections", "height", "range", "size", "trail"];
const CLOSE = 45;  // m, from where a scan is seen well
const LAYERS = [
  { name: "static", label: "Static", hint: "Key Z" }, { name: "dynamic", label: "Removed", hint: "Key X" },
  { name: "unknown", label: "Unknown", hint: "Key C" }, { name: "corrections", label: "Mark corrections", hint: "Key M" },
];
const SCAN_LAYERS = [
  { name: "path", label: "Trajectory" }, { name: "scan", label: "Scan at the slider", hint: "Key P" },
  { name: "dim", label: "Dim the map below them" }, { name: "trail", label: "Removed of earlier scans" },
];

const reportLink = (address, words) => h("a", { href: address, target: "_blank" }, words);

/** The numbers that change while scans come in. */
function counters() {
  const names = ["scans", "points", "removed", "corrected", "skipped", "damaged"];
  const LABELS = { scans: "scans received", points: "points", removed: "removed at once", corrected: "corrected later", skipped: "records skipped", damaged: "records damaged" };
  const values = Object.fromEntries(names.map((name) => [name, h("dd", {}, "0")]));
  const link = h("p", { class: "report-link" });
  const element = h("div", {}, h("dl", { class: "live-counters" }, names.map((name) => h("div", {}, h("dt", {}, LABELS[name]), values[name]))), link,
    h("p", { class: "muted" }, "The newest 3 million points are kept, and of those before them every eighth for some time."), licences());
  return {
    element,
    show: (numbers) => names.forEach((name) => (values[name].textContent = numbers[name])),
    offerReport: (address) => link.replaceChildren(reportLink(address, "Open the finished report"), " or ", h("a", { href: address, download: "report.html" }, "save it")),
  };
}

class LivePage {
  total = null;
  sums = { points: 0, removed: 0, skipped: 0, damaged: 0, corrections: 0 };

  constructor() {
    this.session = new Session({ scan: true, follow: true, playing: true });
    this.counters = counters();
    this.timeline = new Timeline(this.session.store, { lives: true, words: (row) => this.#words(row) });
    const panels = [
      { id: "view", label: "View", element: h("div", { class: "controls" }) },
      { id: "live", label: "Live", element: this.counters.element },
      { id: "point", label: "Point", element: pointPanel(this.session) },
    ];
    this.page = frame({ title: "Live", subtitle: "", panels, timeline: this.timeline.element });
    const [cell] = cellsOf([{ name: "Live" }], this.page.stage);
    this.view = new LiveView("Live", cell, this.session.orbit);
    this.session.views = [this.view];
    this.banner = h("p", { class: "banner", role: "alert" });
    this.waiting = h("p", { class: "waiting", role: "status" }, "Waiting for the first scan …");
    this.page.stage.append(this.banner, this.waiting);
    this.automation = expose(this.session, { live: () => ({ ...this.sums, scans: this.view.scans.length, corrected: this.view.corrected, held: this.view.rowsHeld.length }) });
    this.#bind(panels[0].element);
    this.#show();
  }

  #bind(panel) {
    const { session, view, page } = this;
    const { store } = session;
    watchTheme((theme) => view.setTheme(theme));
    session.fit();
    const colourings = colouringsWhere((id) => view.hasColouring(id));
    panel.append(...controls({
      store, layers: LAYERS, scanLayers: SCAN_LAYERS, colourings, heights: [-5, 15], reach: 100,
      camera: [{ label: "All", key: "0", act: () => session.fit() }, { label: "Top", key: "T", act: () => session.top() },
        { label: "Sensor", key: "G", act: () => session.centreOnSensor() }],
    }));
    showLegend(session, page.stage, { heights: () => [view.midst[0][2], view.midst[1][2]], duration: () => 0 });
    store.watch(SHOWN, (settings) => view.apply(settings));
    store.watch(["row"], ({ row }) => session.showRow(row));
    store.watch(["follow"], ({ follow: on }) => on && session.centreOnSensor());
    store.watch(["playing"], ({ playing }) => playing && this.#toNewest());
    const choose = bindCanvas(session, view, page.open);
    bindKeys({ session, timeline: this.timeline, colourings: colourings.map(({ id }) => id), pickMiddle: (canvas) => choose(canvas.clientWidth / 2, canvas.clientHeight / 2, AROUND_MIDDLE) });
  }

  #words(row) {
    const { scans } = this.view;
    const scan = scans[row];
    return scan ? `scan ${scan.index} · ${fixed(scan.stamp - scans[0].stamp, 1)} s\n${row + 1} of ${count(scans.length)} received` : "";
  }

  #toNewest() {
    const newest = this.view.scans.length - 1;
    if (newest >= 0) this.session.store.set({ row: newest });
  }

  state({ name, input, total, done, report }) {
    this.total = total;
    document.title = `${name}, live – DynamicFilter`;
    document.querySelector(".head h1").textContent = name;
    document.querySelector(".subtitle").textContent = [input, done ? "finished" : "under way"].filter(Boolean).join(" · ");
    if (done && report && !this.report) this.report = this.#takeReport().catch(() => this.#say("finished"));  // the server was quicker
    this.#show();
  }

  /** The server leaves soon after the run: the report is fetched now, and the link works without it. */
  async #takeReport() {
    const answer = await fetch("/report.html");
    this.address = URL.createObjectURL(new Blob([await answer.arrayBuffer()], { type: "text/html" }));
    this.counters.offerReport(this.address);
    this.#say("finished");
  }

  #say(kind) {
    const words = { lost: ["Connection lost. Trying again …"], finished: ["The run is finished. ", this.address ? reportLink(this.address, "Open the report") : "Its report is report.html, in its output folder."], none: [] }[kind];
    this.banner.dataset.kind = kind;
    this.banner.replaceChildren(...words);
  }

  lost() {
    if (!this.report) this.#say("lost");  // else nothing more is wanted of the server
  }

  back() {
    if (!this.report) this.#say("none");
  }

  take(records, { skipped, damaged }) {
    const { sums, view, session } = this;
    sums.skipped += skipped;
    sums.damaged += damaged;
    const first = view.scans.length === 0;
    for (const record of records) {
      if (record.kind === "scan") this.#takeScan(record);
      else if (view.takeCorrection(record) === null) ++sums.skipped;
      else ++sums.corrections;
    }
    if (view.scans.length === 0) return this.#show();
    this.waiting.remove();
    this.timeline.setRows({ frames: view.rowsHeld, stamps: view.scans.map(({ stamp }) => stamp), amounts: view.scans.map(({ counts }) => counts[1]) });
    if (first) {
      session.showRow(0);
      session.fit();
      session.centreOnSensor();
      session.orbit.set({ distance: Math.min(session.orbit.distance, CLOSE) });
    }
    if (session.store.get("playing")) this.#toNewest();
    return this.#show();
  }

  #takeScan(scan) {
    this.view.takeScan(scan);
    this.sums.points += scan.counts.reduce((a, b) => a + b, 0);
    this.sums.removed += scan.counts[1];
  }

  #show() {
    const { sums, view, total } = this;
    this.counters.show({
      scans: total ? `${count(view.scans.length)} of ${count(total)}` : count(view.scans.length), points: count(sums.points),
      removed: count(sums.removed), corrected: count(view.corrected), skipped: count(sums.skipped), damaged: count(sums.damaged),
    });
  }
}

export async function startLive() {
  const page = new LivePage();
  page.automation.done();
  await follow({ state: (json) => page.state(json), records: (list, losses) => page.take(list, losses), lost: () => page.lost(), back: () => page.back() });
}
