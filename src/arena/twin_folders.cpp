// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <array>
#include <span>

#include "arena/find.hpp"
#include "arena/twin.hpp"
#include "dynamic_filter/file.hpp"
#include "dynamic_filter/writers.hpp"
#include "formats/label_files.hpp"
#include "recording/scans.hpp"

namespace dynamic_filter::app {

namespace {

namespace fs = std::filesystem;

/// From the LiDAR to the left camera, as KITTI's calib.txt has it: x right, y down, z ahead.
Pose T_camera_lidar() {
    Pose Tr(Eigen::Translation3d(-0.005, -0.073, -0.334));
    Tr.linear() << 0, -1, 0, 0, 0, -1, 1, 0, 0;
    return Tr;
}

std::string row_of(const Pose& pose) {
    const Eigen::Matrix<double, 3, 4, Eigen::RowMajor> rows = pose.matrix().topRows<3>();
    std::string text;
    for (const double value : rows.reshaped<Eigen::RowMajor>()) {
        text += fmt::format("{}{:.12e}", text.empty() ? "" : " ", value);
    }
    return text;
}

/// Classes of SemanticKITTI. A few points are unlabelled, as in the data set.
std::vector<std::uint32_t> classes_of(const sim::SimulatedScan& scan) {
    std::vector<std::uint32_t> labels(scan.points.size());
    for (std::size_t p = 0; p < labels.size(); ++p) {
        const auto class_of = [&]() -> std::uint32_t {
            switch (scan.kinds[p]) {
                case sim::Kind::ground:
                    return 40;
                case sim::Kind::structure:
                    return 50;
                case sim::Kind::thin:
                    return 80;
                case sim::Kind::vegetation:
                    return 70;
                case sim::Kind::walking:
                case sim::Kind::standing:
                    return 254;
                default:
                    return 252;
            }
        };
        labels[p] = p % 97 == 0 ? 0 : class_of() | std::uint32_t{scan.instances[p]} << 16U;
    }
    return labels;
}

/// 9 and 251, as HeLiMOS has them.
std::vector<std::uint32_t> moving_of(const sim::SimulatedScan& scan) {
    std::vector<std::uint32_t> labels(scan.points.size());
    for (std::size_t p = 0; p < labels.size(); ++p) {
        labels[p] = static_cast<std::uint32_t>(scan.labels[p]);
    }
    return labels;
}

void write_scan_and_labels(const fs::path& folder, const std::string& stem,
                           const sim::SimulatedScan& scan, std::vector<std::uint32_t> labels) {
    io::write_bin(folder / "velodyne" / (stem + ".bin"), scan.points, scan.intensity,
                  io::Durable::contents);
    if (labels.empty()) return;
    io::write_numbered_labels(io::label_file(folder / "labels", stem), labels,
                              io::Durable::contents);
}

}  // namespace

std::vector<sim::SimulatedScan> twin_scans(const std::string& entry, std::size_t scans,
                                           const std::string& sensor) {
    std::uint64_t seed = 1;
    for (const char letter : entry) seed = 31 * seed + static_cast<unsigned char>(letter);
    sim::Simulation simulation(
        {.scene = "crowd", .sensor = sensor, .pedestrians = 50, .seed = seed, .frames = scans});
    std::vector<sim::SimulatedScan> all;
    for (std::size_t i = 0; i < scans; ++i) all.push_back(simulation.scan(i));
    return all;
}

io::Cloud cloud_of(const Points& points, const std::vector<std::string>& more,
                   const std::vector<std::vector<float>>& values) {
    io::Cloud cloud;
    for (const char* name : {"x", "y", "z"}) io::add_field(cloud, name, io::FieldType::f32);
    for (const std::string& name : more) io::add_field(cloud, name, io::FieldType::f32);
    for (std::size_t p = 0; p < points.size(); ++p) {
        std::vector<float> record{points[p].x(), points[p].y(), points[p].z()};
        for (const std::vector<float>& list : values) record.push_back(list[p]);
        const auto bytes = std::as_bytes(std::span(record));
        cloud.data.insert(cloud.data.end(), bytes.begin(), bytes.end());
    }
    return cloud;
}

void write_sequence_twin(const fs::path& root, const std::string& entry) {
    const ScanWindow window = semantickitti_window(entry).value_or(ScanWindow{0, 59, 1});
    const fs::path folder = root / "sequences" / entry;
    for (const char* name : {"velodyne", "labels"}) fs::create_directories(folder / name);
    const auto scans = twin_scans(entry, window.last - window.first + 1);
    const Pose Tr = T_camera_lidar();
    std::string poses, times;
    for (std::size_t number = 0; number <= window.last; ++number) {
        const auto& scan = scans[number < window.first ? 0 : number - window.first];
        poses += row_of(Tr * scan.T_world_sensor * Tr.inverse()) + "\n";
        times += fmt::format("{:.6e}\n", 0.1 * static_cast<double>(number));
        if (number < window.first) continue;
        write_scan_and_labels(folder, fmt::format("{:06}", number), scan, classes_of(scan));
    }
    io::write_file(folder / "poses.txt", poses);
    io::write_file(folder / "times.txt", times);
    io::write_file(folder / "calib.txt", "Tr: " + row_of(Tr) + "\n");
}

void write_dynamicmap_twin(const fs::path& root, const std::string& entry) {
    // The benchmark's program writes more of sequence 01 than is scored.
    const std::size_t first = entry == "00" ? 4390 : entry == "05" ? 2350 : entry == "01" ? 145 : 0;
    const std::size_t count = entry == "01" ? 115 : 40;
    const fs::path folder = root / entry;
    fs::create_directories(folder / "pcd");
    io::Cloud all = cloud_of({}, {"intensity"}, {});
    const auto scans = twin_scans(entry, count);
    for (std::size_t i = 0; i < count; ++i) {
        std::vector<float> moves;
        for (const Label label : scans[i].labels)
            moves.push_back(label == Label::dynamic ? 1.F : 0.F);
        const Points world =
            shifted_world(scans[i].points, scans[i].T_world_sensor, Eigen::Vector3d::Zero());
        const io::Cloud truth = cloud_of(world, {"intensity"}, {moves});
        all.data.insert(all.data.end(), truth.data.begin(), truth.data.end());
        // The scans of av2 have no intensity, and those of semindoor that of the sensor.
        io::Cloud cloud = entry == "av2" ? cloud_of(world, {}, {})
                          : entry == "semindoor"
                              ? cloud_of(world, {"intensity"}, {scans[i].intensity})
                              : truth;
        cloud.viewpoint = scans[i].T_world_sensor;
        io::write_pcd(folder / "pcd" / fmt::format("{:06}.pcd", first + i), cloud);
    }
    io::write_pcd(folder / "gt_cloud.pcd", all);
}

void write_helimos_twin(const fs::path& root, const std::string& entry) {
    constexpr std::size_t kScans = 40;
    const fs::path top = root / "KAIST05" / "Deskewed_LiDAR", folder = top / entry;
    for (const char* name : {"velodyne", "labels"}) fs::create_directories(folder / name);
    const bool is_solid = entry == "Aeva" || entry == "Avia";
    const auto scans = twin_scans(entry, kScans, is_solid ? "solid" : "vlp16");
    std::array<std::string, 3> lists;  // train, val, test
    std::vector<Pose> poses;
    for (std::size_t i = 0; i < kScans; ++i) {
        const bool has_labels = i % 2 == 0;
        write_scan_and_labels(folder, fmt::format("{:06}", i), scans[i],
                              has_labels ? moving_of(scans[i]) : std::vector<std::uint32_t>{});
        if (has_labels) lists[i / 2 % 3] += fmt::format("{}\n", i);
        poses.push_back(scans[i].T_world_sensor);
    }
    io::write_poses_kitti(folder / "poses.txt", poses);
    io::write_file(folder / "calib.txt", "Tr: 1 0 0 0 0 1 0 0 0 0 1 0\n");
    for (std::size_t l = 0; l < lists.size(); ++l) {
        io::write_file(top / std::array{"train.txt", "val.txt", "test.txt"}[l], lists[l]);
    }
}

void write_moe_twin(const fs::path& root, const std::string& entry) {
    constexpr std::size_t kScans = 40;
    const fs::path folder = root / entry;
    for (const char* name : {"pcd", "label"}) fs::create_directories(folder / name);
    const auto scans = twin_scans(entry, kScans);
    std::vector<Pose> poses;
    for (std::size_t i = 0; i < kScans; ++i) {
        const std::string stem = fmt::format("{:06}", i);
        io::write_pcd(folder / "pcd" / (stem + ".pcd"), cloud_of(scans[i].points, {}, {}));
        std::string rows;
        for (const Label label : scans[i].labels) {
            rows += label == Label::dynamic ? "1 1 0\n" : "0 0 -1\n";
        }
        io::write_file(folder / "label" / (stem + ".txt"), rows);
        poses.push_back(scans[i].T_world_sensor);
    }
    io::write_poses_kitti(folder / "gt_poses.txt", poses);
}

}  // namespace dynamic_filter::app
