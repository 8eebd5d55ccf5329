// SPDX-License-Identifier: MIT
/// The part of a recording or of a cloud that is wanted.
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "dynamic_filter/recording.hpp"
#include "geometry/kept.hpp"

namespace dynamic_filter::app {

using Box = Eigen::AlignedBox3d;

/// Two opposite corners [m], "X,Y,Z,X,Y,Z", or "X,Y,X,Y" for all heights; empty text: no box.
/// Throws ConfigError if it is neither.
std::optional<Box> box_of(const std::string& text);

struct Wanted {
    std::optional<Box> box{};                          ///< in the world
    double max_range = 0.0;                            ///< [m] from the sensor; 0: any
    Eigen::Vector3d sensor = Eigen::Vector3d::Zero();  ///< [m] in the frame of the scan
    std::optional<Kept> only{};                        ///< points that the verdict puts there
    bool keep_unknown = true;                          ///< as Config::map.keep_unknown, for `only`
    [[nodiscard]] bool takes_all() const { return !box && max_range == 0.0 && !only; }
};

/// The points of a scan that are wanted, by index. Points without a measurement are wanted only if
/// all are.
std::vector<std::uint32_t> wanted_points(const Wanted& part, const io::FullScan& scan,
                                         const Labels& labels);
/// The points of a cloud within the box.
std::vector<std::uint32_t> wanted_points(const Box& box, const io::Cloud& cloud);

/// The point of each cell of a grid that lies closest to its middle; points that are not finite are
/// left out.
struct ThinnedPart {
    io::Cloud cloud;
    std::size_t left_out = 0;
};
ThinnedPart thinned(const io::Cloud& cloud, double cell);

/// The scan with only those of its points.
io::FullScan part_of(const io::FullScan& scan, std::span<const std::uint32_t> points);
io::Cloud part_of(const io::Cloud& cloud, std::span<const std::uint32_t> points);

template <class T>
std::vector<T> part_of(const std::vector<T>& values, std::span<const std::uint32_t> points) {
    std::vector<T> part;
    if (values.empty()) return part;
    part.reserve(points.size());
    for (const std::uint32_t i : points) part.push_back(values[i]);
    return part;
}

}  // namespace dynamic_filter::app
