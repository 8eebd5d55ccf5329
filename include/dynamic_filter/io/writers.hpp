// SPDX-License-Identifier: MIT
/// Writers of what a run and a simulation leave behind. All are atomic; all throw OutputError.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "dynamic_filter/io/cloud.hpp"
#include "dynamic_filter/io/file.hpp"
#include "dynamic_filter/types.hpp"

namespace dynamic_filter::io {

/// Streams records into one binary PCD whose point count is known only at the end.
/// `fields` are those of the clouds appended. Single caller.
class PcdWriter {
public:
    PcdWriter(const std::filesystem::path& path, const std::vector<Field>& fields,
              std::size_t point_bytes);
    void append(std::span<const std::byte> records);  ///< whole records
    void commit();
    [[nodiscard]] std::size_t size() const { return points_; }

private:
    AtomicFile file_;
    std::size_t point_bytes_, points_ = 0;
    std::size_t width_at_ = 0, points_at_ = 0;  // offsets of the counts in the header
};

void write_pcd(const std::filesystem::path& path, const Cloud& cloud);
/// float32 x y z intensity per point, as KITTI's velodyne/*.bin.
void write_bin(const std::filesystem::path& path, const Points& points,
               std::span<const float> intensity);
/// uint32 per point, as SemanticKITTI's labels/*.label.
void write_labels(const std::filesystem::path& path, const Labels& labels);
/// One row-major 3x4 matrix T_world_sensor a line, 17 significant digits where needed.
void write_poses_kitti(const std::filesystem::path& path, std::span<const Pose> T_world_sensor);
void write_times(const std::filesystem::path& path, std::span<const double> stamps);

}  // namespace dynamic_filter::io
