// SPDX-License-Identifier: MIT
/// The whole pipeline, scan by scan (Fig. 2).
#pragma once

#include <optional>
#include <vector>

#include "dynamic_filter/back_end/back_end.hpp"
#include "dynamic_filter/config.hpp"
#include "dynamic_filter/front_end/front_end.hpp"
#include "dynamic_filter/pipeline/merge.hpp"
#include "dynamic_filter/stage_times.hpp"
#include "dynamic_filter/types.hpp"

namespace dynamic_filter {

/// Verdict on one scan, point by point.
struct Verdict {
    std::size_t index = 0;  ///< Scan::index
    Labels labels;
    std::vector<float>
        probability;  ///< occupancy 0..1 of the point's voxel; empty in instant verdicts
};

/// A voxel of the static local map.
struct StaticVoxel {
    Eigen::Vector3d center = Eigen::Vector3d::Zero();  ///< [m] world frame
    float probability = 0.0F;                          ///< n_occ / n_check
};

/// Usage: push() every scan, finish(), then verdict() of any scan. Single caller; verdict() alone
/// is const and may run in several threads. Same scans and config give the same bits for any number
/// of threads. Memory: one window of scans and the thinned submaps; scans are not kept.
class DynamicFilter {
public:
    /// Throws ConfigError.
    explicit DynamicFilter(const Config& config);

    /// Takes a scan, points in the sensor frame, stamps in order. When it opens a new window, the
    /// one before is processed and its scans' instant verdicts are returned; otherwise nothing.
    std::vector<Verdict> push(Scan scan);

    /// Processes the last window (its verdicts are returned) and merges the local maps of all
    /// submap poses. No push() after it.
    std::vector<Verdict> finish();

    /// The final verdict on a scan that was pushed, after finish(). Unknown where nothing can be
    /// said: not measured, or beyond the reach of a voxel's key.
    [[nodiscard]] Verdict verdict(const Scan& scan) const;

    /// The static local map at any pose (Sec. III-C), from the submaps closed so far. Empty before
    /// the first.
    std::vector<StaticVoxel> local_static_map(const Pose& T_world_query);

    [[nodiscard]] const StageTimes& times() const { return times_; }
    [[nodiscard]] const BackEnd& back_end() const { return back_end_; }
    [[nodiscard]] const FrontEnd& front_end() const { return front_end_; }

private:
    Pose to_map_frame(const Pose& T_world_sensor) const;
    std::vector<Verdict> process(const Window& window);
    [[nodiscard]] Label label_of(const Point& map_point, float& probability) const;

    Config config_;
    std::optional<Eigen::Vector3d> origin_;  // of the map frame, in the world
    WindowCutter cutter_;
    FrontEnd front_end_;
    BackEnd back_end_;
    MergedMap merged_;
    StageTimes times_;
};

}  // namespace dynamic_filter
