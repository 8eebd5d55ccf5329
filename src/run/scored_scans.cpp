// SPDX-License-Identifier: MIT
#include "run/scored_scans.hpp"

#include <fmt/format.h>

#include <utility>

#include "dynamic_filter/error.hpp"
#include "recording/scans.hpp"

namespace dynamic_filter::app {

namespace {

/// A ConfigError, because it is the pair of arguments that is wrong, and must not pass as a scan
/// that cannot be read.
void refuse_other_count(const io::Recording& recording, std::size_t i, std::size_t labels,
                        std::size_t points) {
    if (labels == points) return;
    throw ConfigError(
        fmt::format("scan {}: {} labels, but {} points; are they of another recording?",
                    io::stem(recording, i), labels, points));
}

}  // namespace

eval::LabelledScan labelled(const io::FullScan& full, const Eigen::Vector3d& origin,
                            const ScoredPart& part) {
    eval::LabelledScan scan{shifted_world(full, origin), full.truth, {}};
    for (std::size_t p = 0; p < full.points.size(); ++p) {
        const Eigen::Vector3d point = full.points[p].cast<double>();
        const double range = point.norm();
        const bool is_scored = is_measured(full.points[p]) && range >= part.min &&
                               range <= part.max && point.head<2>().norm() >= part.min_horizontal &&
                               (!part.box || part.box->contains(full.T_world_sensor * point));
        if (!is_scored) {
            scan.truth[p] = Label::unknown;
        } else if (part.unlabelled_is_static && scan.truth[p] == Label::unknown) {
            scan.truth[p] = Label::static_;
        }
    }
    return scan;
}

eval::ScanSource scan_source(const io::Recording& recording, const Eigen::Vector3d& origin,
                             std::function<std::optional<Labels>(std::size_t)> labels_of,
                             const ScoredPart& part) {
    return [&recording, origin, part,
            labels_of = std::move(labels_of)](std::size_t i) -> std::optional<eval::LabelledScan> {
        try {
            const io::FullScan full = recording.read(i);
            if (full.truth.empty()) return std::nullopt;
            eval::LabelledScan scan = labelled(full, origin, part);
            if (labels_of) {
                auto labels = labels_of(i);
                if (!labels) return std::nullopt;
                refuse_other_count(recording, i, labels->size(), scan.truth.size());
                scan.verdict = std::move(*labels);
            }
            return scan;
        } catch (const InputError&) {
            return std::nullopt;
        }
    };
}

}  // namespace dynamic_filter::app
