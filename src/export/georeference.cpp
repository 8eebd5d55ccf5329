// SPDX-License-Identifier: MIT
#include "export/georeference.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "base/plugin.hpp"
#include "base/text.hpp"
#include "dynamic_filter/error.hpp"
#include "export/places.hpp"

namespace dynamic_filter::app {

namespace {

constexpr PluginFile kPlugin{.option = "--crs",
                             .name = "libdynamicfilter_crs.so",
                             .package = "dynamicfilter-crs",
                             .to_build = "libproj-dev",
                             .to_load = "libproj25",
                             .version_of = crs::kVersion};

std::unique_ptr<CoordinateSystem> system_named(const std::string& name) {
    const Plugin plugin(kPlugin, DYNAMIC_FILTER_VERSION, false);
    const char* fault = nullptr;
    std::unique_ptr<CoordinateSystem> system(
        plugin.function<crs::Make>(crs::kMake)(name.c_str(), &fault));
    if (!system) throw ConfigError("--crs " + name + ": " + fault);
    return system;
}

/// Two numbers, and perhaps a height.
bool is_place(const std::vector<double>& values) {
    return values.size() == 2 || values.size() == 3;
}

/// Whether a place may be a latitude and a longitude.
bool are_degrees(const std::vector<double>& place) {
    return std::abs(place[0]) <= 90.0 && std::abs(place[1]) <= 180.0;
}

}  // namespace

GeoOrigin geo_origin(const std::string& text) {
    const std::vector<double> values = io::parse_reals(text);
    if (!is_place(values) || !are_degrees(values)) {
        throw ConfigError("--origin " + text +
                          ": expected LAT,LON or LAT,LON,HEIGHT in degrees and metres, for "
                          "instance 48.1374,11.5755,520");
    }
    return {values[0], values[1], values.size() == 3 ? values[2] : 0.0};
}

Eigen::Matrix4d earth_from_world(const GeoOrigin& origin) {
    constexpr double kEquator = 6378137.0, kFlattening = 1.0 / 298.257223563;  // WGS 84
    constexpr double kSquare = kFlattening * (2.0 - kFlattening);
    const double latitude = origin.latitude_deg * std::numbers::pi / 180.0;
    const double longitude = origin.longitude_deg * std::numbers::pi / 180.0;
    const double sin_lat = std::sin(latitude), cos_lat = std::cos(latitude);
    const double sin_lon = std::sin(longitude), cos_lon = std::cos(longitude);
    const double normal = kEquator / std::sqrt(1.0 - kSquare * sin_lat * sin_lat);
    Eigen::Matrix4d matrix = Eigen::Matrix4d::Identity();
    matrix.block<3, 1>(0, 0) << -sin_lon, cos_lon, 0.0;
    matrix.block<3, 1>(0, 1) << -sin_lat * cos_lon, -sin_lat * sin_lon, cos_lat;
    matrix.block<3, 1>(0, 2) << cos_lat * cos_lon, cos_lat * sin_lon, sin_lat;
    matrix.block<3, 1>(0, 3) << (normal + origin.height) * cos_lat * cos_lon,
        (normal + origin.height) * cos_lat * sin_lon,
        (normal * (1.0 - kSquare) + origin.height) * sin_lat;
    return matrix;
}

Georeference::Georeference(const std::string& crs, const std::string& origin)
    : name_(crs), origin_text_(origin), system_(system_named(crs)) {
    if (origin.empty()) return;
    const std::vector<double> values = io::parse_reals(origin);
    if (is_place(values) && !are_degrees(values)) {
        shift_ = {values[0], values[1], values.size() == 3 ? values[2] : 0.0};
    } else {
        origin_ = geo_origin(origin);
    }
}

std::vector<Eigen::Vector3d> Georeference::places(std::vector<Eigen::Vector3d> places) const {
    if (places.empty()) return places;
    if (origin_) {
        const Eigen::Affine3d earth(earth_from_world(*origin_));
        for (Eigen::Vector3d& place : places) place = earth * place;
        const std::string fault = system_->from_earth(places);
        if (!fault.empty()) throw ConfigError("--crs " + name_ + ": " + fault);
    } else {
        for (Eigen::Vector3d& place : places) place += shift_;
    }
    const auto finite = std::find_if(places.begin(), places.end(),
                                     [](const Eigen::Vector3d& p) { return p.allFinite(); });
    if (finite == places.end()) return places;
    if (const auto area = system_->area_if_outside(*finite)) {
        throw ConfigError(fmt::format(
            "--crs {}: is meant for {}, and the points lie far from there, at {:.0f}, {:.0f}{}",
            name_, *area, finite->x(), finite->y(),
            origin_text_.empty()
                ? "; --origin LAT,LON or EAST,NORTH says where the origin of the poses lies"
                : ""));
    }
    return places;
}

Eigen::Matrix3d Georeference::turn_at(const Eigen::Vector3d& place) const {
    constexpr double kStep = 10.0;  // [m] along which a coordinate system is straight
    std::vector<Eigen::Vector3d> ends{place};
    for (int axis = 0; axis < 3; ++axis) {
        ends.emplace_back(place + kStep * Eigen::Vector3d::Unit(axis));
    }
    ends = places(std::move(ends));
    Eigen::Matrix3d turn;
    for (int axis = 0; axis < 3; ++axis) turn.col(axis) = (ends[axis + 1] - ends[0]).normalized();
    return turn;
}

io::Cloud Georeference::cloud(const io::Cloud& in_world) const {
    const bool is_same = in_world.crs == system_->wkt() || in_world.crs == name_;
    if (!in_world.crs.empty() && (!is_same || !origin_text_.empty())) {
        throw ConfigError("--crs " + name_ +
                          ": the cloud names a coordinate system already, and coordinates are not "
                          "turned from one into another; `pdal translate IN OUT reprojection "
                          "--filters.reprojection.out_srs=" +
                          name_ + "` does that");
    }
    const std::vector<Eigen::Vector3d> there = places(places_of(in_world));
    io::Cloud cloud = without_records(in_world);
    cloud.crs = system_->wkt();
    cloud.fields.clear();
    cloud.point_bytes = 0;
    for (const io::Field& field : in_world.fields) {
        const bool is_coordinate = field.name == "x" || field.name == "y" || field.name == "z";
        io::add_field(cloud, field.name, is_coordinate ? io::FieldType::f64 : field.type,
                      field.count);
    }
    cloud.data.resize(there.size() * cloud.point_bytes);
    for (std::size_t f = 0; f < cloud.fields.size(); ++f) {
        const io::Field &from = in_world.fields[f], &to = cloud.fields[f];
        const bool is_coordinate = to.name == "x" || to.name == "y" || to.name == "z";
        const std::size_t bytes = to.count * io::size_of(to.type);
        for (std::size_t i = 0; i < there.size(); ++i) {
            const std::byte* const source =
                is_coordinate ? reinterpret_cast<const std::byte*>(&there[i][to.name[0] - 'x'])
                              : in_world.data.data() + i * in_world.point_bytes + from.offset;
            std::memcpy(cloud.data.data() + i * cloud.point_bytes + to.offset, source, bytes);
        }
    }
    return cloud;
}

}  // namespace dynamic_filter::app
