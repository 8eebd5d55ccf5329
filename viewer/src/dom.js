// SPDX-License-Identifier: MIT

/** Makes an element: h("button", {class: "quiet", onclick: stop}, "Stop"). */
export function h(tag, props = {}, ...children) {
  const element = document.createElement(tag);
  for (const [name, value] of Object.entries(props)) {
    if (value === undefined || value === null || value === false) continue;
    if (name.startsWith("on")) element.addEventListener(name.slice(2), value);
    else if (name === "value") element.value = value;
    else element.setAttribute(name, value === true ? "" : value);
  }
  element.append(...children.flat().filter((child) => child !== null && child !== undefined));
  return element;
}

/** Calls `act` once after calls have ceased for `ms`. */
export function debounce(act, ms) {
  let timer = 0;
  return (...args) => {
    clearTimeout(timer);
    timer = setTimeout(act, ms, ...args);
  };
}

/** A checkbox with its label: {element, input}. */
export function checkbox(label, checked, onchange, hint) {
  const input = h("input", { type: "checkbox", onchange: () => onchange(input.checked) });
  input.checked = checked;
  return { element: h("label", { class: "check", title: hint }, input, h("span", {}, label)), input };
}
