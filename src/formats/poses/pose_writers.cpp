// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <cmath>
#include <iterator>

#include "dynamic_filter/error.hpp"
#include "dynamic_filter/writers.hpp"

namespace dynamic_filter::io {
namespace {

void require_stamps(const std::filesystem::path& path, std::size_t stamps, std::size_t poses) {
    if (stamps == poses) return;
    throw OutputError(path, fmt::format("{} stamps but {} poses", stamps, poses));
}

/// Rounded after the seconds are split off: since 1970, a double has no room for nanoseconds.
std::int64_t nanoseconds_of(double stamp) {
    const double seconds = std::floor(stamp);
    return static_cast<std::int64_t>(seconds) * 1'000'000'000 +
           std::llround((stamp - seconds) * 1e9);
}

Eigen::Quaterniond rotation_of(const Pose& pose) {
    return Eigen::Quaterniond(pose.linear()).normalized();
}

}  // namespace

void write_poses_kitti(const std::filesystem::path& path, std::span<const Pose> T_world_sensor) {
    std::string text;
    for (const Pose& pose : T_world_sensor) {
        for (int i = 0; i < 12; ++i) {
            // "{}" prints the fewest digits that are read back as the same number.
            fmt::format_to(std::back_inserter(text), "{}{}", pose.matrix()(i / 4, i % 4),
                           i == 11 ? '\n' : ' ');
        }
    }
    write_file(path, text);
}

void write_poses_tum(const std::filesystem::path& path, std::span<const double> stamps,
                     std::span<const Pose> T_world_sensor) {
    require_stamps(path, stamps.size(), T_world_sensor.size());
    std::string text = "# timestamp tx ty tz qx qy qz qw\n";
    for (std::size_t i = 0; i < stamps.size(); ++i) {
        const Eigen::Vector3d t = T_world_sensor[i].translation();
        const Eigen::Quaterniond q = rotation_of(T_world_sensor[i]);
        fmt::format_to(std::back_inserter(text),
                       "{:.9f} {:.17g} {:.17g} {:.17g} {:.17g} {:.17g} {:.17g} {:.17g}\n",
                       stamps[i], t.x(), t.y(), t.z(), q.x(), q.y(), q.z(), q.w());
    }
    write_file(path, text);
}

void write_poses_csv(const std::filesystem::path& path, std::span<const double> stamps,
                     std::span<const Pose> T_world_sensor) {
    require_stamps(path, stamps.size(), T_world_sensor.size());
    std::string text =
        "#timestamp [ns],p_RS_R_x [m],p_RS_R_y [m],p_RS_R_z [m],q_RS_w [],q_RS_x [],q_RS_y [],"
        "q_RS_z []\n";
    for (std::size_t i = 0; i < stamps.size(); ++i) {
        const Eigen::Vector3d t = T_world_sensor[i].translation();
        const Eigen::Quaterniond q = rotation_of(T_world_sensor[i]);
        fmt::format_to(std::back_inserter(text),
                       "{},{:.17g},{:.17g},{:.17g},{:.17g},{:.17g},{:.17g},{:.17g}\n",
                       nanoseconds_of(stamps[i]), t.x(), t.y(), t.z(), q.w(), q.x(), q.y(), q.z());
    }
    write_file(path, text);
}

void write_poses_g2o(const std::filesystem::path& path, std::span<const Pose> T_world_sensor) {
    std::string text;
    for (std::size_t i = 0; i < T_world_sensor.size(); ++i) {
        if (!T_world_sensor[i].matrix().allFinite()) continue;
        const Eigen::Vector3d t = T_world_sensor[i].translation();
        const Eigen::Quaterniond q = rotation_of(T_world_sensor[i]);
        fmt::format_to(std::back_inserter(text),
                       "VERTEX_SE3:QUAT {} {:.17g} {:.17g} {:.17g} {:.17g} {:.17g} {:.17g} "
                       "{:.17g}\n",
                       i, t.x(), t.y(), t.z(), q.x(), q.y(), q.z(), q.w());
    }
    write_file(path, text);
}

}  // namespace dynamic_filter::io
