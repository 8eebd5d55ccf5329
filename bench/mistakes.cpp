// SPDX-License-Identifier: MIT
// Makes copies of a recording, each with one of the mistakes that users make, and tests whether
// `check` names the mistake.
//   mistakes RECORDING [OTHER]...     tests each one; "poses of another one" are those of the next
//   mistakes --motion RECORDING...    only poses that are nearly right
#include <fmt/format.h>

#include <filesystem>
#include <functional>
#include <random>
#include <string>
#include <vector>

#include "dynamic_filter/check.hpp"
#include "dynamic_filter/motion.hpp"
#include "dynamic_filter/poses.hpp"
#include "dynamic_filter/writers.hpp"
#include "support/temporary_folder.hpp"

using namespace dynamic_filter;
namespace fs = std::filesystem;

namespace {

constexpr std::size_t kMost = 80;  // number of scans of a copy

struct Copy {
    std::vector<Points> scans;
    std::vector<Pose> poses;
    std::vector<double> stamps;
};

struct Mistake {
    const char* name;
    const char* named_as;  // part of the expected finding
    std::function<void(Copy&)> make;
    std::string (*row)(const Copy&, std::size_t);  // writes a row of the pose file
};

std::string numbers(std::initializer_list<double> values) {
    std::string row;
    for (const double v : values) row += fmt::format("{}{:.17g}", row.empty() ? "" : " ", v);
    return row + "\n";
}

std::string kitti_row(const Copy& copy, std::size_t i) {
    const auto m = copy.poses[i].matrix();
    return numbers({m(0, 0), m(0, 1), m(0, 2), m(0, 3), m(1, 0), m(1, 1), m(1, 2), m(1, 3), m(2, 0),
                    m(2, 1), m(2, 2), m(2, 3)});
}
std::string tum_row(const Copy& copy, std::size_t i) {
    const Eigen::Quaterniond q(copy.poses[i].linear());
    const auto t = copy.poses[i].translation();
    return numbers({copy.stamps[i], t.x(), t.y(), t.z(), q.x(), q.y(), q.z(), q.w()});
}
std::string tum_row_wxyz(const Copy& copy, std::size_t i) {
    const Eigen::Quaterniond q(copy.poses[i].linear());
    const auto t = copy.poses[i].translation();
    return numbers({copy.stamps[i], t.x(), t.y(), t.z(), q.w(), q.x(), q.y(), q.z()});
}

void each_pose(Copy& copy, const std::function<Pose(const Pose&)>& change) {
    for (Pose& pose : copy.poses) pose = change(pose);
}
/// Poses of a camera 0.3 m in front of the LiDAR and 0.3 m below it.
Pose camera_pose(const Pose& T_world_lidar) {
    Pose T_camera_lidar = Pose::Identity();
    T_camera_lidar.linear() << 0, -1, 0, 0, 0, -1, 1, 0, 0;
    T_camera_lidar.translation() << 0.0, -0.1, -0.3;
    return T_camera_lidar * T_world_lidar * T_camera_lidar.inverse();
}

void into_world(Copy& copy) {
    for (std::size_t i = 0; i < copy.scans.size(); ++i) {
        for (Point& p : copy.scans[i]) p = (copy.poses[i] * p.cast<double>()).cast<float>();
    }
}
void merge_sensors(Copy& copy) {
    const Eigen::Isometry3f T_first_second =
        Eigen::Translation3f(1.2F, 0.5F, -0.3F) * Eigen::AngleAxisf(0.02F, Point::UnitZ());
    for (std::size_t i = 0; i < copy.scans.size(); ++i) {
        // A second sensor sees the scene a moment later: the next scan, seen from its place.
        const Points& other = copy.scans[i + 1 < copy.scans.size() ? i + 1 : i];
        const std::size_t size = copy.scans[i].size();
        for (std::size_t p = 0; p < std::min(size, other.size()); ++p) {
            copy.scans[i].push_back(T_first_second * other[p]);
        }
    }
}

std::vector<Mistake> mistakes(const std::vector<Pose>& of_another) {
    return {
        {"none", "", [](Copy&) {}, kitti_row},
        {"none, TUM", "", [](Copy&) {}, tum_row},
        {"points in the world frame", "world's frame", into_world, kitti_row},
        {"camera poses", "camera", [](Copy& c) { each_pose(c, camera_pose); }, kitti_row},
        {"inverse poses", "inverse",
         [](Copy& c) { each_pose(c, [](const Pose& p) { return p.inverse(); }); }, kitti_row},
        {"quaternions w x y z", "w x y z, but", [](Copy&) {}, tum_row_wxyz},
        {"millimetres", "millimetres",
         [](Copy& c) {
             each_pose(c, [](Pose p) {
                 p.translation() *= 1000.0;
                 return p;
             });
         },
         kitti_row},
        {"stamps in ns", "if the unit is ns",
         [](Copy& c) {
             for (double& t : c.stamps) t *= 1e9;
         },
         tum_row},
        {"stamps in ms", "if the unit is ms",
         [](Copy& c) {
             for (double& t : c.stamps) t *= 1e3;
         },
         tum_row},
        {"constant poses", "all poses are equal",
         [](Copy& c) { each_pose(c, [&, first = c.poses.front()](const Pose&) { return first; }); },
         kitti_row},
        {"two sensors merged", "merged", merge_sensors, kitti_row},
        {"poses of another recording", "do not fit",
         [of_another](Copy& c) {
             for (std::size_t i = 0; i < c.poses.size(); ++i) {
                 c.poses[i] = of_another[i % of_another.size()];
             }
         },
         kitti_row},
    };
}

constexpr double kDegree = 0.017453293;

/// 5 cm/s in height and 0.1 deg/s of yaw.
void drift(Copy& copy) {
    for (std::size_t i = 0; i < copy.poses.size(); ++i) {
        const double t = copy.stamps[i] - copy.stamps.front();
        Pose& pose = copy.poses[i];
        pose.linear() =
            Eigen::AngleAxisd(0.1 * kDegree * t, Eigen::Vector3d::UnitZ()) * pose.linear();
        pose.translation().z() += 0.05 * t;
    }
}
/// 3 cm and 0.2 degrees.
void jitter(Copy& copy) {
    std::mt19937 engine(copy.poses.size());
    std::normal_distribution<double> unit;
    for (Pose& pose : copy.poses) {
        Twist off;
        for (int k = 0; k < 6; ++k) off[k] = (k < 3 ? 0.03 : 0.2 * kDegree) * unit(engine);
        pose = pose * exp(off);
    }
}
/// Each pose is that of 50 ms after its scan.
void late(Copy& copy) {
    const std::vector<Pose> on_time = copy.poses;
    for (std::size_t i = 0; i + 1 < on_time.size(); ++i) {
        const double share = 0.05 / (copy.stamps[i + 1] - copy.stamps[i]);
        copy.poses[i] = on_time[i] * exp(share * log(on_time[i].inverse() * on_time[i + 1]));
    }
}
void lever_arm(Copy& copy) {
    each_pose(copy, [](const Pose& p) { return p * Eigen::Translation3d(0.5, 0.0, 0.0); });
}

/// Poses that are nearly right.
std::vector<Mistake> mistakes_of_motion() {
    return {
        {"none", "", [](Copy&) {}, tum_row},
        {"drift", "the poses drift", drift, tum_row},
        {"jitter", "the poses jitter", jitter, tum_row},
        {"late by 50 ms", "offset in time", late, tum_row},
        {"lever arm of 0.5 m", "not the sensor's own", lever_arm, tum_row},
    };
}

Copy read_copy(const fs::path& recording) {
    const io::Recording opened = io::open_recording(recording);
    Copy copy;
    for (std::size_t i = 0; i < std::min(kMost, opened.size()); ++i) {
        io::FullScan scan = opened.read(i);
        copy.scans.push_back(std::move(scan.points));
        copy.poses.push_back(scan.T_world_sensor);
        copy.stamps.push_back(1000.0 + scan.stamp);
    }
    return copy;
}

io::Preflight check_copy(const Copy& copy, const Mistake& mistake) {
    const test::TemporaryFolder folder;
    fs::create_directories(folder.path() / "scans");
    std::string rows;
    for (std::size_t i = 0; i < copy.scans.size(); ++i) {
        rows += mistake.row(copy, i);
        io::write_bin(folder.path() / fmt::format("scans/{:06}.bin", i), copy.scans[i],
                      std::vector<float>(copy.scans[i].size()));
    }
    io::write_file(folder.path() / "poses.txt", rows);
    return io::check_recording(io::open_recording(folder.path()), io::Depth::thorough);
}

}  // namespace

