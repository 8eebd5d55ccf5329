// SPDX-License-Identifier: MIT
import { runsInPage } from "./data.js";
import { h } from "./dom.js";
import { startReport } from "./report.js";
import "./style.css";
import "./panels.css";

function missing() {
  if (typeof DecompressionStream === "undefined") return "This browser cannot unpack the data (no DecompressionStream). Any of 2023 or newer can.";
  if (!document.createElement("canvas").getContext("webgl2")) return "This browser has no WebGL 2, so there is no picture. It may be switched off in its settings.";
  return null;
}

function start() {
  const problem = missing();
  if (problem) {
    document.getElementById("app").replaceChildren(h("p", { class: "boot", role: "alert" }, problem));
    return;
  }
  const runs = runsInPage();
  if (runs.length > 0) startReport(runs);
}

start();
