// SPDX-License-Identifier: MIT
// How much of the map the crowd leaves behind, against Sec. IV-A of the paper. Takes a few seconds
// for each crowd: two rounds of scans.
#include <gtest/gtest.h>

#include <cmath>
#include <unordered_map>

#include "dynamic_filter/simulation.hpp"

namespace dynamic_filter::sim {
namespace voxel_share_test {

/// [%] of the 0.2 m voxels of all returns that hold a dynamic one.
double dynamic_share(int pedestrians) {
    SimulationOptions options;
    options.pedestrians = pedestrians;
    Simulation simulation(options);
    std::unordered_map<std::uint64_t, bool> voxels;
    for (std::size_t i = 0; i < simulation.size(); ++i) {
        const SimulatedScan scan = simulation.scan(i);
        for (std::size_t k = 0; k < scan.points.size(); ++k) {
            const Eigen::Vector3d p = scan.T_world_sensor * scan.points[k].cast<double>() / 0.2;
            std::uint64_t key = 0;
            for (int axis = 0; axis < 3; ++axis) {
                key = key << 20 | static_cast<std::uint64_t>(std::floor(p[axis]) + 500000.0);
            }
            voxels[key] |= scan.labels[k] == Label::dynamic;
        }
    }
    std::size_t dynamic = 0;
    for (const auto& [key, moved] : voxels) dynamic += moved;
    return 100.0 * static_cast<double>(dynamic) / static_cast<double>(voxels.size());
}

TEST(VoxelShare, Of50People) { EXPECT_NEAR(dynamic_share(50), 54.8, 4.0); }
TEST(VoxelShare, Of100People) { EXPECT_NEAR(dynamic_share(100), 58.5, 4.0); }
TEST(VoxelShare, Of150People) { EXPECT_NEAR(dynamic_share(150), 59.3, 4.0); }

}  // namespace voxel_share_test
}  // namespace dynamic_filter::sim
