// SPDX-License-Identifier: MIT
// What a run knows of a voxel, for the words about a point.

/** What is known of a voxel; fields that the run does not keep are undefined. */
export function voxelFacts(run, voxel) {
  const { arrays } = run;
  const probability = arrays["voxel-probability"]?.[voxel];
  const known = probability !== undefined && probability !== 255;
  const facts = { probability: known ? probability / 254 : undefined };
  const counters = arrays["voxel-evidence"];
  if (counters) {
    const [occupied, free, owned, switches] = counters.subarray(4 * voxel, 4 * voxel + 4);
    const [weighed, expected, score] = arrays["voxel-score"].subarray(3 * voxel, 3 * voxel + 3);
    facts.evidence = { occupied, free, owned, switches, weighed, expected, score };
  }
  const span = arrays["voxel-span"];
  if (span) facts.span = [span[2 * voxel], span[2 * voxel + 1]];
  facts.passes = passesThrough(run, voxel);
  return facts;
}

/** Rows of the path whose scans saw through the voxel, in order; undefined where none is kept, as for static voxels. */
function passesThrough({ arrays, meta }, voxel) {
  const begin = arrays["pass-begin"];
  const pass = arrays.pass;
  if (!begin || !pass) return undefined;
  if (begin[voxel] === begin[voxel + 1]) return undefined;
  const rows = Array.from(pass.subarray(begin[voxel], begin[voxel + 1]), (k) => meta.keyframes[k]);
  return rows.sort((a, b) => a - b);
}