int main(int argc, char** argv) {
    const bool of_motion = argc > 1 && std::string(argv[1]) == "--motion";
    std::vector<fs::path> recordings(argv + (of_motion ? 2 : 1), argv + argc);
    int named = 0, made = 0, alarms = 0;
    for (std::size_t r = 0; r < recordings.size(); ++r) {
        const Copy original = read_copy(recordings[r]);
        const Copy other = read_copy(recordings[(r + 1) % recordings.size()]);
        for (const Mistake& mistake : of_motion ? mistakes_of_motion() : mistakes(other.poses)) {
            Copy copy = original;
            mistake.make(copy);
            const io::Preflight result = check_copy(copy, mistake);
            const std::string found = result.findings.empty() ? "" : result.findings.front().what;
            const bool original_kept = std::string(mistake.named_as).empty();
            const bool right =
                original_kept ? found.empty() : found.find(mistake.named_as) != std::string::npos;
            (original_kept ? alarms : named) += original_kept ? (right ? 0 : 1) : (right ? 1 : 0);
            made += original_kept ? 0 : 1;
            fmt::print("| {} | {} | {} | {} |\n", recordings[r].filename().string(), mistake.name,
                       right ? "yes" : "NO", found.empty() ? "nothing suspicious" : found);
        }
    }
    fmt::print("\nnamed {} of {}, false alarms {}\n", named, made, alarms);
    return 0;
}
