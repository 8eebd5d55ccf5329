// SPDX-License-Identifier: MIT
import { COLOURINGS, kindColour, scaleGradient } from "./colours.js";
import { h } from "./dom.js";
import { short } from "./format.js";

const KINDS = {
  verdict: [["static", "static"], ["dynamic", "removed"], ["unknown", "unknown"]],
  instant: [["static", "static at first"], ["dynamic", "removed at first"], ["unknown", "unknown at first"]],
  error: [
    ["falseRemoved", "false removal: static, but removed"], ["missed", "missed: moving, but kept"],
    ["rightDynamic", "rightly removed"], ["rightStatic", "rightly kept"], ["none", "no truth"],
  ],
};

const swatch = (theme, kind) => h("i", { class: "swatch", style: `background:${kindColour(theme, kind)}` });

function ends(id, { heights, duration }) {
  if (id === "height") return [`${short(heights[0])} m`, `${short(heights[1])} m`];
  if (id === "time") return ["0 s", `${short(duration)} s`];
  if (id === "probability") return ["0 moving", "1 static"];
  if (id === "scans") return ["few", "many"];
  if (id === "drives") return ["none", "all"];
  return ["weak", "strong"];
}

/** What the colours of the points mean now. */
export function legend({ colour, corrections }, theme, facts) {
  const { label, scale } = COLOURINGS.find(({ id }) => id === colour);
  const lines = (KINDS[colour] ?? []).map(([kind, words]) => h("li", {}, swatch(theme, kind), words));
  if (corrections) lines.push(h("li", {}, swatch(theme, "corrected"), "corrected later"));
  if (colour === "probability") lines.push(h("li", {}, swatch(theme, "none"), "no evidence"));
  return [
    h("h2", {}, label),
    scale && h("div", { class: "scale", style: `background:${scaleGradient(scale)}` }),
    scale && h("div", { class: "scale-ends" }, ...ends(colour, facts).map((text) => h("span", {}, text))),
    lines.length > 0 && h("ul", {}, lines),
  ].filter(Boolean);
}
