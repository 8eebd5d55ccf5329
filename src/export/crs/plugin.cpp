// SPDX-License-Identifier: MIT
#include <proj.h>

#include <cmath>
#include <memory>
#include <string_view>

#include "export/crs/coordinate_system.hpp"

namespace {

using dynamic_filter::app::CoordinateSystem;

struct Destroy {
    void operator()(PJ_CONTEXT* context) const { proj_context_destroy(context); }
    void operator()(PJ* object) const { proj_destroy(object); }
};
using Context = std::unique_ptr<PJ_CONTEXT, Destroy>;
using Object = std::unique_ptr<PJ, Destroy>;

/// From one system to another, longitude or east first. Null if PROJ knows no exact way.
Object way(PJ_CONTEXT* context, const PJ* from, const PJ* to) {
    const char* const exact[] = {"ALLOW_BALLPARK=NO", nullptr};
    const Object plain(proj_create_crs_to_crs_from_pj(context, from, to, nullptr, exact));
    return Object(plain ? proj_normalize_for_visualization(context, plain.get()) : nullptr);
}

class ProjSystem final : public CoordinateSystem {
public:
    ProjSystem(Context context, Object system)
        : context_(std::move(context)), system_(std::move(system)) {
        const Object earth(proj_create(context_.get(), "EPSG:4978"));
        const Object degrees(proj_create(context_.get(), "EPSG:4326"));
        from_earth_ = way(context_.get(), earth.get(), system_.get());
        to_degrees_ = way(context_.get(), system_.get(), degrees.get());
    }
    [[nodiscard]] bool is_reached() const { return from_earth_ && to_degrees_; }

    [[nodiscard]] std::string wkt() const override {
        const char* const in_one_line[] = {"MULTILINE=NO", nullptr};
        const char* const text =
            proj_as_wkt(context_.get(), system_.get(), PJ_WKT1_GDAL, in_one_line);
        return text == nullptr ? "" : text;
    }
    std::string from_earth(std::vector<Eigen::Vector3d>& places) const override {
        for (Eigen::Vector3d& place : places) {
            if (!place.allFinite()) continue;
            proj_errno_reset(from_earth_.get());
            const PJ_COORD there = proj_trans(from_earth_.get(), PJ_FWD,
                                              proj_coord(place.x(), place.y(), place.z(), 0.0));
            if (!std::isfinite(there.xyz.x)) {
                const char* const why =
                    proj_context_errno_string(context_.get(), proj_errno(from_earth_.get()));
                return why == nullptr ? "a point has no place in it" : why;
            }
            place = {there.xyz.x, there.xyz.y, there.xyz.z};
        }
        return "";
    }
    [[nodiscard]] std::optional<std::string> area_if_outside(
        const Eigen::Vector3d& place) const override {
        // Countries use one zone far beyond its borders. What lies around 0, 0 is more likely in no
        // system of the earth.
        constexpr double kNear = 1e5, kWide = 10.0;  // [m], [deg]
        const double margin = place.head<2>().norm() < kNear ? 0.0 : kWide;
        double west = 0.0, south = 0.0, east = 0.0, north = 0.0;
        const char* name = nullptr;
        const bool is_known = proj_get_area_of_use(context_.get(), system_.get(), &west, &south,
                                                   &east, &north, &name) != 0;
        if (!is_known || west > east) return std::nullopt;  // not known, or around 180 degrees
        const PJ_COORD at =
            proj_trans(to_degrees_.get(), PJ_FWD, proj_coord(place.x(), place.y(), place.z(), 0.0));
        const bool is_inside = at.lp.lam >= west - margin && at.lp.lam <= east + margin &&
                               at.lp.phi >= south - margin && at.lp.phi <= north + margin;
        if (is_inside) return std::nullopt;
        return name == nullptr ? "another part of the earth" : name;
    }

private:
    Context context_;
    Object system_, from_earth_, to_degrees_;
};

bool is_projected(PJ_CONTEXT* context, const PJ* system) {
    if (proj_get_type(system) != PJ_TYPE_COMPOUND_CRS) {
        return proj_get_type(system) == PJ_TYPE_PROJECTED_CRS;
    }
    const Object horizontal(proj_crs_get_sub_crs(context, system, 0));
    return horizontal && proj_get_type(horizontal.get()) == PJ_TYPE_PROJECTED_CRS;
}

/// East and north, in either order, in metres.
bool has_usual_axes(PJ_CONTEXT* context, const PJ* system) {
    const Object horizontal(proj_get_type(system) == PJ_TYPE_COMPOUND_CRS
                                ? proj_crs_get_sub_crs(context, system, 0)
                                : proj_clone(context, system));
    const Object axes(proj_crs_get_coordinate_system(context, horizontal.get()));
    if (!axes) return false;
    for (int axis = 0; axis < 2; ++axis) {
        double metres = 0.0;
        const char* direction = nullptr;
        proj_cs_get_axis_info(context, axes.get(), axis, nullptr, nullptr, &direction, &metres,
                              nullptr, nullptr, nullptr);
        const std::string_view towards = direction == nullptr ? "" : direction;
        if (metres != 1.0 || (towards != "east" && towards != "north")) return false;
    }
    return true;
}

}  // namespace

extern "C" const char* dynamicfilter_crs_version() { return DYNAMIC_FILTER_VERSION; }

extern "C" CoordinateSystem* dynamicfilter_crs_make(const char* name, const char** fault) {
    Context context(proj_context_create());
    proj_log_level(context.get(), PJ_LOG_NONE);
    if (Object database(proj_create(context.get(), "EPSG:4978")); !database) {
        *fault = "PROJ does not find its database proj.db; is the package proj-data installed?";
        return nullptr;
    }
    Object system(proj_create(context.get(), name));
    if (!system || proj_is_crs(system.get()) == 0) {
        *fault = "PROJ knows no such coordinate system; expected a name such as EPSG:32633";
        return nullptr;
    }
    if (!is_projected(context.get(), system.get())) {
        *fault =
            "is not a projected coordinate system; a map needs metres, not degrees, so choose one "
            "such as EPSG:32633 (UTM zone 33 north)";
        return nullptr;
    }
    if (!has_usual_axes(context.get(), system.get())) {
        *fault =
            "its coordinates are not metres to the east and to the north, as those of poses are; "
            "choose a metric one of the same region";
        return nullptr;
    }
    auto made = std::make_unique<ProjSystem>(std::move(context), std::move(system));
    if (made->wkt().empty()) {
        *fault = "PROJ has no WKT of 2001 for it, which LAS needs";
        return nullptr;
    }
    if (!made->is_reached()) {
        *fault =
            "PROJ knows no exact way from WGS 84 to it; `projsync` of the package proj-bin brings "
            "the grids that it may need";
        return nullptr;
    }
    return made.release();
}
