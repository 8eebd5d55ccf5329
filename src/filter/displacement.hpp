// SPDX-License-Identifier: MIT
/// Which objects move slowly: the shifts of their surfaces over several seconds, and the steady
/// motion that explains these shifts.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "dynamic_filter/types.hpp"
#include "filter/surface_shift.hpp"

namespace dynamic_filter {

/// How far a steady motion has gone, in the direction in which it is surest.
struct SteadyWay {
    double length = 0.0;  ///< [m]
    double error = 0.0;   ///< [m] standard error, from how much the shifts scatter
    double speed = 0.0;   ///< [m/s]
};

/// Fits a steady motion to the shifts of a surface. It counts what grows with time, so the error of
/// the pose of the first view has no effect. Constant memory.
class SteadyMotion {
public:
    /// `seconds` since the first view of the surface.
    void add(double seconds, const Shift& shift);
    /// Empty if the shifts are too few or scatter too much.
    [[nodiscard]] std::optional<SteadyWay> way() const;

private:
    int count_ = 0;
    double last_ = 0.0;  // [s]
    // Normal equations for the place at the beginning and for the velocity.
    Eigen::Matrix4d equations_ = Eigen::Matrix4d::Zero();
    Eigen::Vector4d right_ = Eigen::Vector4d::Zero();
    double squares_ = 0.0;  // [m^2] weighted sum of the squares of the shifts
    double weight_ = 0.0;
};

/// An object that is compared with its first view again and again. Where that view can no longer be
/// compared, the present one takes its place.
class FollowedSurface {
public:
    /// The points of the object as a scan sees them from `from`, in the map frame.
    std::optional<SteadyWay> look(double stamp, const Point& from, const Points& points);

private:
    void begin(double stamp, const Point& from, const Points& points);
    std::optional<Surface> first_;  // view
    double since_ = 0.0;            // [s] stamp of the first view
    SteadyMotion motion_;
    Shift shift_;
    int unlike_ = 0;  // views in a row that could not be compared
};

/// Which of these objects of one scan have moved by `least` [m] or more. The way must be several
/// times its error, and several times as fast as most objects seem to be: if poses drift, all
/// objects seem to move.
std::vector<std::size_t> which_moved(std::span<const SteadyWay> ways, double least);

}  // namespace dynamic_filter
