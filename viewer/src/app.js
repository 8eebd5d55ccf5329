// SPDX-License-Identifier: MIT
// The frame of the page: a head, the panel "View" on the left, the stage, the other panels on the right, a bar below.
import { h } from "./dom.js";
import { openHelp } from "./help.js";
import { currentTheme, toggleTheme, watchTheme } from "./theme.js";

const NARROW = matchMedia("(max-width: 860px)");

/** `panels`: [{id, label, element}], the first of them the one on the left. `help`: whether help.js has the keys of the page. */
export function frame({ title, subtitle, panels, timeline, help = true }) {
  const stage = h("main", { class: "stage", "aria-label": "Points" });
  const status = h("p", { class: "status", role: "status" });
  const app = document.getElementById("app");

  const tabs = panels.map(({ id, label }) =>
    h("button", { type: "button", role: "tab", id: `tab-${id}`, "aria-controls": `panel-${id}`, onclick: () => press(id) }, label));
  const bodies = panels.map(({ id, element }) =>
    h("div", { class: "panel", role: "tabpanel", id: `panel-${id}`, "aria-labelledby": `tab-${id}`, tabindex: 0 }, element));

  /** On a narrow page a second press puts the drawer away. */
  function press(id) {
    const again = NARROW.matches && app.dataset.panel === id && app.dataset.drawer === "open";
    if (again) app.dataset.drawer = "closed";
    else open(id);
  }
  function open(id) {
    app.dataset.panel = id;
    app.dataset.drawer = "open";
    panels.forEach((panel, i) => {
      tabs[i].setAttribute("aria-selected", panel.id === id);
      tabs[i].tabIndex = panel.id === id ? 0 : -1;
      bodies[i].classList.toggle("active", panel.id === id);
    });
    window.dispatchEvent(new Event("panelopen"));
  }

  const tabBar = h("div", { class: "tabs", role: "tablist", "aria-label": "Panels" }, tabs);
  tabBar.addEventListener("keydown", (event) => {
    const step = { ArrowRight: 1, ArrowLeft: -1 }[event.key];
    if (!step) return;
    event.stopPropagation();
    const shown = tabs.filter((tab) => tab.offsetParent !== null);
    const next = shown[(shown.indexOf(document.activeElement) + step + shown.length) % shown.length];
    next.focus();
    open(panels[tabs.indexOf(next)].id);
  });

  const themeButton = h("button", { type: "button", class: "quiet", title: "Key L", onclick: toggleTheme });
  watchTheme(() => (themeButton.textContent = currentTheme() === "dark" ? "Light" : "Dark"));

  app.replaceChildren(
    h("header", { class: "head" }, h("h1", {}, title), h("p", { class: "subtitle" }, subtitle), status,
      themeButton, help ? h("button", { type: "button", class: "quiet", title: "Key ?", onclick: openHelp }, "Keys") : null),
    h("aside", { class: "left", "aria-label": panels[0].label }, bodies[0]),
    stage, timeline, tabBar,
    h("aside", { class: "right", "aria-label": "Details" }, bodies.slice(1)));
  open(panels[1].id);
  if (NARROW.matches) app.dataset.drawer = "closed";
  return { stage, open, say: (text) => (status.textContent = text) };
}
