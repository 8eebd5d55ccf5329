// SPDX-License-Identifier: MIT
/// The keyframes that observe: which scans become one, how far each looks, and which of them a new
/// voxel asks.
#pragma once

#include <deque>
#include <optional>
#include <vector>

#include "dynamic_filter/config.hpp"
#include "dynamic_filter/geometry/beam_image.hpp"
#include "dynamic_filter/geometry/range_image.hpp"
#include "dynamic_filter/types.hpp"

namespace dynamic_filter {

/// A scan that observes.
struct Observer {
    BeamImage image;
    Eigen::Isometry3f T_sensor_map = Eigen::Isometry3f::Identity();
    float reach = 0.0F;     ///< [m] how far it looks
    std::size_t index = 0;  ///< Scan::index
};

/// The newest keyframes. Single caller.
class Observers {
public:
    explicit Observers(const Config& config)
        : keyframe_(config.keyframe),
          config_(config.scans.observers),
          farthest_(static_cast<float>(config.scans.sight.farthest)),
          most_(static_cast<std::size_t>(config.scans.max_keyframes)) {}

    /// Adds the scan if it is a keyframe; true if it is. Its pose is relative to the map.
    bool add(const Scan& scan);

    /// Whom a new voxel asks, oldest first, and for how many keyframes each stands. Keyframes close
    /// in time see much the same, so it asks the newest one by one, and of those that are twice as
    /// old every second, and so on.
    struct Asked {
        const Observer* observer;
        unsigned weight;
    };
    [[nodiscard]] std::vector<Asked> asked_by_new() const;

    [[nodiscard]] const std::deque<Observer>& kept() const { return kept_; }  ///< oldest first
    [[nodiscard]] std::size_t total() const { return total_; }  ///< with those no longer kept
    /// Read off the first scan that has enough points; empty before it.
    [[nodiscard]] const std::optional<BeamPattern>& beams() const { return beams_; }

private:
    [[nodiscard]] bool is_reliable(const BeamPattern& beams, const Scan& scan) const;

    KeyframeConfig keyframe_;
    ScansConfig::Observers config_;
    float farthest_;  // [m]
    std::size_t most_;
    std::optional<BeamPattern> beams_;
    std::optional<Scan> last_keyframe_;  // pose and stamp only
    double last_far_look_ = 0.0;         // [s]
    std::deque<Observer> kept_;
    std::size_t total_ = 0;
};

}  // namespace dynamic_filter
