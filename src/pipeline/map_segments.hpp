// SPDX-License-Identifier: MIT
/// The maps of one trajectory: a new one begins where it breaks. Single-threaded; its owner holds a
/// lock. Which scan breaks the trajectory, pose_jump.hpp and scan_queue.hpp tell.
#pragma once

#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "dynamic_filter/pipeline/dynamic_filter.hpp"
#include "dynamic_filter/pipeline/online_filter.hpp"

namespace dynamic_filter {

class MapSegments {
public:
    /// Throws ConfigError.
    MapSegments(const Config& config, const OnlineOptions& options);

    /// The map that the next scan goes to.
    [[nodiscard]] DynamicFilter& newest() { return *segments_.back().filter; }
    /// Ends the newest map, and begins one with the scan of this index. Returns instant verdicts
    /// that were still due.
    std::vector<Verdict> begin(std::size_t first_index);
    /// Decides the voxels of the newest map; returns instant verdicts that were still due.
    std::vector<Verdict> finish() { return newest().finish(); }

    /// Keeps a scan of the newest map until it is settled.
    void keep_unsettled(Scan scan) { unsettled_.push_back(std::move(scan)); }
    /// The verdict on the oldest scan kept, which is given up, if more than `left` are.
    std::optional<Verdict> settle_oldest(std::size_t left);

    /// Cuts the newest map to the horizon around the sensor, if it is time.
    void forget_far(const Pose& T_world_sensor);

    // Of the map that the scan went to; of maps no longer kept all is unknown.
    [[nodiscard]] Verdict verdict(const Scan& scan) const;
    [[nodiscard]] Verdict settled(const Scan& scan) const;
    /// See OnlineFilter.
    [[nodiscard]] std::vector<std::uint64_t> places_of(const Scan& scan) const;
    [[nodiscard]] std::vector<VoxelHistory> histories(std::span<const std::uint64_t> places) const;

    // Of all maps kept.
    [[nodiscard]] std::vector<StaticVoxel> static_map() const;
    [[nodiscard]] StageTimes times() const;
    [[nodiscard]] MapContents contents() const;
    [[nodiscard]] std::size_t size() const { return segments_.size(); }

private:
    struct Segment {
        std::size_t first_index;  ///< Scan::index of the first scan in it
        std::unique_ptr<DynamicFilter> filter;
    };
    void add(std::size_t first_index);
    [[nodiscard]] std::optional<std::size_t> segment_of(const Scan& scan) const;

    Config config_;
    double horizon_;    // [m]; 0: none
    std::size_t most_;  // of what DynamicFilter::size() counts
    std::vector<Segment> segments_;
    std::deque<Scan> unsettled_;
    std::optional<Eigen::Vector3d> forgot_at_;  // where the newest map was cut last
};

}  // namespace dynamic_filter
