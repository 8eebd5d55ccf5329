// SPDX-License-Identifier: MIT
// The arithmetic of include/dynamic_filter/scans_observe/evidence.hpp, for the words about a point.

/** How often one expects a static voxel with these counts to be seen through. */
export function expectedPasses(evidence) {
  const { occupied, owned, switches } = scaled(evidence);
  return expected(occupied, owned, switches) / scaleOf(evidence);
}

/** More observations than this tell no more than so many in the same proportions. */
const ENOUGH = 128;
const scaleOf = ({ occupied, free }) => Math.min(1, ENOUGH / Math.max(1, occupied + free));
function scaled(evidence) {
  const scale = scaleOf(evidence);
  return Object.fromEntries(Object.entries(evidence).map(([name, count]) => [name, scale * count]));
}
const expected = (occupied, owned, switches) => 0.45 * (1 + switches) ** 0.9 * (Math.max(1, occupied) * Math.max(1, owned) ** 2) ** 0.2;

/** -1..1: whether the voxel was empty most of the time; below 0: no. */
export function dynamicScore(evidence) {
  const { occupied, free, owned, switches } = scaled(evidence);
  const f = free + 2;
  const e = expected(occupied, owned, switches) + 2;
  return (f * f - e * e) / (f * f + e * e);
}

/** What is known of a voxel; fields that the run does not keep are undefined. */
export function voxelFacts(run, voxel) {
  const { arrays } = run;
  const probability = arrays["voxel-probability"]?.[voxel];
  const known = probability !== undefined && probability !== 255;
  const facts = { probability: known ? probability / 254 : undefined };
  const counters = arrays["voxel-evidence"];
  if (counters) {
    const [occupied, free, owned, switches] = counters.subarray(4 * voxel, 4 * voxel + 4);
    facts.evidence = { occupied, free, owned, switches };
  }
  const span = arrays["voxel-span"];
  if (span) facts.span = [span[2 * voxel], span[2 * voxel + 1]];
  facts.passes = passesThrough(run, voxel);
  return facts;
}

/** Rows of the path whose scans saw through the voxel, in order. */
function passesThrough({ arrays, meta }, voxel) {
  const begin = arrays["pass-begin"];
  const pass = arrays.pass;
  if (!begin || !pass) return undefined;
  const rows = Array.from(pass.subarray(begin[voxel], begin[voxel + 1]), (k) => meta.keyframes[k]);
  return rows.sort((a, b) => a - b);
}
