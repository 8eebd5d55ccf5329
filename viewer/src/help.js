// SPDX-License-Identifier: MIT
import { h } from "./dom.js";

const KEYS = [
  ["Space", "play, pause"],
  ["← →", "scan before, next scan"],
  ["Home End", "first, last scan"],
  ["0", "all in view"],
  ["T", "from above"],
  ["G", "the sensor in the middle"],
  ["F", "follow the sensor"],
  ["W A S D", "move the view"],
  ["Q E R V", "turn left, right, up, down"],
  ["+ −", "nearer, farther"],
  ["1 – 7", "colour by verdict, front-end verdict, error, height, intensity, probability, time"],
  ["Z X C", "static, removed, unknown points"],
  ["P", "points of the scan at the slider"],
  ["M", "mark what was corrected later"],
  ["N B", "next false removal, next missed point"],
  ["Enter", "explain the point in the middle of the view (when the picture has the focus)"],
  ["Esc", "forget the point, close"],
  ["J K U", "with serve --edit: mark what is chosen as static, dynamic, unknown"],
  ["Ctrl+Z Ctrl+Y", "with serve --edit: undo, redo"],
  ["L", "light, dark"],
  ["?", "these keys"],
];

const dialog = () => document.getElementById("help");

function build() {
  const element = h("dialog", { id: "help", "aria-labelledby": "help-title" },
    h("form", { method: "dialog" }, h("h2", { id: "help-title" }, "Keys"), h("button", { class: "quiet", autofocus: true }, "Close")),
    h("dl", {}, KEYS.map(([keys, words]) => h("div", {}, h("dt", {}, keys.split(" ").map((key) => (key === "–" ? " – " : h("kbd", {}, key)))), h("dd", {}, words)))),
    h("p", { class: "muted" }, "Mouse: drag turns, right drag (or Shift) moves, wheel zooms where the pointer is, click explains, double click centres. Fingers: one turns, two move and zoom."));
  document.body.append(element);
  return element;
}

export function openHelp() {
  const element = dialog() ?? build();
  if (!element.open) element.showModal();
}

export const helpIsOpen = () => Boolean(dialog()?.open);
