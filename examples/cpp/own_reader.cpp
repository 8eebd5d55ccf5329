// SPDX-License-Identifier: MIT
/// own_reader RECORDING: the core alone, for scans that you read yourself; here KITTI's layout,
/// velodyne/000000.bin and so on, and poses.txt.
#include <array>
#include <cstdio>
#include <dynamic_filter/dynamic_filter.hpp>
#include <filesystem>
#include <fstream>

namespace df = dynamic_filter;

namespace {

df::Points read_points(const std::filesystem::path& file) {
    std::ifstream in(file, std::ios::binary);
    df::Points points;
    std::array<float, 4> record{};  // x y z intensity
    while (in.read(reinterpret_cast<char*>(record.data()), sizeof record)) {
        points.emplace_back(record[0], record[1], record[2]);
    }
    return points;
}

bool read_pose(std::istream& in, df::Pose& T_world_sensor) {
    T_world_sensor = df::Pose::Identity();
    for (int row = 0; row < 3; ++row) {
        for (int column = 0; column < 4; ++column) in >> T_world_sensor(row, column);
    }
    return static_cast<bool>(in);
}

}  // namespace

int main(int argc, char** argv) {
    const std::filesystem::path recording = argc == 2 ? argv[1] : ".";
    std::ifstream poses(recording / "poses.txt");
    df::DynamicFilter filter{df::Config{}};
    df::Scan scan;
    std::size_t moving = 0;
    for (; read_pose(poses, scan.T_world_sensor); ++scan.index) {
        std::array<char, 32> name{};
        std::snprintf(name.data(), name.size(), "velodyne/%06zu.bin", scan.index);
        scan.points = read_points(recording / name.data());
        scan.stamp = 0.1 * static_cast<double>(scan.index);  // 10 Hz
        for (const df::Label label : filter.push(scan).labels) {
            moving += label == df::Label::dynamic;
        }
    }
    std::printf("%zu scans, %zu points were moving\n", scan.index, moving);
    return scan.index > 0 ? 0 : 1;
}
