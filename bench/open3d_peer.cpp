// SPDX-License-Identifier: MIT
/// Runs Generalized ICP of Open3D (Zhou et al. 2018; Segal et al., RSS 2009) as an odometry. Each
/// scan is registered to the ten previous ones; the first guess is the previous motion.
///   open3d_peer RECORDING...
#include <open3d/Open3D.h>

#include <ctime>
#include <deque>
#include <vector>

#include "bench/path_error.hpp"
#include "dynamic_filter/recording.hpp"

using namespace dynamic_filter;

namespace {

namespace registration = open3d::pipelines::registration;
using Cloud = open3d::geometry::PointCloud;

constexpr std::size_t kScans = 10;      // number of scans of the map
constexpr double kVoxel = 0.5;          // [m] to which scans and map are thinned
constexpr double kFar = 2.0;            // [m] largest distance of a pair of points
constexpr double kKernel = 0.5;         // [m]
constexpr double kNeighbourhood = 2.0;  // [m] for the normal of a point

std::shared_ptr<Cloud> thinned(const Points& points) {
    Cloud cloud;
    for (const Point& p : points) {
        if (p.allFinite() && p.norm() > 1.5F && p.norm() < 100.0F) {
            cloud.points_.push_back(p.cast<double>());
        }
    }
    return cloud.VoxelDownSample(kVoxel);
}

/// All scans of the map as one thinned cloud with normals, as far as points have normals.
std::shared_ptr<Cloud> surfaces(const std::deque<Cloud>& map) {
    Cloud all;
    for (const Cloud& scan : map) all += scan;
    const auto cloud = all.VoxelDownSample(kVoxel);
    cloud->EstimateNormals(open3d::geometry::KDTreeSearchParamHybrid(kNeighbourhood, 20));
    std::vector<std::size_t> good;
    for (std::size_t i = 0; i < cloud->normals_.size(); ++i) {
        if (cloud->normals_[i].allFinite()) good.push_back(i);
    }
    return cloud->SelectByIndex(good);
}

void measure(const char* recording) {
    const io::Recording sequence = io::open_recording(recording);
    std::vector<Pose> truth, found;
    std::deque<Cloud> map;
    std::clock_t clocks = 0;
    for (std::size_t i = 0; i < sequence.size(); ++i) {
        const io::FullScan full = sequence.read(i);
        const std::clock_t start = std::clock();
        const auto scan = thinned(full.points);
        Pose pose = found.empty() ? Pose::Identity() : found.back();
        if (found.size() > 1) pose = pose * (found[i - 2].inverse() * found[i - 1]);
        if (!map.empty()) {
            const auto target = surfaces(map);
            const auto kernel = std::make_shared<registration::TukeyLoss>(kKernel);
            pose.matrix() = registration::RegistrationICP(
                                *scan, *target, kFar, pose.matrix(),
                                registration::TransformationEstimationPointToPlane(kernel),
                                registration::ICPConvergenceCriteria(1e-6, 1e-6, 30))
                                .transformation_;
        }
        pose.linear() = Eigen::Quaterniond(pose.linear()).normalized().toRotationMatrix();
        Cloud in_world;
        in_world.points_ = scan->points_;
        map.push_back(in_world.Transform(pose.matrix()));
        if (map.size() > kScans) map.pop_front();
        clocks += std::clock() - start;
        truth.push_back(full.T_world_sensor);
        found.push_back(pose);
    }
    print_errors(recording, truth, found, "Open3D's ICP", clocks);
}

}  // namespace

int main(int argc, char** argv) {
    for (int a = 1; a < argc; ++a) measure(argv[a]);
}
