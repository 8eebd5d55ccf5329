// SPDX-License-Identifier: MIT
import { COLOURINGS } from "./colours.js";
import { goToNextError } from "./errors.js";
import { helpIsOpen, openHelp } from "./help.js";
import { toggleTheme } from "./theme.js";

const TURN = Math.PI / 24, MOVE = 0.06, NEARER = 1.2;

/** What has keys of its own keeps them. */
function isTaken(event) {
  const { target, key } = event;
  if (event.ctrlKey || event.metaKey || event.altKey || helpIsOpen()) return true;
  if (target.matches("select, textarea, [type=text]")) return true;
  if (target.matches("[type=range]")) return /^(Arrow|Home|End|Page)/.test(key);
  return target.matches("button, [type=checkbox], summary") && (key === " " || key === "Enter");
}

/** `colourings`: ids that may be chosen; `timeline`: toggle(), step(), end(). */
export function bindKeys({ session, timeline, colourings, pickMiddle }) {
  const { store, orbit } = session;
  const flip = (name) => store.set({ [name]: !store.get(name) });
  const acts = {
    " ": () => timeline.toggle(),
    arrowleft: () => timeline.step(-1),
    arrowright: () => timeline.step(1),
    home: () => timeline.jump(0),
    end: () => timeline.jump(-1),
    0: () => session.fit(),
    t: () => session.top(),
    g: () => session.centreOnSensor(),
    f: () => flip("follow"),
    w: () => orbit.pan(0, -MOVE),
    s: () => orbit.pan(0, MOVE),
    a: () => orbit.pan(MOVE, 0),
    d: () => orbit.pan(-MOVE, 0),
    q: () => orbit.rotate(-TURN, 0),
    e: () => orbit.rotate(TURN, 0),
    r: () => orbit.rotate(0, TURN),
    v: () => orbit.rotate(0, -TURN),
    "+": () => orbit.zoom(NEARER),
    "=": () => orbit.zoom(NEARER),
    "-": () => orbit.zoom(1 / NEARER),
    z: () => flip("static"),
    x: () => flip("dynamic"),
    c: () => flip("unknown"),
    p: () => flip("scan"),
    m: () => flip("corrections"),
    n: () => goToNextError(session, "removed"),
    b: () => goToNextError(session, "missed"),
    l: toggleTheme,
    "?": openHelp,
    escape: () => session.select(null),
  };
  COLOURINGS.forEach(({ id }, i) => {
    acts[i + 1] = () => colourings.includes(id) && store.set({ colour: id });
  });
  window.addEventListener("keydown", (event) => {
    if (isTaken(event)) return;
    if (event.key === "Enter" && event.target.matches("canvas")) return pickMiddle(event.target);
    const act = acts[event.key.toLowerCase()];
    if (!act) return;
    event.preventDefault();
    act();
  });
}
