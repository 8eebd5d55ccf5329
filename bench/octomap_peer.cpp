// SPDX-License-Identifier: MIT
/// Runs OctoMap (Hornung et al., Autonomous Robots 2013) on a recording, with its default sensor
/// model, voxels of 0.2 m, and no limit of range. A point is static if its voxel is occupied in the
/// final tree. Prints scores and the time of insertion as JSON.
#include <fmt/format.h>
#include <octomap/octomap.h>

#include <chrono>
#include <cstdlib>
#include <ctime>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "dynamic_filter/error.hpp"
#include "recording/scans.hpp"
#include "run/scored_scans.hpp"
#include "score/report.hpp"

namespace {

using namespace dynamic_filter;

struct Seconds {
    double wall = 0.0, cpu = 0.0;
};

/// Adds the time between construction and destruction.
class Stopwatch {
public:
    explicit Stopwatch(Seconds& sum) : sum_(sum) {}
    ~Stopwatch() {
        sum_.wall += std::chrono::duration<double>(Clock::now() - wall_).count();
        sum_.cpu += static_cast<double>(std::clock() - cpu_) / CLOCKS_PER_SEC;
    }
    Stopwatch(const Stopwatch&) = delete;
    Stopwatch& operator=(const Stopwatch&) = delete;

private:
    using Clock = std::chrono::steady_clock;
    Seconds& sum_;
    Clock::time_point wall_ = Clock::now();
    std::clock_t cpu_ = std::clock();
};

octomap::point3d to_octomap(const Point& p) { return {p.x(), p.y(), p.z()}; }

/// `origin` is the origin of the frame of the scores, a whole multiple of the voxel size, so that
/// the voxels are the same.
void insert(octomap::OcTree& tree, const io::FullScan& scan, const Eigen::Vector3d& origin,
            Seconds& insertion) {
    const Points points = app::shifted_world(scan, origin);
    octomap::Pointcloud cloud;
    for (std::size_t i = 0; i < points.size(); ++i) {
        if (is_measured(scan.points[i])) cloud.push_back(to_octomap(points[i]));
    }
    const Eigen::Vector3d sensor = scan.T_world_sensor.translation() - origin;
    const Stopwatch stopwatch(insertion);
    tree.insertPointCloud(cloud, to_octomap(sensor.cast<float>()));
}

Labels labels_of(const octomap::OcTree& tree, const io::FullScan& scan,
                 const Eigen::Vector3d& origin) {
    Labels labels;
    const Points world = app::shifted_world(scan, origin);
    for (std::size_t i = 0; i < world.size(); ++i) {
        const auto* const node =
            is_measured(scan.points[i]) ? tree.search(to_octomap(world[i])) : nullptr;
        labels.push_back(node == nullptr             ? Label::unknown
                         : tree.isNodeOccupied(node) ? Label::static_
                                                     : Label::dynamic);
    }
    return labels;
}

nlohmann::ordered_json peer(const io::Recording& recording) {
    const Eigen::Vector3d origin = app::scoring_origin(recording, eval::kVoxelSize);
    octomap::OcTree tree(eval::kVoxelSize);
    Seconds insertion, all;
    for (std::size_t i = 0; i < recording.size(); ++i) {
        const Stopwatch stopwatch(all);
        insert(tree, recording.read(i), origin, insertion);
    }
    const auto scores = eval::score_labels(
        recording.size(),
        app::scan_source(recording, origin,
                         [&](std::size_t i) {
                             return std::optional(labels_of(tree, recording.read(i), origin));
                         }),
        eval::kVoxelSize);
    auto json = app::to_json(scores);
    const auto scans = static_cast<double>(recording.size());
    json["scans"] = recording.size();
    json["cpu_seconds"] = insertion.cpu;
    json["scans_per_second"] = scans / insertion.wall;
    json["scans_per_second_with_reading"] = scans / all.wall;
    return json;
}

}  // namespace

int main(int argc, char** argv) {
    if (argc < 2 || argc > 3) {
        fmt::print(stderr, "usage: octomap_peer RECORDING [STRIDE]\n");
        return 2;
    }
    try {
        const int stride = argc == 3 ? std::atoi(argv[2]) : 1;
        if (stride < 1) throw ConfigError("STRIDE must be a positive number");
        io::OpenOptions options;
        options.stride = static_cast<std::size_t>(stride);
        const auto recording = io::open_recording(argv[1], options);
        if (!recording.info().has_truth()) throw ConfigError("the recording has no ground truth");
        fmt::print("{}", app::text_of(peer(recording)));
        return 0;
    } catch (const Error& error) {
        fmt::print(stderr, "octomap_peer: {}\n", error.what());
        return 2;
    }
}
