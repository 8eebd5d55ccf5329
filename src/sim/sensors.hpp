// SPDX-License-Identifier: MIT
/// The table of LiDARs: directions of the rays of a scan, and range noise.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <vector>

namespace dynamic_filter::sim {

struct Sensor {
    std::string name;
    int beams = 0;             ///< 0: the rays follow a rosette (rotating prisms)
    double top_deg = 0.0;      ///< elevation of the first beam
    double bottom_deg = 0.0;   ///< elevation of the last beam; the rest are evenly spaced
    int columns = 0;           ///< azimuths per rotation; for a rosette: rays per scan
    double max_range = 100.0;  ///< [m]
    double min_range = 0.4;    ///< [m]
    double sigma = 0.02;       ///< [m] standard deviation of a range
};

const std::vector<Sensor>& sensor_table();

/// Unit vectors in the sensor frame (x forward, y left, z up), column by column, top beam first. A
/// rotating sensor starts each scan at a different fraction of a column; a rosette never repeats.
std::vector<Eigen::Vector3f> ray_directions(const Sensor& sensor, std::uint64_t seed,
                                            std::size_t scan);

}  // namespace dynamic_filter::sim
