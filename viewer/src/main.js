// SPDX-License-Identifier: MIT
import { startCity } from "./city.js";
import { runsInPage } from "./data.js";
import { h } from "./dom.js";
import { startLive } from "./live.js";
import { startReport } from "./report.js";
import "./style.css";
import "./panels.css";

function missing() {
  if (typeof DecompressionStream === "undefined") return "This browser cannot unpack the data (no DecompressionStream). Any of 2023 or newer can.";
  if (!document.createElement("canvas").getContext("webgl2")) return "This browser has no WebGL 2, so there is no picture. It may be switched off in its settings.";
  return null;
}

const say = (words) => document.getElementById("app").replaceChildren(h("p", { class: "boot", role: "alert" }, words));

function start() {
  const problem = missing();
  if (problem) {
    say(problem);
    return;
  }
  const runs = runsInPage();
  const cities = runs.filter(({ meta }) => meta.kind === "city");
  if (cities.length > 0 && runs.length > 1) say("The map of several drives cannot be shown beside other runs; open its own report.html.");
  else if (cities.length > 0) startCity(cities[0]);
  else if (runs.length > 0) startReport(runs);
  else if (location.protocol.startsWith("http")) startLive();
  else say("There are no data in this page, and no server behind it: it is a part of the command dynamicfilter, which fills it in.");
}

start();
