// SPDX-License-Identifier: MIT
/// @file
/// Writers of what a run and a simulation leave behind. All are atomic.
///
/// - Units: as given, metres by custom; stamps [s].
/// - Frames: as given; poses T_world_sensor.
/// - Shapes: a record a point, a line a pose.
/// - Ownership: what is written is borrowed for the call.
/// - Threads: a PcdWriter has a single caller; functions are thread-safe for files that differ.
/// - Errors: OutputError (also for an extension that write_cloud() does not know, a missing field,
///   arrays of unequal length); Error from PcdWriter::append() for a part of a record.
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
    /// Begins the file; records have `point_bytes` bytes.
    PcdWriter(const std::filesystem::path& path, const std::vector<Field>& fields,
              std::size_t point_bytes);
    void append(std::span<const std::byte> records);            ///< whole records
    void commit();                                              ///< completes it, the last call
    [[nodiscard]] std::size_t size() const { return points_; }  ///< points so far

private:
    AtomicFile file_;
    std::size_t point_bytes_, points_ = 0;
    std::size_t width_at_ = 0, points_at_ = 0;  // offsets of the counts in the header
};

/// `compressed` is for clouds of less than 4 GiB.
void write_pcd(const std::filesystem::path& path, const Cloud& cloud,
               PcdData data = PcdData::binary);

// The following return what the format could not hold, as a sentence for the user; empty if it held
// all. Fields with several values become one field each, "n_0", "n_1" and so on.

/// What came of a cloud.
struct Written {
    std::size_t points = 0;  ///< in the file
    std::string loss;        ///< what the format could not hold
};

/// By extension, in any case: .pcd (binary), .ply, .las, .npy, .bin, .xyz, .txt or .csv.
Written write_cloud(const std::filesystem::path& path, const Cloud& cloud);
bool can_write_cloud(const std::filesystem::path& path);  ///< by its extension
std::string cloud_kinds_written();                        ///< ".pcd, .ply, ..."
/// Binary little endian; 64-bit integers become doubles.
std::string write_ply(const std::filesystem::path& path, const Cloud& cloud);
/// LAS 1.4, point format 6: coordinates to 1 mm, other fields as Extra Bytes where the format has
/// no place of that name and type. Points that are not finite are left out.
Written write_las(const std::filesystem::path& path, const Cloud& cloud);
/// An array N x k, version 1.0, of x y z intensity and what else there is; float32 if that holds
/// all values, otherwise float64.
std::string write_npy(const std::filesystem::path& path, const Cloud& cloud);
/// The fields' names in the first line, then a point a line; parted by commas in a .csv, otherwise
/// by blanks. Every number reads back as it was.
std::string write_text_cloud(const std::filesystem::path& path, const Cloud& cloud);
/// float32 x y z intensity (0 if there is none).
std::string write_bin(const std::filesystem::path& path, const Cloud& cloud);
/// float32 x y z [m] intensity per point, as KITTI's velodyne/*.bin; `intensity` is parallel.
void write_bin(const std::filesystem::path& path, const Points& points,
               std::span<const float> intensity);
/// uint32 per point, as SemanticKITTI's labels/*.label. Who writes many into a folder is quicker
/// with Durable::contents, and one sync_folder() in the end.
void write_labels(const std::filesystem::path& path, const Labels& labels,
                  Durable durable = Durable::name);
/// One row-major 3x4 matrix T_world_sensor a line, 17 significant digits where needed.
void write_poses_kitti(const std::filesystem::path& path, std::span<const Pose> T_world_sensor);
/// t x y z qx qy qz qw a line; `stamps` [s] are parallel, to 1 ns.
void write_poses_tum(const std::filesystem::path& path, std::span<const double> stamps,
                     std::span<const Pose> T_world_sensor);
/// As EuRoC: a CSV of ns, x y z, qw qx qy qz; `stamps` [s] are parallel.
void write_poses_csv(const std::filesystem::path& path, std::span<const double> stamps,
                     std::span<const Pose> T_world_sensor);
/// A vertex each, numbered from 0; poses that are not finite are left out and keep their number.
void write_poses_g2o(const std::filesystem::path& path, std::span<const Pose> T_world_sensor);
/// Stamps [s], one a line.
void write_times(const std::filesystem::path& path, std::span<const double> stamps);

}  // namespace dynamic_filter::io
