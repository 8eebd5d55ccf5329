// SPDX-License-Identifier: MIT
/// plain RECORDING RESULT OUT: the least that a run costs, to compare with. RECORDING is in KITTI's
/// layout, RESULT is what `run` left for it, OUT is a folder that is made.
///
/// It does in the plainest way, with one thread, what a run cannot do without: it reads the scans,
/// transforms their points, and writes the labels of RESULT and both maps ("read", "transform",
/// "write"). Then the least that a filter does: it finds the voxel of each point ("voxels"), makes
/// a range image of each scan ("image"), and compares every known voxel within reach with the image
/// of every scan ("questions"). Prints the CPU time of each part in ms a scan as JSON.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <map>
#include <numbers>
#include <string>
#include <vector>

#include <Eigen/Geometry>

namespace {

namespace fs = std::filesystem;
using Record = std::array<float, 4>;
using Records = std::vector<Record>;

double cpu_ms() { return 1e3 * static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

template <class T>
std::vector<T> read_all(const fs::path& file) {
    std::vector<T> values(fs::file_size(file) / sizeof(T));
    std::ifstream in(file, std::ios::binary);
    in.read(reinterpret_cast<char*>(values.data()),
            static_cast<std::streamsize>(values.size() * sizeof(T)));
    return values;
}

template <class T>
void write_all(std::ofstream& out, const std::vector<T>& values) {
    out.write(reinterpret_cast<const char*>(values.data()),
              static_cast<std::streamsize>(values.size() * sizeof(T)));
}

std::vector<Eigen::Isometry3d> read_poses(const fs::path& file) {
    std::ifstream in(file);
    std::vector<Eigen::Isometry3d> poses;
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
    while (true) {
        for (int k = 0; k < 12; ++k) in >> pose.matrix()(k / 4, k % 4);
        if (!in) return poses;
        poses.push_back(pose);
    }
}

/// The voxels that hold points: a hash table with open addressing.
class Voxels {
public:
    static constexpr float kSize = 0.2F;  // [m]

    void add(const Record& p) {
        const Eigen::Array3f cell = Eigen::Array3f(p[0], p[1], p[2]) / kSize;
        std::uint64_t key = 0;
        for (int axis = 0; axis < 3; ++axis) {
            const auto at = static_cast<std::int64_t>(std::floor(cell[axis])) + (1 << 20);
            key = key << 21U | static_cast<std::uint64_t>(at);
        }
        std::size_t slot = key * 0x9E3779B97F4A7C15ULL >> 40U;
        while (keys_[slot] != 0 && keys_[slot] != key) slot = (slot + 1) % keys_.size();
        if (keys_[slot] == key) return;
        keys_[slot] = key;
        centers.emplace_back((cell.floor() + 0.5F) * kSize);
    }
    std::vector<Eigen::Vector3f> centers{};

private:
    std::vector<std::uint64_t> keys_ = std::vector<std::uint64_t>(std::size_t{1} << 24U);
};

/// Ranges over directions, a pixel a quarter of a degree.
class Image {
public:
    static constexpr int kColumns = 1440, kRows = 360;

    void add(const Eigen::Vector3f& p) {
        float& nearest = at(p);
        const float range = p.norm();
        if (nearest == 0.0F || range < nearest) nearest = range;
    }
    /// True if the scan saw farther than this place.
    bool is_free(const Eigen::Vector3f& p) { return at(p) > p.norm() + 0.5F; }

private:
    float& at(const Eigen::Vector3f& p) {
        constexpr float kPixel = std::numbers::pi_v<float> / 720.0F;
        const float azimuth = std::atan2(p.y(), p.x()), elevation = std::asin(p.z() / p.norm());
        const int column = static_cast<int>((azimuth + std::numbers::pi_v<float>) / kPixel);
        const int row = static_cast<int>(elevation / kPixel) + kRows;
        return ranges_[static_cast<std::size_t>(row * kColumns + std::min(column, kColumns - 1))];
    }
    std::vector<float> ranges_ = std::vector<float>(std::size_t{2 * kRows + 1} * kColumns);
};

class Clock {
public:
    void add(const std::string& part) {
        const double now = cpu_ms();
        times[part] += now - last_;
        last_ = now;
    }
    std::map<std::string, double> times{};

private:
    double last_ = cpu_ms();
};

}  // namespace

int main(int argc, char** argv) {
    if (argc != 4) return 2;
    const fs::path recording = argv[1], result = argv[2], out = argv[3];
    fs::create_directories(out / "labels");
    std::vector<fs::path> scans;
    for (const auto& entry : fs::directory_iterator(recording / "velodyne")) {
        scans.push_back(entry.path());
    }
    std::sort(scans.begin(), scans.end());
    const std::vector<Eigen::Isometry3d> poses = read_poses(recording / "poses.txt");
    std::ofstream still(out / "static_map.bin", std::ios::binary);
    std::ofstream dynamic(out / "dynamic_points.bin", std::ios::binary);
    Voxels voxels;
    std::size_t points = 0, free = 0, asked = 0;
    Clock clock;
    for (std::size_t i = 0; i < scans.size(); ++i) {
        constexpr std::uint32_t kDynamic = 251;
        constexpr float kReach = 50.0F;  // [m] of questions
        const std::string name = scans[i].stem().string() + ".label";
        const auto in_sensor = read_all<Record>(scans[i]);
        const auto labels = read_all<std::uint32_t>(result / "labels" / name);
        clock.add("read");
        Records in_world, kept, removed;
        kept.reserve(in_sensor.size());
        in_world.reserve(in_sensor.size());
        for (std::size_t k = 0; k < in_sensor.size(); ++k) {
            const Record& p = in_sensor[k];
            const Eigen::Vector3d world =
                poses[i] * Eigen::Vector3f(p[0], p[1], p[2]).cast<double>();
            in_world.push_back({static_cast<float>(world.x()), static_cast<float>(world.y()),
                                static_cast<float>(world.z()), p[3]});
            (labels[k] == kDynamic ? removed : kept).push_back(in_world.back());
        }
        clock.add("transform");
        std::ofstream label_file(out / "labels" / name, std::ios::binary);
        write_all(label_file, labels);
        write_all(still, kept);
        write_all(dynamic, removed);
        clock.add("write");
        for (const Record& p : in_world) voxels.add(p);
        clock.add("voxels");
        Image image;
        for (const Record& p : in_sensor) image.add({p[0], p[1], p[2]});
        clock.add("image");
        const Eigen::Isometry3f to_sensor = poses[i].inverse().cast<float>();
        for (const Eigen::Vector3f& center : voxels.centers) {
            const Eigen::Vector3f p = to_sensor * center;
            if (p.squaredNorm() > kReach * kReach) continue;
            ++asked;
            free += image.is_free(p) ? 1 : 0;
        }
        clock.add("questions");
        points += in_sensor.size();
    }
    const auto per_scan = [&](double value) { return value / static_cast<double>(scans.size()); };
    std::string json =
        fmt::format("{{\"points\": {:.0f}, \"asked\": {:.0f}, \"free\": {:.0f}",
                    per_scan(static_cast<double>(points)), per_scan(static_cast<double>(asked)),
                    per_scan(static_cast<double>(free)));
    for (const auto& [part, ms] : clock.times) {
        json += fmt::format(", \"{}\": {:.3f}", part, per_scan(ms));
    }
    fmt::print("{}}}\n", json);
}
