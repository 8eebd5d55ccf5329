// SPDX-License-Identifier: MIT
/// What the command and its plug-in for coordinate systems, which links PROJ, know of each other.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

namespace dynamic_filter::app {

/// A projected coordinate system of the earth: metres to the east, to the north, and upward.
class CoordinateSystem {
public:
    CoordinateSystem() = default;
    CoordinateSystem(const CoordinateSystem&) = delete;
    CoordinateSystem& operator=(const CoordinateSystem&) = delete;
    virtual ~CoordinateSystem() = default;

    /// Its description in OGC's Well Known Text of 2001, which LAS wants.
    [[nodiscard]] virtual std::string wkt() const = 0;
    /// Turns earth-centred coordinates (WGS 84, EPSG:4978) [m] into its own; places that are not
    /// finite stay so. Returns what went wrong; empty if nothing did.
    virtual std::string from_earth(std::vector<Eigen::Vector3d>& places) const = 0;
    /// Empty if the place, in its own coordinates, is within or near the area that it is meant for;
    /// otherwise a description of that area.
    [[nodiscard]] virtual std::optional<std::string> area_if_outside(
        const Eigen::Vector3d& place) const = 0;
};

namespace crs {

using Version = const char*();
/// The system of that name, such as EPSG:32633; the caller owns it. On a fault: nullptr, and a text
/// that stays valid until the next call.
using Make = CoordinateSystem*(const char* name, const char** fault);

constexpr const char* kVersion = "dynamicfilter_crs_version";  ///< name of that function
constexpr const char* kMake = "dynamicfilter_crs_make";        ///< name of that function

}  // namespace crs

}  // namespace dynamic_filter::app
