// SPDX-License-Identifier: MIT

const system = matchMedia("(prefers-color-scheme: light)");
const listeners = new Set();
let chosen = null;  // null: as the system has it

export const currentTheme = () => chosen ?? (system.matches ? "light" : "dark");

function tell() {
  document.documentElement.dataset.theme = currentTheme();
  for (const listener of listeners) listener(currentTheme());
}

export function watchTheme(listener) {
  listeners.add(listener);
  listener(currentTheme());
}

export function toggleTheme() {
  chosen = currentTheme() === "dark" ? "light" : "dark";
  tell();
}

system.addEventListener("change", tell);
document.documentElement.dataset.theme = currentTheme();
