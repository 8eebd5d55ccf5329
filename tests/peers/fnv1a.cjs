// SPDX-License-Identifier: MIT
"use strict";

/// The sum that sample.hpp prints of the same numbers.
module.exports = function fnv1a(values) {
  const bytes = new Uint8Array(Float64Array.from(values).buffer);
  let hash = 0x811c9dc5;
  for (const byte of bytes) hash = Math.imul(hash ^ byte, 0x01000193) >>> 0;
  return hash.toString(16).padStart(8, "0");
};
