// SPDX-License-Identifier: MIT
/// The ways of moving objects, in little memory.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <map>
#include <vector>

#include "objects/object_log.hpp"

namespace dynamic_filter::app {

/// An object over all its scans.
struct ObjectWay {
    /// Where it was in some of its scans, its first among them.
    struct Place {
        std::size_t scan = 0;
        Eigen::Vector3d center = Eigen::Vector3d::Zero();  ///< [m] in the world
        Eigen::Vector3d size = Eigen::Vector3d::Zero();    ///< [m] length, width, height
    };
    std::uint32_t object = 0;
    std::size_t first = 0, last = 0, nearest = 0;  ///< scans; the third has most of its points
    std::size_t points = 0;
    Eigen::Vector3d size = Eigen::Vector3d::Zero();  ///< [m] that nine tenths of `places` keep to
    double path = 0.0;                               ///< [m] as in ObjectSummary
    double fastest = 0.0;                            ///< [m/s]
    std::vector<Place> places{};                     ///< spread evenly over its scans
};

/// Collects the ways. Memory: up to 8 KB for each object.
class ObjectWays {
public:
    void add(const KnownScan& scan);
    /// Those with most points, at most so many, in the order of their numbers. Nothing is left.
    std::vector<ObjectWay> take(std::size_t most);

private:
    struct Growing {
        ObjectWay way{};
        std::size_t scans = 0, stride = 1;  // of the scans whose places are kept
        std::size_t most = 0;               // points in a scan
        WayLength length{};
    };
    std::map<std::uint32_t, Growing> growing_;
};

}  // namespace dynamic_filter::app
