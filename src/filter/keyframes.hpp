// SPDX-License-Identifier: MIT
/// The scans that observe: which scans become keyframes, how far each keyframe looks, and which
/// of them observe a new voxel.
#pragma once

#include <deque>
#include <optional>
#include <vector>

#include "dynamic_filter/range_image.hpp"
#include "dynamic_filter/settings.hpp"
#include "dynamic_filter/types.hpp"
#include "filter/archive.hpp"
#include "filter/keyframe.hpp"
#include "geometry/beam_image.hpp"

namespace dynamic_filter {

/// A keyframe and its image.
struct Keyframe {
    BeamImage image;
    Eigen::Isometry3f T_sensor_map = Eigen::Isometry3f::Identity();
    float reach = 0.0F;       ///< [m] how far the keyframe looks
    std::size_t index = 0;    ///< Scan::index
    float thinned = 0.0F;     ///< [m] see thinning_of()
    std::uint32_t owner = 0;  ///< its number in the order of the scans, as in Evidence
};

/// Stores the newest keyframes of a drive. Each of several sensors has keyframes as if it were
/// alone. Single caller.
class Keyframes {
public:
    explicit Keyframes(const Config& config)
        : choice_(config.keyframe),
          config_(config.scans.observers),
          farthest_(static_cast<float>(config.scans.sight.farthest)),
          most_(static_cast<std::size_t>(config.scans.max_keyframes)) {}

    /// Adds the scan if it is a keyframe, and returns whether it is one. Its pose is relative to
    /// the map; `owner` is its number in the order of the scans.
    bool add(const Scan& scan, std::uint32_t owner = 0);

    /// The next scan is the first one of another drive, perhaps by another sensor. The keyframes so
    /// far are removed.
    void begin_drive();

    /// The keyframes that observe a new voxel, oldest first, and the number of keyframes for which
    /// each one stands. Keyframes close in time see nearly the same. So all of the newest keyframes
    /// are used; of those twice as old every second one, and so on.
    struct Asked {
        const Keyframe* keyframe;
        unsigned weight;
    };
    [[nodiscard]] std::vector<Asked> asked_by_new() const;

    [[nodiscard]] const std::deque<Keyframe>& kept() const { return kept_; }  ///< oldest first
    [[nodiscard]] std::size_t total() const {
        return total_;
    }  ///< including those that are no longer kept
    /// What is left of them after begin_drive().
    void archive(Archive& archive) { archive.value(total_); }
    /// Of the first sensor: measured on its first scan that has enough points; empty before it.
    [[nodiscard]] std::optional<BeamPattern> beams() const {
        return sensors_.empty() ? std::nullopt : sensors_.front().beams;
    }

private:
    [[nodiscard]] bool is_reliable(const BeamPattern& beams, const Scan& scan) const;

    KeyframeChoice choice_;
    ScansConfig::Observers config_;
    float farthest_;  // [m]
    std::size_t most_;
    struct Sensor {
        std::optional<BeamPattern> beams;
        float thinned = 0.0F;  // [m] measured with `beams`

        std::optional<double> last_far_look;  // [s]
    };
    std::vector<Sensor> sensors_;  // by Scan::sensor
    std::deque<Keyframe> kept_;
    std::size_t total_ = 0;
};

}  // namespace dynamic_filter
