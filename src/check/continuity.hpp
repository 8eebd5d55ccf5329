// SPDX-License-Identifier: MIT
/// Whether each scan goes on where the one before it ended: a scan that was lost, cut off or put
/// into another order shows in itself and its neighbors only, which samples of a recording miss.
#pragma once

#include <cstddef>
#include <map>
#include <utility>
#include <vector>

#include "check/watch.hpp"
#include "dynamic_filter/recording.hpp"
#include "dynamic_filter/types.hpp"

namespace dynamic_filter::io {

/// What is kept of a scan to compare it with the next one.
struct ScanGist {
    std::size_t points = 0;  ///< that are measured
    Points upright;          ///< sensor frame; some points of upright structures
    Pose T_world_sensor = Pose::Identity();
};
ScanGist gist_of(const Points& points, const Pose& T_world_sensor);

/// Compares scans with those before them, in order; of several sensors, with those of their own.
/// Single caller.
class Continuity {
public:
    /// `sensors`: which sensor made each scan of the recording, or empty.
    explicit Continuity(std::vector<std::size_t> sensors = {}) : sensors_(std::move(sensors)) {}

    /// The next scan, and its index in the recording.
    void add(std::size_t scan, ScanGist gist);

    /// Scans that do not fit those before them although their poses say that the sensor hardly
    /// moved, and scans with far fewer points than those beside them.
    [[nodiscard]] std::vector<Alarm> breaks() const;

private:
    struct Step {
        std::size_t scan = 0, points = 0;
        double overlay = 0.0;  // with the scan before it, 0..1
        double way = 0.0;      // [m] from there
        bool is_comparable = false;
    };
    struct Series {  // of a sensor
        ScanGist last;
        std::vector<Step> steps;
    };
    [[nodiscard]] bool follows(std::size_t last, std::size_t scan) const;
    static void find_breaks(const std::vector<Step>& steps, std::vector<Alarm>& breaks);

    std::vector<std::size_t> sensors_;
    std::map<std::size_t, Series> series_;  // keys: sensors
};

/// The same for a recording, of which at most 1500 scans, in pieces of 50, are read.
std::vector<Alarm> breaks_in(const Recording& recording);

}  // namespace dynamic_filter::io
