// SPDX-License-Identifier: MIT
#include "sim/seen_through.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>

#include "dynamic_filter/parallel.hpp"

namespace dynamic_filter::sim {
namespace seen_through_test {

using Eigen::Vector3d;
constexpr double kEdge = 0.2;  // [m]

Vector3d middle(int x, int y, int z) {
    return kEdge * (Eigen::Vector3i(x, y, z).cast<double>() + Vector3d::Constant(0.5));
}

/// Scans of beams through a cube of 6 m around the origin of the world.
std::vector<std::vector<Beam>> random_scans() {
    std::mt19937 random(5);
    const auto coordinate = [&] { return static_cast<double>(random() % 60000) / 1e4 - 3.0; };
    const auto place = [&] { return Vector3d(coordinate(), coordinate(), coordinate()); };
    std::vector<std::vector<Beam>> scans(3);
    for (auto& scan : scans) {
        const Vector3d sensor = place();
        for (int i = 0; i < 400; ++i) scan.push_back({sensor, place()});
    }
    return scans;
}

Eigen::Vector3i voxel_of(const Vector3d& point) {
    return (point / kEdge).array().floor().cast<int>().matrix();
}

/// Whether one of many points along the beam lies in the voxel.
bool crosses(const Beam& beam, const Eigen::Vector3i& voxel) {
    const Vector3d way = beam.end - beam.origin;
    const double length = way.norm() - kEdge;
    for (double at = 0.0; at < length; at += 2e-3) {
        if (voxel_of(beam.origin + at / way.norm() * way) == voxel) return true;
    }
    return false;
}

/// Whether it passes through the voxel with a margin on all sides, by the slab method.
bool touches(const Beam& beam, const Eigen::Vector3i& voxel, double margin) {
    const Vector3d way = beam.end - beam.origin;
    double first = 0.0, last = 1.0 - kEdge / way.norm();
    for (int axis = 0; axis < 3; ++axis) {
        const double low = kEdge * voxel[axis] - margin, high = kEdge * (voxel[axis] + 1) + margin;
        const double a = (low - beam.origin[axis]) / way[axis];
        const double b = (high - beam.origin[axis]) / way[axis];
        first = std::max(first, std::min(a, b));
        last = std::min(last, std::max(a, b));
    }
    return first <= last;
}

/// The beams of all scans without a return in the voxel for which `passes` holds.
template <class Passes>
std::uint32_t count(const std::vector<std::vector<Beam>>& scans, const Eigen::Vector3i& voxel,
                    const Passes& passes) {
    std::uint32_t sum = 0;
    for (const auto& scan : scans) {
        const auto ends_here = [&](const Beam& beam) { return voxel_of(beam.end) == voxel; };
        if (std::any_of(scan.begin(), scan.end(), ends_here)) continue;
        sum += static_cast<std::uint32_t>(std::count_if(scan.begin(), scan.end(), passes));
    }
    return sum;
}

TEST(SeenThrough, CountsAsSampledPointsAlongTheBeamsDo) {
    const auto scans = random_scans();
    SeenThrough seen;
    std::vector<Eigen::Vector3i> voxels;
    std::vector<std::uint32_t> numbers;
    for (std::size_t i = 0; i < 60; ++i) {
        const Vector3d& point = scans[i % 3][i].end;
        voxels.push_back(voxel_of(0.5 * point));
        numbers.push_back(seen.ask_for(0.5 * point));
    }
    for (const auto& scan : scans) seen.add_scan(scan);
    std::uint32_t all = 0;
    for (std::size_t i = 0; i < voxels.size(); ++i) {
        const auto sampled = [&](const Beam& beam) { return crosses(beam, voxels[i]); };
        const auto inside = [&](const Beam& beam) { return touches(beam, voxels[i], -1e-9); };
        const auto around = [&](const Beam& beam) { return touches(beam, voxels[i], 1e-9); };
        const std::uint32_t beams = seen.beams_through(numbers[i]);
        EXPECT_GE(beams, count(scans, voxels[i], sampled));
        EXPECT_GE(beams, count(scans, voxels[i], inside));
        EXPECT_LE(beams, count(scans, voxels[i], around));
        all += beams;
    }
    EXPECT_GT(all, 100U);
}

TEST(SeenThrough, CountsTheSameWithAnyNumberOfThreads) {
    const auto scans = random_scans();
    const auto counts = [&](int threads) {
        SeenThrough seen;
        std::vector<std::uint32_t> beams;
        with_threads(threads, [&] {
            std::set<std::uint32_t> voxels;
            for (const Beam& beam : scans[0]) voxels.insert(seen.ask_for(beam.end));
            for (int i = 0; i < 20; ++i) seen.add_scan(scans[1]);
            for (const std::uint32_t voxel : voxels) beams.push_back(seen.beams_through(voxel));
        });
        return beams;
    };
    EXPECT_EQ(counts(1), counts(4));
}

TEST(SeenThrough, ABeamEndsTheEdgeOfAVoxelBeforeItsReturn) {
    SeenThrough seen;
    const std::uint32_t before = seen.ask_for(middle(7, 0, 0)),
                        beside = seen.ask_for(middle(7, 1, 0));
    // Crosses both, and the second only in the last 0.2 m.
    seen.add_scan(std::vector<Beam>{{middle(0, 0, 0), Vector3d(1.7, 0.21, 0.1)}});
    EXPECT_EQ(seen.beams_through(before), 1U);
    EXPECT_EQ(seen.beams_through(beside), 0U);
    seen.add_scan(std::vector<Beam>{{middle(0, 0, 0), Vector3d(3.3, 0.32, 0.1)}});
    EXPECT_EQ(seen.beams_through(beside), 1U);
}

TEST(SeenThrough, ShortBeamsPassThroughNothing) {
    SeenThrough seen;
    const std::uint32_t voxel = seen.ask_for(middle(0, 0, 0));
    seen.add_scan(std::vector<Beam>{{middle(0, 0, 0), Vector3d(0.29, 0.1, 0.1)}});
    seen.add_scan(std::vector<Beam>{{middle(0, 0, 0), middle(0, 0, 0)}});
    EXPECT_EQ(seen.beams_through(voxel), 0U);
}

TEST(SeenThrough, VoxelsWithAReturnInTheSameScanAreNotEmpty) {
    SeenThrough seen;
    const std::uint32_t voxel = seen.ask_for(middle(-3, -1, 2));
    const Beam past{middle(-9, -1, 2), middle(4, -1, 2)},
        into{middle(-9, -1, 2), middle(-3, -1, 2)};
    seen.add_scan(std::vector<Beam>{past, into});
    EXPECT_EQ(seen.beams_through(voxel), 0U);
    seen.add_scan(std::vector<Beam>{past, past});
    EXPECT_EQ(seen.beams_through(voxel), 2U);
}

TEST(SeenThrough, BeamsAlongAnAxisMissNoVoxel) {
    for (int axis = 0; axis < 3; ++axis) {
        for (const int way : {-1, 1}) {
            SeenThrough seen;
            std::vector<std::uint32_t> voxels;
            Eigen::Vector3i cell(3, -2, 1);
            for (int i = -9; i <= 9; ++i) {
                cell[axis] = way * i;
                voxels.push_back(seen.ask_for(middle(cell.x(), cell.y(), cell.z())));
            }
            const auto end = [&](int i) {
                cell[axis] = way * i;
                return middle(cell.x(), cell.y(), cell.z());
            };
            seen.add_scan(std::vector<Beam>{{end(-9), end(20)}});
            for (const std::uint32_t voxel : voxels) EXPECT_EQ(seen.beams_through(voxel), 1U);
        }
    }
}

}  // namespace seen_through_test
}  // namespace dynamic_filter::sim
