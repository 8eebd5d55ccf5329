// SPDX-License-Identifier: MIT
// Steps from one wrong point to the next, if there is ground truth.
import { DYNAMIC, finalOf, STATIC, truthOf } from "./data.js";
import { h } from "./dom.js";
import { count } from "./format.js";

const CLOSE = 12;  // m, from where one sees what is around

const ERRORS = {
  removed: { label: "False removals", key: "N", is: (verdict) => truthOf(verdict) === STATIC && finalOf(verdict) === DYNAMIC },
  missed: { label: "Missed", key: "B", is: (verdict) => truthOf(verdict) === DYNAMIC && finalOf(verdict) !== DYNAMIC },
};

/** The view whose errors are gone through: that of the point chosen, or the first that has truth. */
function viewOf(session) {
  const owner = session.store.get("selection")?.owner;
  return owner?.run.meta.has_truth ? owner : session.views.find(({ run, clouds }) => run.meta.has_truth && clouds.map);
}

/** Chooses the next wrong point of the map and looks at it. */
export function goToNextError(session, kind) {
  const view = viewOf(session);
  if (!view) return;
  const { verdicts } = view.clouds.map;
  const { is } = ERRORS[kind];
  const chosen = session.store.get("selection");
  const from = chosen?.owner === view && chosen.source === "map" ? chosen.index + 1 : 0;
  let index = verdicts.findIndex((verdict, i) => i >= from && is(verdict));
  if (index < 0) index = verdicts.findIndex(is);
  if (index < 0) return;
  const point = view.point("map", index);
  session.store.set(kind === "removed" ? { dynamic: true } : { static: true, unknown: true });  // or it would not be seen
  session.select(point);
  session.orbit.set({ target: point.position.map((p, c) => p + view.view.offset[c]), distance: Math.min(session.orbit.distance, CLOSE) });
}

/** Buttons to go through the errors; null where there is no truth. */
export function errorButtons(session, runs) {
  const run = runs.find(({ meta }) => meta.has_truth);
  if (!run) return null;
  const buttons = Object.entries(ERRORS).map(([kind, { label, key, is }]) => {
    const n = run.arrays["map-verdict"].reduce((sum, verdict) => sum + (is(verdict) ? 1 : 0), 0);
    return h("button", { type: "button", title: `Key ${key}`, disabled: n === 0, onclick: () => goToNextError(session, kind) },
      label, runs.length === 1 ? h("small", {}, ` ${count(n)}`) : null);
  });
  return h("section", { class: "errors" }, h("h2", {}, "Next wrong point"), h("div", { class: "buttons" }, buttons));
}
