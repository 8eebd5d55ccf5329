// SPDX-License-Identifier: MIT
#include "filter/upright_planes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace dynamic_filter {

namespace {

constexpr int kAngles = 90;      // over half a circle
constexpr float kWidth = 0.2F;   // [m] of a bin
constexpr float kTaken = 0.25F;  // [m] points this near belong to the plane alone

/// Counts the points of every upright plane, by its direction and its distance from the middle.
class PlaneVotes {
public:
    explicit PlaneVotes(std::span<const Eigen::Vector2f> points) {
        for (int a = 0; a < kAngles; ++a) {
            const float angle = std::numbers::pi_v<float> * static_cast<float>(a) / kAngles;
            normals_[static_cast<std::size_t>(a)] = {std::cos(angle), std::sin(angle)};
        }
        float farthest = 0.0F;
        for (const auto& p : points) farthest = std::max(farthest, p.norm());
        bins_ = 2 * static_cast<int>(farthest / kWidth) + 3;
        votes_.assign(static_cast<std::size_t>(kAngles * bins_), 0);
        for (const auto& p : points) add(p, 1);
    }
    void add(const Eigen::Vector2f& p, int votes) {
        for (int a = 0; a < kAngles; ++a) {
            const float distance = normals_[static_cast<std::size_t>(a)].dot(p);
            const int bin = bins_ / 2 + static_cast<int>(std::lround(distance / kWidth));
            votes_[static_cast<std::size_t>(a * bins_ + bin)] += votes;
        }
    }
    /// The plane with the most points.
    [[nodiscard]] UprightPlane best() const {
        const auto at =
            static_cast<int>(std::max_element(votes_.begin(), votes_.end()) - votes_.begin());
        UprightPlane plane;
        plane.normal = normals_[static_cast<std::size_t>(at / bins_)];
        plane.offset = kWidth * static_cast<float>(at % bins_ - bins_ / 2);
        return plane;
    }

private:
    std::array<Eigen::Vector2f, kAngles> normals_;
    int bins_ = 0;
    std::vector<int> votes_;  // by angle and bin
};

/// Fits the plane to the points within `width` [m] of it, and returns their number.
int fit(UprightPlane& plane, std::span<const Eigen::Vector2f> points, float width) {
    Eigen::Vector2d sum = Eigen::Vector2d::Zero();
    Eigen::Matrix2d squares = Eigen::Matrix2d::Zero();
    int count = 0;
    for (const auto& p : points) {
        if (std::abs(plane.height(p)) > width) continue;
        const Eigen::Vector2d q = p.cast<double>();
        sum += q;
        squares += q * q.transpose();
        ++count;
    }
    if (count < 2) return count;
    const Eigen::Vector2d mean = sum / count;
    const Eigen::Matrix2d spread = squares / count - mean * mean.transpose();
    // The direction of the largest spread in closed form.
    const double angle = 0.5 * std::atan2(2.0 * spread(0, 1), spread(0, 0) - spread(1, 1));
    plane.normal = Eigen::Vector2d(-std::sin(angle), std::cos(angle)).cast<float>();
    plane.offset = plane.normal.dot(mean.cast<float>());
    return count;
}

}  // namespace

std::vector<UprightPlane> upright_planes(std::vector<Eigen::Vector2f> points, std::size_t most,
                                         int least_points) {
    std::vector<UprightPlane> planes;
    if (points.empty()) return planes;
    // Distances from the middle are small, so few bins are needed and the fit is exact.
    Eigen::Vector2d sum = Eigen::Vector2d::Zero();
    for (const auto& p : points) sum += p.cast<double>();
    const Eigen::Vector2f middle = (sum / static_cast<double>(points.size())).cast<float>();
    for (auto& p : points) p -= middle;
    PlaneVotes votes(points);
    while (planes.size() < most) {
        UprightPlane plane = votes.best();
        int count = 0;
        for (const float width : {0.4F, 0.25F, 0.15F, 0.15F}) count = fit(plane, points, width);
        const auto taken = std::partition(points.begin(), points.end(), [&](const auto& p) {
            return std::abs(plane.height(p)) > kTaken;
        });
        if (count < least_points || taken == points.end()) break;
        plane.from = plane.until = plane.along(*taken);
        for (auto p = taken; p != points.end(); ++p) {
            plane.from = std::min(plane.from, plane.along(*p));
            plane.until = std::max(plane.until, plane.along(*p));
            votes.add(*p, -1);
        }
        points.erase(taken, points.end());
        plane.from += plane.along(middle);
        plane.until += plane.along(middle);
        plane.offset += plane.normal.dot(middle);
        planes.push_back(plane);
    }
    return planes;
}

}  // namespace dynamic_filter
