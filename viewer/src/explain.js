// SPDX-License-Identifier: MIT
// Why a point got its verdict, in words. No element is made here.
import { DYNAMIC, finalOf, hasTruth, instantOf, isCorrected, NO_VOXEL, NOT_RECORDED, STATIC, truthOf } from "./data.js";
import { count, fixed, plural, short } from "./format.js";

const VERDICTS = ["unknown", "static", "removed"];
export const verdictWord = (verdict) => VERDICTS[verdict] ?? "unknown";

function headline(verdict) {
  if (verdict === DYNAMIC) return "Removed: taken for something that moves";
  if (verdict === STATIC) return "Kept: taken for something that stays";
  return "Unknown: too little was seen here";
}

/** One sentence: what decided. */
function reason(verdict, { probability, evidence }, threshold) {
  if (probability === undefined) {
    return "Nobody looked through this place, and fewer than two scans saw it: there is nothing to judge by.";
  }
  const said = `the probability of being static is ${fixed(probability, 2)}`;
  if (verdict === DYNAMIC && probability >= threshold) {
    return `Its voxel is static (${said}), but it touches a removed one: there a point that stands out from the ground's plane is removed with the foot that stands on it.`;
  }
  if (verdict === STATIC && probability < threshold) {
    return `Its voxel is removed (${said}), but the point lies in the ground's plane where something stood on it, and stays.`;
  }
  if (!evidence && threshold === undefined) return `In its voxel ${said}.`;
  if (!evidence) return `In its voxel ${said}; from ${threshold} on a voxel is static.`;
  const seenThrough = evidence.free === 0 ? "No scan saw through this place" : `${plural(evidence.free, "scan")} saw through this place`;
  const { expected, score } = evidence;
  const than = `something static with these counts would be seen through about ${plural(Number(fixed(expected, 1)), "time")}`;
  const own = `${seenThrough}; ${than}.`;
  if (score > 0 === (verdict === DYNAMIC)) return own;
  return `${own} Its own counts alone would say ${score > 0 ? "removed" : "static"}; the voxels around it outvoted them.`;
}

function corrected(verdict, meta) {
  const first = instantOf(verdict);
  if (!meta.has_instant || first === NOT_RECORDED) return null;
  if (!isCorrected(verdict)) return { text: `The front-end said ${verdictWord(first)} at once.`, kind: "plain" };
  return { text: `Corrected: the front-end said ${verdictWord(first)} at first; later scans changed that.`, kind: "corrected" };
}

function judged(verdict, meta) {
  const truth = truthOf(verdict);
  if (!meta.has_truth || !hasTruth(verdict)) return null;
  const removed = finalOf(verdict) === DYNAMIC;
  if (truth === STATIC) {
    return removed ? { text: "False removal: the ground truth says it is static.", kind: "wrong" }
      : { text: "Right: the ground truth says it is static.", kind: "right" };
  }
  return removed ? { text: "Right: the ground truth says it moves.", kind: "right" }
    : { text: "Missed: the ground truth says it moves.", kind: "wrong" };
}

/** {title, verdict, reason, notes: [{text, kind}], counters: [[name, value, meaning]], score} */
export function explain(point, facts, meta, words) {
  const verdict = finalOf(point.verdict);
  const result = {
    title: headline(verdict), verdict, notes: [corrected(point.verdict, meta), judged(point.verdict, meta)].filter(Boolean), counters: [],
  };
  if (meta.live) {
    result.reason = "While a run is under way the page has its verdicts only. The report of the finished run says why.";
    return result;
  }
  if (point.voxel === NO_VOXEL || point.voxel === undefined) {
    result.reason = "It has no voxel: the run keeps none for it, or the place was forgotten beyond the horizon.";
    return result;
  }
  result.reason = reason(verdict, facts, meta.occupancy_threshold);
  if (facts.probability !== undefined) {
    result.counters.push(["probability", fixed(facts.probability, 2), meta.occupancy_threshold === undefined ? "of being static" : `of being static; from ${meta.occupancy_threshold} on it is kept`]);
  }
  const { evidence, span } = facts;
  if (!evidence) return result;
  result.score = evidence.score;
  result.counters.push(
    ["seen through", count(evidence.free), "n_free: scans whose beams passed the place"],
    ["weighed", short(evidence.weighed), "the same, with doubtful passes counted an eighth"],
    ["expected", short(evidence.expected), "weighed passes of a static voxel, by how often it was seen occupied and how often that changed"],
    ["seen occupied", count(evidence.occupied), "n_occ: scans that saw something there"],
    ["owned", count(evidence.owned), "scans with a point in the voxel"],
    ["switches", count(evidence.switches), "changes between occupied and free"],
    ["own score", fixed(result.score, 2), "below 0 it stays, above 0 something came or went: by the ratio of weighed and expected passes"],
  );
  if (span) result.counters.push(["occupied", `${words(span[0])} to ${words(span[1])}`, "first and last scan with a point in it"]);
  return result;
}
