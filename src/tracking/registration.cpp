// SPDX-License-Identifier: MIT
#include "tracking/registration.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

namespace dynamic_filter {
namespace {

constexpr double kSharpest = 0.08;  // [m] final reach
constexpr double kShrink = 0.6;     // factor of the reach per iteration
constexpr int kMostIterations = 20;
constexpr double kConverged = 1e-4;  // [m], [rad]
// Errors of neighboring points are similar, so the points carry less information than the same
// number of independent points.
constexpr double kIndependent = 0.1;
// Cosine of the angle between beam and normal at which a surface has half of its weight.
constexpr float kGrazing = 0.1F;

/// Weight 0..1 of a surface for a beam in direction of `p`. A single ring on a hedge or on a facade
/// with windows gives points on the cone of its beams, wherever the sensor is. Planes through such
/// points contain the beams, and would hold the sensor at its height and pitch.
double weight_of_incidence(const Point& p, const Point& normal) {
    const float along = normal.dot(p);
    const float square = along * along;
    return static_cast<double>(square / (square + kGrazing * kGrazing * p.squaredNorm()));
}

struct Sums {
    Information H = Information::Zero();
    Twist b = Twist::Zero();
    double inliers = 0.0;
    std::size_t mapped = 0;
};

Sums linearise(const SurfaceMap& map, const Points& points, const Pose& T, double reach) {
    const Eigen::Isometry3f T_map_sensor = T.cast<float>();
    const Eigen::Matrix3f back = T_map_sensor.linear().transpose();
    Sums sums;
    for (const Point& p : points) {
        const Point q = T_map_sensor * p;
        const Surface* surface = map.at(q);
        if (!surface) continue;
        ++sums.mapped;
        const auto residual = static_cast<double>(surface->normal.dot(q - surface->point));
        const auto variance = static_cast<double>(surface->variance_at(q));
        const double scale = std::max(reach * reach, 9.0 * variance);
        const double share = scale / (scale + residual * residual);
        const double inlier = share * share;
        sums.inliers += inlier;
        const Point normal = back * surface->normal;
        Twist J;
        J << normal.cast<double>(), p.cross(normal).cast<double>();
        const double weight = kIndependent * inlier * weight_of_incidence(p, normal) / variance;
        sums.H.selfadjointView<Eigen::Lower>().rankUpdate(J, weight);
        sums.b -= weight * residual * J;
    }
    sums.H = sums.H.selfadjointView<Eigen::Lower>();
    return sums;
}

}  // namespace

double blur_on_map(const SurfaceMap& map, const Points& points, const Pose& T_map_sensor) {
    constexpr double kNowhere = 0.5;  // [m] value of points where the map has no surface
    if (points.empty()) return kNowhere;
    const Eigen::Isometry3f T = T_map_sensor.cast<float>();
    double sum = 0.0;
    for (const Point& p : points) {
        const Point q = T * p;
        const Surface* surface = map.at(q);
        double square = kNowhere * kNowhere;
        if (surface != nullptr) {
            const auto off = static_cast<double>(surface->normal.dot(q - surface->point));
            square = std::min(square, static_cast<double>(surface->variance_at(q)) + off * off);
        }
        sum += std::log(square);
    }
    return std::exp(0.5 * sum / static_cast<double>(points.size()));
}

Registration register_points(const SurfaceMap& map, const Points& points, const Pose& start,
                             const PosePrior& prior, double reach) {
    Registration result;
    result.T_map_sensor = start;
    if (points.empty()) return result;
    for (int i = 0; i < kMostIterations; ++i) {
        const Sums sums = linearise(map, points, result.T_map_sensor, reach);
        const auto count = static_cast<double>(points.size());
        result.inliers = sums.inliers / count;
        result.mapped = static_cast<double>(sums.mapped) / count;
        result.information = sums.H;
        const Twist off = log(prior.T_map_sensor.inverse() * result.T_map_sensor);
        Information H = sums.H + prior.information;
        H.diagonal().array() += 1e-6;  // for directions without any information
        const Twist step = H.ldlt().solve(sums.b - prior.information * off);
        result.T_map_sensor = result.T_map_sensor * exp(step);
        if (reach <= kSharpest && step.norm() < kConverged) break;
        reach = std::max(kSharpest, kShrink * reach);
    }
    const Eigen::Quaterniond rotation(result.T_map_sensor.linear());
    result.T_map_sensor.linear() = rotation.normalized().toRotationMatrix();
    return result;
}

}  // namespace dynamic_filter
