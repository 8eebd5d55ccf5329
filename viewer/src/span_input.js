// SPDX-License-Identifier: MIT
import { h } from "./dom.js";

const STEPS = 200;

/** Two handles on one line: a span of `[low, high]`; `change` gets null while all of it is chosen. */
export function spanInput({ label, low, high, words, change }) {
  const at = (step) => low + (step / STEPS) * (high - low);
  const handle = (name, start) =>
    h("input", { type: "range", min: 0, max: STEPS, step: 1, value: start, "aria-label": `${label}, ${name}` });
  const from = handle("from", 0), to = handle("to", STEPS);
  const output = h("output", {}, "all");
  const bar = h("div", { class: "span-bar" });

  const show = () => {
    const all = +from.value === 0 && +to.value === STEPS;
    bar.style.setProperty("--from", `${(100 * from.value) / STEPS}%`);
    bar.style.setProperty("--to", `${(100 * to.value) / STEPS}%`);
    output.textContent = all ? "all" : `${words(at(+from.value))} – ${words(at(+to.value))}`;
    for (const input of [from, to]) input.setAttribute("aria-valuetext", words(at(+input.value)));
    return all;
  };
  const moved = (input) => {
    if (+from.value > +to.value) (input === from ? from : to).value = (input === from ? to : from).value;
    change(show() ? null : [+from.value === 0 ? -1e9 : at(+from.value), +to.value === STEPS ? 1e9 : at(+to.value)]);
  };
  for (const input of [from, to]) input.addEventListener("input", () => moved(input));
  show();
  return {
    element: h("div", { class: "field" }, h("div", { class: "field-head" }, h("span", {}, label), output), h("div", { class: "span" }, bar, from, to)),
    set(span) {
      const step = (x) => Math.round((STEPS * (Math.min(high, Math.max(low, x)) - low)) / (high - low));
      from.value = span ? step(span[0]) : 0;
      to.value = span ? step(span[1]) : STEPS;
      show();
    },
  };
}
