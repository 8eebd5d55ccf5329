// SPDX-License-Identifier: MIT
/// The maps of one trajectory: a new map begins at each break of the trajectory. Single-threaded:
/// the owner holds a lock. pose_jump.hpp and scan_queue.hpp detect the breaks.
#pragma once

#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "dynamic_filter/filter.hpp"
#include "dynamic_filter/online.hpp"

namespace dynamic_filter {

class MapSegments {
public:
    /// Throws ConfigError.
    MapSegments(const Config& config, const OnlineOptions& options);

    /// The map into which the next scan goes.
    [[nodiscard]] DynamicFilter& newest() { return *segments_.back().filter; }
    /// Ends the newest map, and begins a new one with the scan of this index. Returns the instant
    /// verdicts that were not returned before.
    std::vector<Verdict> begin(std::size_t first_index);
    /// Decides the voxels of the newest map. Returns the instant verdicts that were not returned
    /// before.
    std::vector<Verdict> finish() { return newest().finish(); }

    /// Stores a scan of the newest map until it is settled.
    void keep_unsettled(Scan scan) { unsettled_.push_back(std::move(scan)); }
    /// If more than `left` scans are stored: returns the verdict on the oldest one and removes that
    /// scan.
    std::optional<Verdict> settle_oldest(std::size_t left);

    /// Removes the parts of the newest map beyond the horizon, if the sensor has moved far enough.
    void forget_far(const Pose& T_world_sensor);

    // Verdict from the map into which the scan went. All points are unknown if that map was
    // removed.
    [[nodiscard]] Verdict verdict(const Scan& scan) const;
    [[nodiscard]] Verdict settled(const Scan& scan) const;
    /// See OnlineFilter.
    [[nodiscard]] std::vector<std::uint64_t> places_of(const Scan& scan) const;
    [[nodiscard]] std::vector<VoxelHistory> histories(std::span<const std::uint64_t> places) const;

    // From all maps that are kept.
    [[nodiscard]] std::vector<StaticVoxel> static_map() const;
    [[nodiscard]] StageTimes times() const;
    [[nodiscard]] MapContents contents() const;
    [[nodiscard]] std::size_t size() const { return segments_.size(); }

private:
    struct Segment {
        std::size_t first_index;  ///< Scan::index of the first scan of the map
        std::unique_ptr<DynamicFilter> filter;
    };
    void add(std::size_t first_index);
    [[nodiscard]] std::optional<std::size_t> segment_of(const Scan& scan) const;

    Config config_;
    double horizon_;    // [m]; 0: no limit
    std::size_t most_;  // limit on DynamicFilter::size()
    std::vector<Segment> segments_;
    std::deque<Scan> unsettled_;
    // Where the sensor was when the newest map was last cut.
    std::optional<Eigen::Vector3d> forgot_at_;
};

}  // namespace dynamic_filter
