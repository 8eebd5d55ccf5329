// SPDX-License-Identifier: MIT

const grouped = new Intl.NumberFormat("en-GB");

export const count = (n) => grouped.format(n);
export const plural = (n, word, words = `${word}s`) => `${count(n)} ${n === 1 ? word : words}`;
export const percent = (share, digits = 2) => (Number.isFinite(share) ? (100 * share).toFixed(digits) : "–");
export const fixed = (x, digits) => (Number.isFinite(x) ? x.toFixed(digits) : "–");

/** Three significant digits without an exponent: 0.0123, 1.23, 123. */
export function short(x) {
  if (!Number.isFinite(x)) return "–";
  const size = Math.abs(x);
  if (size >= 100 || size === 0) return count(Math.round(x));
  return x.toFixed(size >= 10 ? 1 : size >= 1 ? 2 : size >= 0.1 ? 3 : 4);
}

const compacted = new Intl.NumberFormat("en-GB", { notation: "compact" });
export const compact = (n) => compacted.format(n);

export const metres = (x) => (Math.abs(x) < 1 ? `${count(Math.round(x * 100))} cm` : `${short(x)} m`);
export const seconds = (x) => `${fixed(x, x < 1000 ? 2 : 1)} s`;

export function bytes(n) {
  if (!Number.isFinite(n)) return "–";
  return n >= 2 ** 30 ? `${fixed(n / 2 ** 30, 2)} GiB` : `${fixed(n / 2 ** 20, 0)} MiB`;
}
