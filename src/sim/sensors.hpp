// SPDX-License-Identifier: MIT
/// The table of LiDARs: which way the rays of a scan go, and how good a range is.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <vector>

namespace dynamic_filter::sim {

struct Sensor {
    std::string name;
    int beams = 0;             ///< 0: the rays follow a rosette (prisms) instead of turning beams
    double top_deg = 0.0;      ///< elevation of the first beam
    double bottom_deg = 0.0;   ///< elevation of the last beam; the rest are evenly spaced
    int columns = 0;           ///< azimuths in a turn; of a rosette: rays in a scan
    double max_range = 100.0;  ///< [m]
    double min_range = 0.4;    ///< [m]
    double sigma = 0.02;       ///< [m] standard deviation of a range
};

const std::vector<Sensor>& sensor_table();

/// Unit vectors in the sensor frame (x forward, y left, z up), column after column, top beam first.
/// A turning sensor starts each scan at another fraction of a column; a rosette never repeats.
std::vector<Eigen::Vector3f> ray_directions(const Sensor& sensor, std::uint64_t seed,
                                            std::size_t scan);

}  // namespace dynamic_filter::sim
