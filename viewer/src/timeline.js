// SPDX-License-Identifier: MIT
// The bar below the picture: a slider over the scans, and what plays them.
import { h } from "./dom.js";

const SPEEDS = [0.25, 0.5, 1, 2, 5, 10];
const TICK = 33;  // ms

const icon = (path) => {
  const template = document.createElement("template");
  template.innerHTML = `<svg viewBox="0 0 16 16" aria-hidden="true"><path d="${path}"/></svg>`;
  return template.content.firstChild;
};
const ICONS = { play: "M4 2.5v11l9-5.5z", pause: "M4 3h3v10H4zM9 3h3v10H9z", back: "M12 3v10L5.5 8zM3 3h2v10H3z", next: "M4 3v10l6.5-5zM11 3h2v10h-2z" };

export class Timeline {
  #timer = 0;
  #clock = 0;  // ms, when the row being played was due
  #time = 0;  // s, of the recording

  /** `words(row)`: what a row is called. Where `lives`, playing means to show the newest, and whoever adds rows sees to it. */
  constructor(store, { words, lives = false }) {
    this.store = store;
    this.words = words;
    this.lives = lives;
    this.frames = [];
    this.stamps = [];
    this.amounts = [];
    this.alarms = [];
    this.slider = h("input", {
      type: "range", min: 0, max: 0, step: 1, value: 0, "aria-label": "Scan",
      oninput: () => store.set({ row: Number(this.slider.value), scan: true, playing: false }),
    });
    this.strip = h("canvas", { class: "strip", "aria-hidden": "true" });
    this.label = h("output", { class: "when", "aria-live": "off" });
    this.playButton = h("button", { type: "button", class: "play", onclick: () => this.toggle() });
    const speed = h("select", { "aria-label": "Speed", onchange: () => store.set({ speed: Number(speed.value) }) },
      SPEEDS.map((s) => h("option", { value: s }, `${s}×`)));
    this.element = h("div", { class: "timeline empty", role: "group", "aria-label": "Playback" },
      h("div", { class: "transport" },
        h("button", { type: "button", "aria-label": "Scan before", title: "Key ←", onclick: () => this.step(-1) }, icon(ICONS.back)),
        this.playButton,
        h("button", { type: "button", "aria-label": "Next scan", title: "Key →", onclick: () => this.step(1) }, icon(ICONS.next)),
        lives ? null : speed),
      h("div", { class: "track" }, this.strip, this.slider), this.label);
    store.watch(["speed"], (values) => (speed.value = values.speed));
    store.watch(["row"], ({ row }) => this.#showRow(row));
    store.watch(["playing"], ({ playing }) => this.#showPlaying(playing));
    new ResizeObserver(() => this.#drawStrip()).observe(this.strip);
  }

  /**
   * `frames`: rows that can be shown, ascending; `stamps`: by row, s; `amounts`: by row, drawn above the slider;
   * `alarms`: [{first, last}] of rows, marked there.
   */
  setRows({ frames, stamps, amounts, alarms = [] }) {
    Object.assign(this, { frames, stamps, amounts, alarms });
    this.slider.max = Math.max(0, stamps.length - 1);
    this.element.classList.toggle("empty", stamps.length === 0);
    this.#drawStrip();
    this.#showRow(this.store.get("row"));
  }

  toggle() {
    const { playing, row } = this.store.values;
    const last = this.frames.at(-1) ?? 0;
    const start = this.lives ? last : row >= last ? this.frames[0] ?? 0 : row;
    this.store.set({ playing: !playing, scan: true, ...(playing ? {} : { row: start }) });
  }

  /** To the frame before or after the row. */
  step(direction) {
    const { row } = this.store.values;
    const next = direction > 0 ? this.frames.find((r) => r > row) : this.frames.findLast((r) => r < row);
    this.store.set({ row: next ?? row, scan: true, playing: false });
  }

  /** To a frame by its number; negative ones count from the end. */
  jump(frame) {
    this.store.set({ row: this.frames.at(frame) ?? 0, scan: true, playing: false });
  }

  #showRow(row) {
    this.slider.value = row;
    const words = this.stamps.length ? this.words(row) : "no scans";
    this.label.textContent = words;
    this.slider.setAttribute("aria-valuetext", words);
  }

  #showPlaying(playing) {
    this.playButton.replaceChildren(icon(playing ? ICONS.pause : ICONS.play));
    this.playButton.setAttribute("aria-label", playing ? "Pause" : "Play");
    this.playButton.title = "Space";
    clearTimeout(this.#timer);
    if (!playing || this.lives) return;
    this.#time = this.stamps[this.store.get("row")] ?? 0;
    this.#clock = performance.now();
    this.#timer = setTimeout(() => this.#tick(), TICK);
  }

  /** Plays by the stamps; where drawing is slow, rows are left out. */
  #tick() {
    const now = performance.now();
    this.#time += ((now - this.#clock) / 1000) * this.store.get("speed");
    this.#clock = now;
    const { row } = this.store.values;
    const due = this.frames.findLast((r) => this.stamps[r] <= this.#time) ?? row;
    if (due > row) this.store.set({ row: due });
    if (row >= (this.frames.at(-1) ?? 0)) this.store.set({ playing: false });
    else this.#timer = setTimeout(() => this.#tick(), TICK);
  }

  /** How much was removed over time, as a hint where something happens. */
  #drawStrip() {
    const { strip, amounts } = this;
    const width = (strip.width = strip.clientWidth * devicePixelRatio);
    const height = (strip.height = strip.clientHeight * devicePixelRatio);
    if (width === 0 || amounts.length < 2) return;
    const most = amounts.reduce((a, b) => Math.max(a, b), 1);
    const context = strip.getContext("2d");
    context.beginPath();
    context.moveTo(0, height);
    const every = Math.max(1, Math.floor(amounts.length / width));
    for (let i = 0; i < amounts.length; i += every) {
      context.lineTo((i / (amounts.length - 1)) * width, height * (1 - (0.95 * amounts[i]) / most));
    }
    context.lineTo(width, height);
    context.fillStyle = getComputedStyle(strip).color;
    context.fill();
    context.fillStyle = getComputedStyle(strip).getPropertyValue("--removed");
    for (const { first, last } of this.alarms) {
      const [left, right] = [first, last].map((row) => (row / (amounts.length - 1)) * width);
      context.fillRect(left, height - 2 * devicePixelRatio, Math.max(right - left, 2), 2 * devicePixelRatio);
    }
  }
}
