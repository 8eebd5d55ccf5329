// SPDX-License-Identifier: MIT
#include "tracking/surface_map.hpp"

#include <gtest/gtest.h>

#include <array>
#include <limits>
#include <map>
#include <optional>

#include "support/random.hpp"
#include "support/reference_axes.hpp"

namespace dynamic_filter {
namespace surface_map_test {

/// A plane through all points of a voxel, in double precision and two passes.
struct Plane {
    Eigen::Vector3d point, normal, axis_1, axis_2;
    double variance = 0.0, spread_1 = 0.0, spread_2 = 0.0, count = 0.0;

    explicit Plane(const Points& points) : count(static_cast<double>(points.size())) {
        const auto axes = test::reference_axes(points);
        point = Eigen::Vector3d::Zero();
        for (const Point& p : points) point += p.cast<double>() / count;
        normal = axes.eigenvectors().col(0);
        axis_1 = axes.eigenvectors().col(1);
        axis_2 = axes.eigenvectors().col(2);
        spread_1 = axes.eigenvalues()[1];
        spread_2 = axes.eigenvalues()[2];
        variance = std::max(0.0, axes.eigenvalues()[0]) * count / (count - 3.0) + 1e-4;
    }
    [[nodiscard]] double variance_at(const Point& place) const {
        const Eigen::Vector3d d = place.cast<double>() - point;
        const double a = axis_1.dot(d), b = axis_2.dot(d);
        return variance * (1.0 + (1.0 + a * a / spread_1 + b * b / spread_2) / (0.1 * count));
    }
    [[nodiscard]] double off(const Point& place) const {
        return std::abs(normal.dot(place.cast<double>() - point));
    }
};

double off(const Surface& s, const Point& place) {
    return static_cast<double>(std::abs(s.normal.dot(place - s.point)));
}

/// Keeps all points.
class BruteMap {
public:
    explicit BruteMap(double finest) : finest_(finest) {}
    void insert(const Points& points) {
        for (std::size_t l = 0; l < SurfaceMap::kLevels; ++l) {
            for (const Point& p : points) {
                if (const auto cell = cell_of(p, 1.0F / size(l))) {
                    voxels_[l][pack(*cell)].push_back(p);
                }
            }
        }
    }
    [[nodiscard]] float size(std::size_t level) const {
        return static_cast<float>(finest_ * static_cast<double>(1U << level));
    }
    /// The points of the voxel around a place.
    [[nodiscard]] const Points* around(const Point& place, std::size_t level) const {
        const auto it = voxels_[level].find(pack(*cell_of(place, 1.0F / size(level))));
        return it == voxels_[level].end() ? nullptr : &it->second;
    }
    /// The plane that is known best, and whether rounding decides which, or whether there is any.
    struct Found {
        std::optional<Plane> best;
        bool close = false;
    };
    [[nodiscard]] Found at(const Point& place) const {
        Found found;
        double least = 0.25;
        for (std::size_t l = 0; l < SurfaceMap::kLevels; ++l) {
            const Points* points = around(place, l);
            if (points == nullptr || points->size() < 5) continue;
            const Plane plane(*points);
            const double flat = plane.spread_1 / std::pow(0.12 * static_cast<double>(size(l)), 2);
            found.close |= std::abs(flat - 1.0) < 0.01;
            if (flat < 1.0) continue;
            const double variance = plane.variance_at(place);
            found.close |= std::abs(variance / least - 1.0) < 0.02;
            if (variance >= least) continue;
            least = variance;
            found.best = plane;
        }
        return found;
    }

private:
    double finest_;
    std::array<std::map<VoxelKey, Points>, SurfaceMap::kLevels> voxels_;
};

/// Walls, a floor and a bush about `middle`.
Points scenery(test::Random& random, std::size_t count, const Point& middle) {
    Points points;
    for (std::size_t i = 0; i < count; ++i) {
        Point p = random.point(6.0);
        if (i % 4 == 0) p.z() = -1.7F + random.uniform_f(-0.02, 0.02);
        if (i % 4 == 1) p.y() = 4.1F + 0.3F * p.x() + random.uniform_f(-0.05, 0.05);
        if (i % 4 == 2) p.x() = -3.3F + random.uniform_f(-0.005, 0.005);
        if (i % 4 == 3) p = 0.2F * p + Point(1.0F, 1.0F, 0.0F);
        points.push_back(middle + p);
    }
    return points;
}

TEST(SurfaceMap, FitsPlanesAsBruteForceDoes) {
    test::Random random(1);
    for (const Point& middle : {Point(0, 0, 0), Point(-200, 300, -5)}) {
        for (const double finest : {0.4, 0.5}) {
            const Points points = scenery(random, 6000, middle);
            SurfaceMap map(finest);
            BruteMap brute(finest);
            map.insert(points);
            brute.insert(points);
            int compared = 0;
            for (std::size_t i = 0; i < points.size(); i += 7) {
                const Point place = points[i] + random.point(0.3);
                const auto [best, close] = brute.at(place);
                if (close) continue;
                const Surface* surface = map.at(place);
                ASSERT_EQ(surface != nullptr, best.has_value()) << place.transpose();
                if (surface == nullptr) continue;
                ++compared;
                const double variance = best->variance_at(place);
                EXPECT_NEAR(static_cast<double>(surface->variance_at(place)), variance,
                            0.02 * variance);
                EXPECT_EQ(static_cast<double>(surface->count), best->count);
                EXPECT_NEAR(surface->normal.norm(), 1.0F, 1e-4F);
                if (best->spread_1 < 2.0 * best->variance) continue;  // any normal is as good
                EXPECT_NEAR(off(*surface, place), best->off(place), 2e-3);
            }
            EXPECT_GT(compared, 500);
        }
    }
}

TEST(SurfaceMap, APlaneFollowsFromAllButTheNewestPoints) {
    test::Random random(2);
    SurfaceMap map(0.5);
    BruteMap brute(0.5);
    for (int scan = 0; scan < 40; ++scan) {
        const Points points = scenery(random, 300, Point::Zero());
        map.insert(points);
        brute.insert(points);
    }
    int compared = 0;
    for (const Point& place : scenery(random, 2000, Point::Zero())) {
        const Surface* surface = map.at(place);
        if (surface == nullptr) continue;
        bool found = false;
        for (std::size_t l = 0; l < SurfaceMap::kLevels; ++l) {
            const Points* all = brute.around(place, l);
            const auto count = static_cast<std::size_t>(surface->count);
            if (all == nullptr || all->size() < count) continue;
            const double most = 1000.0;
            if (1.25 * static_cast<double>(count) + 1.0 <
                std::min(most, static_cast<double>(all->size()))) {
                continue;
            }
            const Plane plane({all->begin(), all->begin() + static_cast<std::ptrdiff_t>(count)});
            const double variance = plane.variance_at(place);
            found |= std::abs(static_cast<double>(surface->variance_at(place)) - variance) <
                     0.02 * variance;
        }
        EXPECT_TRUE(found) << place.transpose();
        ++compared;
    }
    EXPECT_GT(compared, 500);
}

TEST(SurfaceMap, WhatWasThereFirstStaysAsItIs) {
    test::Random random(3);
    SurfaceMap map(0.5);
    const auto floor = [&](float z, std::size_t count) {
        Points points;
        for (std::size_t i = 0; i < count; ++i) {
            points.emplace_back(random.uniform_f(0.0, 0.5), random.uniform_f(0.0, 0.5), z);
        }
        return points;
    };
    map.insert(floor(0.1F, 1000));
    map.insert(floor(0.4F, 1000));
    EXPECT_NEAR(map.at({0.25F, 0.25F, 0.1F})->point.z(), 0.1F, 1e-3F);
}

void expect_same(const Surface* now, const Surface* before, const Point& shift) {
    ASSERT_EQ(now == nullptr, before == nullptr);
    if (now == nullptr) return;
    EXPECT_LT((now->point + shift - before->point).norm(), 1e-3F);
    EXPECT_EQ(now->normal, before->normal);
    EXPECT_EQ(now->variance, before->variance);
    EXPECT_EQ(now->count, before->count);
}

TEST(SurfaceMap, KeepWithinForgetsWhatIsFarAndNothingElse) {
    test::Random random(4);
    Points points;
    for (const float x : {-40.0F, -20.0F, 0.0F, 20.0F}) {
        const Points more = scenery(random, 2000, {x, -3.0F, 1.0F});
        points.insert(points.end(), more.begin(), more.end());
    }
    SurfaceMap map(0.5), all(0.5);
    map.insert(points);
    all.insert(points);
    const Point center(-18, -3, 1);
    const float radius = 15.0F, voxel = 0.9F * map.coarsest();  // more than half a diagonal
    map.keep_within(center, radius);
    int kept = 0, gone = 0;
    for (const Point& place : points) {
        const float distance = (place - center).norm();
        if (distance < radius - 2.0F * voxel) {
            expect_same(map.at(place), all.at(place), Point::Zero());
            ++kept;
        } else if (distance > radius + 2.0F * voxel) {
            EXPECT_EQ(map.at(place), nullptr);
            ++gone;
        }
    }
    EXPECT_GT(kept, 500);
    EXPECT_GT(gone, 500);
    for (const Point& place : map.places()) EXPECT_LT((place - center).norm(), radius + voxel);
    map.insert(points);  // goes on where it was
    EXPECT_NE(map.at(points[0]) == nullptr, all.at(points[0]) != nullptr);
    map.keep_within({1e5F, 0, 0}, 10.0F);
    EXPECT_TRUE(map.empty());
}

TEST(SurfaceMap, MovingTheOriginMovesAllAlike) {
    test::Random random(5);
    const Points points = scenery(random, 4000, {3.0F, -7.0F, 0.5F});
    SurfaceMap map(0.5), still(0.5);
    map.insert(points);
    still.insert(points);
    for (const Point& shift : {Point(8, -4, 0), Point(-1000, 12, 4), Point(0, 0, 0)}) {
        SurfaceMap there = map;
        there.move_origin(shift);
        for (std::size_t i = 0; i < points.size(); i += 5) {
            // from the middle of a finest voxel: rounding moves it into no other
            const Point place = center(pack(*cell_of(points[i], 2.0F)), 0.5F);
            expect_same(there.at(place - shift), still.at(place), shift);
        }
        Points more = scenery(random, 500, {3.0F, -7.0F, 0.5F});
        const std::size_t before = there.places().size();
        for (Point& p : more) p -= shift;
        there.insert(more);
        EXPECT_LT(there.places().size(), before + more.size());
    }
}

TEST(SurfaceMap, IsEmptyAtFirstAndWithoutUsablePoints) {
    constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
    SurfaceMap map(0.5);
    EXPECT_TRUE(map.empty());
    EXPECT_TRUE(map.places().empty());
    EXPECT_EQ(map.at({0, 0, 0}), nullptr);
    map.insert({});
    map.insert({{kNan, 0, 0}, {1e9F, 0, 0}, {0, -1e30F, 0}});
    EXPECT_TRUE(map.empty());
    EXPECT_EQ(map.at({kNan, 0, 0}), nullptr);
    EXPECT_EQ(map.at({1e9F, 0, 0}), nullptr);
    map.keep_within(Point::Zero(), 10.0F);
    map.move_origin({8, 0, 0});
    EXPECT_TRUE(map.empty());
    EXPECT_EQ(map.coarsest(), 4.0F);
}

TEST(SurfaceMap, BeyondTheReachOfKeysTheMapEnds) {
    SurfaceMap map(0.05);  // keys reach 52 km
    Points far;
    for (int i = 0; i < 100; ++i) {
        far.emplace_back(52000.0F + static_cast<float>(i % 10) * 0.1F,
                         static_cast<float>(i) * 0.01F, 0.0F);
    }
    map.insert(far);
    EXPECT_FALSE(map.empty());
    map.move_origin({-4000.0F, 0, 0});
    EXPECT_TRUE(map.empty());
}

TEST(SurfaceMap, PointsOnALineOrASpotAreNoSurface) {
    SurfaceMap spot(0.5), line(0.5);
    spot.insert(Points(100, {3.1F, 3.1F, 3.1F}));
    EXPECT_EQ(spot.at({3.1F, 3.1F, 3.1F}), nullptr);
    Points points;
    for (int i = 0; i < 100; ++i) points.emplace_back(0.04F * static_cast<float>(i), 0.1F, 0.1F);
    line.insert(points);
    for (const Point& p : points) EXPECT_EQ(line.at(p), nullptr);
}

}  // namespace surface_map_test
}  // namespace dynamic_filter
