// SPDX-License-Identifier: MIT
#include "filter/surface_shift.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <cmath>
#include <limits>

namespace dynamic_filter {

namespace {

constexpr float kNearby = 0.25F;    // [m] points that show the plane around a point
constexpr int kFewestNearby = 4;    // points
constexpr float kThickness = 0.2F;  // largest ratio of the variances across and along a plane
constexpr float kOneRing = 0.08F;   // ratio of the variances below which points lie on a line
constexpr float kRising = 0.3F;     // largest vertical part of the direction of such a line
constexpr float kGrazing = 0.2F;    // least cosine between the normal of a surface and the view
constexpr float kFarthestPartner = 0.3F;  // [m]
constexpr std::size_t kFewestPartners = 8;
constexpr double kWithPartner = 0.3;   // least share of the points
constexpr double kUsualMisfit = 0.05;  // [m] larger ones count less and less
constexpr double kLeastFacing = 0.06;  // share of the surfaces that must face a direction
constexpr double kHeld = 0.01;         // directions that no surface faces stay as they are
constexpr int kSearches = 3;
constexpr double kFound = 0.005;  // [m] the search ends with a smaller step

std::optional<Point> normal_at(const Points& points, const Point& center) {
    Point sum = Point::Zero();
    Eigen::Matrix3f squares = Eigen::Matrix3f::Zero();
    int count = 0;
    for (const Point& p : points) {
        const Point d = p - center;
        if (d.squaredNorm() > kNearby * kNearby) continue;
        sum += d;
        squares += d * d.transpose();
        ++count;
    }
    if (count < kFewestNearby) return std::nullopt;
    const Point mean = sum / static_cast<float>(count);
    const Eigen::Matrix3f spread = squares / static_cast<float>(count) - mean * mean.transpose();
    Eigen::SelfAdjointEigenSolver<Eigen::Matrix3f> axes;
    axes.computeDirect(spread);
    const Eigen::Vector3f& variance = axes.eigenvalues();
    if (variance[1] < kOneRing * variance[2]) {
        const Point along = axes.eigenvectors().col(2);
        if (std::abs(along.z()) > kRising) return std::nullopt;
        return Point(along.y(), -along.x(), 0.0F).normalized();
    }
    if (variance[0] > kThickness * variance[1]) return std::nullopt;
    return Point(axes.eigenvectors().col(0));
}

Surface part_that_faces(const Surface& surface, const Point& from) {
    Surface part;
    for (std::size_t i = 0; i < surface.points.size(); ++i) {
        const Point view = (from - surface.points[i]).normalized();
        if (surface.normals[i].dot(view) < kGrazing) continue;
        part.points.push_back(surface.points[i]);
        part.normals.push_back(surface.normals[i]);
    }
    return part;
}

struct Partner {
    std::size_t index = 0;
    float squared = std::numeric_limits<float>::infinity();  // [m^2] infinite: there is none
};

Partner nearest_to(const Point& p, const Points& points) {
    Partner nearest;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const float squared = (points[i] - p).squaredNorm();
        if (squared < nearest.squared) nearest = {i, squared};
    }
    return nearest;
}

/// For each place of the surface, the nearest of the points to which it is the nearest place.
std::vector<Partner> partners_of(const Surface& surface, const Points& points) {
    std::vector<Partner> partners(surface.points.size());
    for (std::size_t i = 0; i < points.size(); ++i) {
        const Partner place = nearest_to(points[i], surface.points);
        if (place.squared > kFarthestPartner * kFarthestPartner) continue;
        Partner& partner = partners[place.index];
        if (place.squared < partner.squared) partner = {i, place.squared};
    }
    return partners;
}

/// Directions that too few surfaces face get no weight: there, noise would count as motion.
Eigen::Matrix2d only_faced(const Eigen::Matrix2d& weight) {
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> axes(weight);
    const Eigen::Vector2d facing =
        (axes.eigenvalues().array() < kLeastFacing).select(0.0, axes.eigenvalues());
    return axes.eigenvectors() * facing.asDiagonal() * axes.eigenvectors().transpose();
}

}  // namespace

Surface surface_of(const Points& points, const Point& from) {
    Surface surface;
    for (const Point& p : points) {
        const auto normal = normal_at(points, p);
        if (!normal) continue;
        surface.points.push_back(p);
        surface.normals.push_back(normal->dot(from - p) < 0.0F ? Point(-*normal) : *normal);
    }
    return surface;
}

std::optional<Shift> shift_to(const Surface& surface, const Points& points, const Point& from,
                              const Eigen::Vector2d& guess) {
    const Surface seen = part_that_faces(surface, from);
    Shift shift{.by = guess};
    for (int search = 0; search < kSearches; ++search) {
        Points back(points);
        const Eigen::Vector2f by = shift.by.cast<float>();
        for (Point& p : back) p.head<2>() -= by;
        const std::vector<Partner> partners = partners_of(seen, back);
        Eigen::Matrix2d facing = Eigen::Matrix2d::Zero(), equations = Eigen::Matrix2d::Zero();
        Eigen::Vector2d right = Eigen::Vector2d::Zero();
        std::size_t count = 0;
        for (std::size_t k = 0; k < partners.size(); ++k) {
            if (std::isinf(partners[k].squared)) continue;
            const Point d = back[partners[k].index] - seen.points[k];
            const auto off = static_cast<double>(seen.normals[k].dot(d));
            const double misfit = off / kUsualMisfit;
            const double weight = 1.0 / (1.0 + misfit * misfit);
            const Eigen::Vector2d across = seen.normals[k].head<2>().cast<double>();
            facing += across * across.transpose();
            equations += weight * across * across.transpose();
            right += weight * off * across;
            ++count;
        }
        const auto number = static_cast<double>(count);
        if (count < kFewestPartners || number < kWithPartner * static_cast<double>(points.size())) {
            return std::nullopt;
        }
        shift.support = equations / static_cast<double>(points.size());
        equations += kHeld * number * Eigen::Matrix2d::Identity();
        const Eigen::Vector2d step = equations.inverse() * right;
        shift.by += step;
        shift.weight = facing / number;
        if (step.norm() < kFound) break;
    }
    if ((shift.by - guess).norm() > static_cast<double>(kFarthestPartner)) return std::nullopt;
    shift.weight = only_faced(shift.weight);
    return shift;
}

}  // namespace dynamic_filter
