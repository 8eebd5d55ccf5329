// SPDX-License-Identifier: MIT
#include "check/choose_poses.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <numbers>
#include <utility>

#include "check/pose_fit.hpp"
#include "check/pose_outliers.hpp"
#include "check/pose_screen.hpp"
#include "dynamic_filter/check.hpp"

namespace dynamic_filter::io {
namespace {

std::string centimetres(double metres) { return fmt::format("{:.1f} cm", 100.0 * metres); }

std::string blur_text(const MotionQuality& quality) {
    std::string text =
        fmt::format("scans blur by {} at the given poses and by {} at refined ones",
                    centimetres(quality.given.least()), centimetres(quality.found.least()));
    if (quality.errors.empty()) return text;
    const PoseError& last = quality.errors.back();
    return text + fmt::format(" (they are off by {} and {:.2f} deg over {} scans)",
                              centimetres(last.shift), last.turn * 180.0 / std::numbers::pi,
                              last.apart);
}

/// A set of poses that may be used.
struct Candidate {
    std::string name;
    PoseFit fit;
    TrackedScans tracked;  // empty: the given poses
};

std::vector<Pose> poses_of_scans(const TrackedScans& tracked) {
    std::vector<Pose> poses;
    for (const auto& t : tracked) poses.push_back(t ? t->T_world_sensor : Pose::Identity());
    return poses;
}

/// The given poses, but for those apart from their neighbours: odometry leads to these from the
/// pose before.
TrackedScans mended(const Recording& recording, TrackedScans followed,
                    const std::vector<std::size_t>& outliers) {
    const std::vector<Pose>& given = recording.info().T_world_sensor;
    Pose T_world_odometry = Pose::Identity();
    for (std::size_t i = 0; i < followed.size(); ++i) {
        if (!followed[i]) continue;
        Pose& pose = followed[i]->T_world_sensor;
        const bool is_apart = std::binary_search(outliers.begin(), outliers.end(), i);
        if (!is_apart) T_world_odometry = given[i] * pose.inverse();
        pose = T_world_odometry * pose;
    }
    return followed;
}

/// Names of the first poses.
std::string names_of(const Recording& recording, const std::vector<std::size_t>& scans) {
    constexpr std::size_t kMost = 3;
    std::vector<std::string> names;
    for (const std::size_t i : scans) {
        if (names.size() < kMost) names.push_back(stem(recording, i));
    }
    const std::size_t left = scans.size() - names.size();
    return fmt::format("{}{}", fmt::join(names, ", "),
                       left > 0 ? fmt::format(" and {} more", left) : "");
}

/// "given: 40, 20 % ..., blur 9.1 cm; refined: ...: the refined ones are used"
std::string evidence(const std::vector<Candidate>& candidates, const Candidate& best) {
    std::string text = "upright structures overlay";
    for (const Candidate& c : candidates) {
        text += fmt::format("{} at {} poses by {}", &c == candidates.data() ? "" : ";", c.name,
                            to_text(c.fit));
    }
    return text + fmt::format(": the {} ones are used", best.name);
}

}  // namespace

std::vector<std::size_t> scans_without_pose(const Recording& recording) {
    const std::vector<Pose>& poses = recording.info().T_world_sensor;
    std::vector<std::size_t> missing;
    for (std::size_t i = 0; i < poses.size(); ++i) {
        if (!poses[i].matrix().allFinite()) missing.push_back(i);
    }
    return missing;
}

std::string missing_text(const Recording& recording, std::size_t missing) {
    return fmt::format("{} of {} scans have no pose of their own", missing, recording.size());
}

std::string outliers_text(const Recording& recording) {
    const auto outliers = outliers_of(recording.info().T_world_sensor, recording.info().stamps);
    if (outliers.empty()) return "";
    return fmt::format("given poses lie apart from those before and after them: {}",
                       names_of(recording, outliers));
}

std::string doubt_about_poses(MotionLook& look) {
    const Recording& recording = look.recording();
    const std::size_t missing = scans_without_pose(recording).size();
    if (missing > 0) return missing_text(recording, missing);
    const std::string apart = outliers_text(recording);
    if (!apart.empty()) return apart;
    if (poses_are_exact(recording, look.config())) return "";
    const MotionQuality& quality = look.quality();
    return quality.has_bad_poses() ? blur_text(quality) : "";
}

PosesChoice choose_poses(const Recording& recording, const OdometryConfig& config, bool asked,
                         const std::function<bool()>& after) {
    const TrackedScans followed = follow(recording, config, after);
    PosesChoice choice;
    if (!recording.info().has_poses) {
        choice.tracked = bind_poses(recording, followed, false);
        return choice;
    }
    std::vector<Candidate> candidates;
    // The motion during scans is undone by all candidates alike.
    const FitScans scans = read_fit_scans(with_poses(recording, followed), config);
    const auto add = [&](const char* name, TrackedScans tracked) {
        const PoseFit fit = fit_of(scans, poses_of_scans(tracked), config);
        candidates.push_back({name, fit, std::move(tracked)});
    };
    const bool is_complete = scans_without_pose(recording).empty();
    const auto outliers = outliers_of(recording.info().T_world_sensor, recording.info().stamps);
    if (is_complete && outliers.empty()) {
        candidates.push_back({"given", fit_of(read_fit_scans(recording, config), config), {}});
    } else if (is_complete) {
        add("mended", mended(recording, followed, outliers));
    }
    add("refined", bind_poses(recording, followed, true));
    add("found", bind_poses(recording, followed, false));
    // The given poses know the long way, so others must be better to be used.
    std::size_t best = asked && is_complete ? 1 : 0;
    for (std::size_t k = best + 1; k < candidates.size(); ++k) {
        if (is_better(candidates[k].fit, candidates[best].fit)) best = k;
    }
    choice.notes.push_back(evidence(candidates, candidates[best]));
    choice.tracked = std::move(candidates[best].tracked);
    return choice;
}

}  // namespace dynamic_filter::io
