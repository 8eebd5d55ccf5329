// SPDX-License-Identifier: MIT
/// Where the world lies on the earth.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "dynamic_filter/cloud.hpp"
#include "export/crs/coordinate_system.hpp"

namespace dynamic_filter::app {

/// The world's origin, at which x points to the east and y to the north.
struct GeoOrigin {
    double latitude_deg = 0.0, longitude_deg = 0.0, height = 0.0;  ///< [m] above the ellipsoid
};

/// Reads "LAT,LON" or "LAT,LON,HEIGHT". Throws ConfigError.
GeoOrigin geo_origin(const std::string& text);

/// Earth-centred, earth-fixed coordinates (WGS 84) from those of the world, as a 4x4 matrix.
Eigen::Matrix4d earth_from_world(const GeoOrigin& origin);

/// The world's coordinates in a coordinate system of the earth.
class Georeference {
public:
    /// `crs`: its name, such as EPSG:32633. `origin` of the world: LAT,LON[,HEIGHT]; or its
    /// coordinates in `crs`, EAST,NORTH[,HEIGHT], which are then added; or empty, if the world has
    /// coordinates of `crs` already. Throws ConfigError if PROJ or its plug-in is missing, or if
    /// PROJ does not know the system.
    Georeference(const std::string& crs, const std::string& origin);

    /// Places of the world in the coordinate system. Throws ConfigError if they lie far outside the
    /// area that it is meant for.
    [[nodiscard]] std::vector<Eigen::Vector3d> places(std::vector<Eigen::Vector3d> places) const;
    /// How directions of the world are turned at this place of it: along the axes of the coordinate
    /// system, whose north is not that of the world. The same errors.
    [[nodiscard]] Eigen::Matrix3d turn_at(const Eigen::Vector3d& place) const;
    /// The cloud with x y z of 64 bits in the coordinate system, which it names. The same errors.
    [[nodiscard]] io::Cloud cloud(const io::Cloud& in_world) const;

private:
    std::string name_, origin_text_;
    std::unique_ptr<CoordinateSystem> system_;
    std::optional<GeoOrigin> origin_;
    Eigen::Vector3d shift_ = Eigen::Vector3d::Zero();
};

}  // namespace dynamic_filter::app
