// SPDX-License-Identifier: MIT
#include "filter/displacement.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <utility>

#include "base/numbers.hpp"

namespace dynamic_filter {

namespace {

constexpr int kFewestShifts = 5;
constexpr double kShiftError = 0.02;    // [m] of one shift, at the least
constexpr double kLargestError = 0.1;   // [m] a way that is known worse tells nothing
constexpr double kSurely = 5.0;         // times its error
constexpr double kFasterThanAll = 3.0;  // times as fast as most objects
constexpr std::size_t kPointsOfFirst = 200, kPointsOfLater = 60;
constexpr int kMostUnlike = 1;
constexpr double kNoticed = 0.08;  // [m]
constexpr double kAsGood = 0.6;    // of the support

/// At most so many of the points, evenly chosen.
Points evenly(const Points& points, std::size_t most) {
    const std::size_t count = std::min(most, points.size());
    Points some;
    some.reserve(count);
    for (std::size_t i = 0; i < count; ++i) some.push_back(points[i * points.size() / count]);
    return some;
}

/// True if the points fit the surface at `rest` nearly as well as at `moved`. Only surfaces count
/// that face the direction in which the two differ.
bool may_rest(const Shift& rest, const Shift& moved) {
    const Eigen::Vector2d apart = moved.by - rest.by;
    return apart.dot(rest.support * apart) >= kAsGood * apart.dot(moved.support * apart);
}

/// Searches on from the last shift. The shadow of something that passes moves over an object and
/// may lead the search away with it, step by step; so if the object may also be where it was, it is
/// there.
std::optional<Shift> shift_since(const Surface& first, const Points& points, const Point& from,
                                 const Shift& last) {
    const auto shift = shift_to(first, points, from, last.by);
    if (!shift || shift->by.norm() < kNoticed) return shift;
    const auto rest = shift_to(first, points, from, Eigen::Vector2d::Zero());
    return rest && may_rest(*rest, *shift) ? rest : shift;
}

}  // namespace

void SteadyMotion::add(double seconds, const Shift& shift) {
    Eigen::Matrix<double, 4, 2> by_unknowns;
    by_unknowns << Eigen::Matrix2d::Identity(), seconds * Eigen::Matrix2d::Identity();
    const Eigen::Vector2d weighted = shift.weight * shift.by;
    equations_ += by_unknowns * shift.weight * by_unknowns.transpose();
    right_ += by_unknowns * weighted;
    squares_ += shift.by.dot(weighted);
    weight_ += shift.weight.trace();
    last_ = seconds;
    ++count_;
}

std::optional<SteadyWay> SteadyMotion::way() const {
    if (count_ < kFewestShifts || weight_ <= 0.0) return std::nullopt;
    constexpr double kTiny = 1e-6;  // for directions without weight
    const Eigen::Matrix4d inverse = (equations_ + kTiny * Eigen::Matrix4d::Identity()).inverse();
    const Eigen::Vector4d motion = inverse * right_;
    const double misfit = std::max(squares_ - motion.dot(right_), 0.0);
    const double left = weight_ * (1.0 - 2.0 / count_);  // two unknowns in each direction
    const double variance = std::max(misfit / left, kShiftError * kShiftError);
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> axes(
        Eigen::Matrix2d(inverse.bottomRightCorner<2, 2>()));
    std::optional<SteadyWay> surest;
    for (int i = 0; i < 2; ++i) {
        const double speed = std::abs(axes.eigenvectors().col(i).dot(motion.tail<2>()));
        const double error = last_ * std::sqrt(variance * std::max(axes.eigenvalues()[i], 0.0));
        if (error > kLargestError) continue;
        const SteadyWay way{.length = last_ * speed, .error = error, .speed = speed};
        if (!surest || way.length * surest->error > surest->length * way.error) surest = way;
    }
    return surest;
}

std::optional<SteadyWay> FollowedSurface::look(double stamp, const Point& from,
                                               const Points& points) {
    const auto shift =
        first_ ? shift_since(*first_, evenly(points, kPointsOfLater), from, shift_) : std::nullopt;
    if (!shift) {
        if (!first_ || ++unlike_ > kMostUnlike) begin(stamp, from, points);
        return std::nullopt;
    }
    unlike_ = 0;
    shift_ = *shift;
    motion_.add(stamp - since_, shift_);
    return motion_.way();
}

void FollowedSurface::begin(double stamp, const Point& from, const Points& points) {
    *this = {};
    first_ = surface_of(evenly(points, kPointsOfFirst), from);
    since_ = stamp;
}

std::vector<std::size_t> which_moved(std::span<const SteadyWay> ways, double least) {
    std::vector<double> speeds;
    for (const SteadyWay& way : ways) speeds.push_back(way.speed);
    const double usual = median(std::move(speeds));
    std::vector<std::size_t> moved;
    for (std::size_t i = 0; i < ways.size(); ++i) {
        const auto& [length, error, speed] = ways[i];
        const bool is_sure = length >= least && length >= kSurely * error;
        if (is_sure && speed >= kFasterThanAll * usual) moved.push_back(i);
    }
    return moved;
}

}  // namespace dynamic_filter
