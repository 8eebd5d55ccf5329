// SPDX-License-Identifier: MIT
/// Small recordings on disk for tests.
#pragma once

#include "dynamic_filter/recording.hpp"
#include "dynamic_filter/writers.hpp"
#include "support/bytes.hpp"

namespace dynamic_filter::io {

class RecordingFiles : public testing::Test {
protected:
    static std::string number(std::size_t i) {
        const std::string digits = std::to_string(i);
        return std::string(6 - digits.size(), '0') + digits;
    }
    /// A row per scan: moving 1 m a scan along x.
    static std::string kitti_rows(std::size_t count) {
        std::string text;
        for (std::size_t i = 0; i < count; ++i) {
            text += "1 0 0 " + std::to_string(i) + " 0 1 0 0 0 0 1 0\n";
        }
        return text;
    }
    static std::string tum_rows(std::size_t count, double start = 0.0, double period = 0.2) {
        std::string text;
        for (std::size_t i = 0; i < count; ++i) {
            text += std::to_string(start + period * static_cast<double>(i)) + " " +
                    std::to_string(i) + " 0 0 0 0 0 1\n";
        }
        return text;
    }
    /// Two points a scan.
    void put_bins(const std::string& folder, std::size_t count) const {
        for (std::size_t i = 0; i < count; ++i) {
            data.put(folder + "/" + number(i) + ".bin", floats({1, 2, 3, 0.5F, 4, 5, 6, 0.5F}));
        }
    }
    void put_labels(std::size_t count, std::size_t points = 2) const {
        for (std::size_t i = 0; i < count; ++i) {
            std::string bytes = bytes_of(std::uint32_t{252U | 7U << 16U});
            for (std::size_t p = 1; p < points; ++p) bytes += bytes_of(std::uint32_t{40});
            data.put("labels/" + number(i) + ".label", bytes);
        }
    }
    /// A world-frame scan of two points, seen from x = `at`.
    void put_pcd(const std::string& name, double at, float intensity) const {
        Cloud cloud;
        for (const char* axis : {"x", "y", "z", "intensity"}) {
            add_field(cloud, axis, FieldType::f32);
        }
        const std::string bytes = floats({10, 0, 0, intensity, 0, 5, 0, 0});
        const auto raw = std::as_bytes(std::span(bytes));
        cloud.data.assign(raw.begin(), raw.end());
        cloud.viewpoint = Pose(Eigen::Translation3d(at, 0, 0));
        std::filesystem::create_directories((data / name).parent_path());
        write_pcd(data / name, cloud);
    }
    [[nodiscard]] Recording open(const OpenOptions& options = {}) const {
        return open_recording(data.path(), options);
    }
    [[nodiscard]] std::string open_error(const OpenOptions& options = {}) const {
        return error_of([&] { (void)open(options); });
    }
    static bool has_note(const Recording& recording, const std::string& part) {
        for (const std::string& note : recording.info().notes) {
            if (note.find(part) != std::string::npos) return true;
        }
        return false;
    }
    TemporaryFolder data;
};

}  // namespace dynamic_filter::io
