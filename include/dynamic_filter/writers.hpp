// SPDX-License-Identifier: MIT
/// @file
/// Writers of all output files of a run and of a simulation. All of them write atomically.
///
/// - Units: as given, usually metres; stamps [s].
/// - Frames: as given; poses T_world_sensor.
/// - Shapes: one record per point, one line per pose.
/// - Ownership: the data to write are borrowed for the call.
/// - Threads: a PcdWriter has a single caller; functions are thread-safe for different files.
/// - Errors: OutputError (also for an extension that write_cloud() does not know, for a missing
///   field, and for arrays of unequal length); Error from PcdWriter::append() for an incomplete
///   record.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "dynamic_filter/cloud.hpp"
#include "dynamic_filter/file.hpp"
#include "dynamic_filter/types.hpp"

namespace dynamic_filter::io {

/// Writes records one after the other into one binary PCD file; the number of points need not be
/// known before the end. `fields` are those of the appended clouds. Single caller.
class PcdWriter {
public:
    /// Begins the file; each record has `point_bytes` bytes.
    PcdWriter(const std::filesystem::path& path, const std::vector<Field>& fields,
              std::size_t point_bytes);
    void append(std::span<const std::byte> records);  ///< appends complete records
    void commit();  ///< completes the file; nothing can be appended after it
    [[nodiscard]] std::size_t size() const { return points_; }  ///< number of points so far

private:
    AtomicFile file_;
    std::size_t point_bytes_, points_ = 0;
    std::size_t width_at_ = 0, points_at_ = 0;  // byte offsets of the counts in the header
};

/// Writes a PCD file. `compressed` needs a cloud of less than 4 GiB.
void write_pcd(const std::filesystem::path& path, const Cloud& cloud,
               PcdData data = PcdData::binary);

// Each of the following functions returns a sentence for the user about what the format could not
// store; it is empty if everything was stored. A field with several values becomes several fields,
// "n_0", "n_1" and so on.

/// Result of writing a cloud.
struct Written {
    std::size_t points = 0;  ///< number of points in the file
    std::string loss;        ///< what the format could not store; empty if nothing
};

/// Writes a cloud in the format of the extension (upper or lower case): .pcd (binary), .ply, .las,
/// .npy, .bin, .xyz, .txt or .csv.
Written write_cloud(const std::filesystem::path& path, const Cloud& cloud);
/// True if write_cloud() knows the extension.
bool can_write_cloud(const std::filesystem::path& path);
std::string cloud_kinds_written();  ///< list of the extensions, for messages: ".pcd, .ply, ..."
/// Writes PLY, binary little endian. 64-bit integers become doubles.
std::string write_ply(const std::filesystem::path& path, const Cloud& cloud);
/// Writes LAS 1.4 with point format 6. Coordinates are rounded to 1 mm. Other fields become Extra
/// Bytes if the format has no place for that name and type. Points that are not finite are left
/// out.
Written write_las(const std::filesystem::path& path, const Cloud& cloud);
/// Writes a NumPy array (version 1.0) of N x k: x y z intensity and all other fields. The type is
/// float32 if it can represent all values, otherwise float64.
std::string write_npy(const std::filesystem::path& path, const Cloud& cloud);
/// Writes the names of the fields in the first line, then one point per line. Columns are separated
/// by commas in a .csv file, otherwise by blanks. Every number is read back exactly.
std::string write_text_cloud(const std::filesystem::path& path, const Cloud& cloud);
/// Writes float32 x y z intensity per point; intensity is 0 if the cloud has none.
std::string write_bin(const std::filesystem::path& path, const Cloud& cloud);
/// Writes float32 x y z [m] intensity per point, like KITTI's velodyne/*.bin; `intensity` is
/// parallel.
void write_bin(const std::filesystem::path& path, const Points& points,
               std::span<const float> intensity, Durable durable = Durable::name);
/// Writes one uint32 per point, like SemanticKITTI's labels/*.label. To write many files into a
/// folder, Durable::contents with one sync_folder() at the end is faster.
void write_labels(const std::filesystem::path& path, const Labels& labels,
                  Durable durable = Durable::name);
/// The same for raw values: the label in the lower 16 bits, the number of an object in the upper.
void write_numbered_labels(const std::filesystem::path& path, std::span<const std::uint32_t> labels,
                           Durable durable = Durable::name);
/// Writes one row-major 3x4 matrix T_world_sensor per line, with 17 significant digits where
/// needed.
void write_poses_kitti(const std::filesystem::path& path, std::span<const Pose> T_world_sensor);
/// Writes t x y z qx qy qz qw per line; `stamps` [s] are parallel, and rounded to 1 ns.
void write_poses_tum(const std::filesystem::path& path, std::span<const double> stamps,
                     std::span<const Pose> T_world_sensor);
/// Writes a CSV file like those of EuRoC: ns, x y z, qw qx qy qz; `stamps` [s] are parallel.
void write_poses_csv(const std::filesystem::path& path, std::span<const double> stamps,
                     std::span<const Pose> T_world_sensor);
/// Writes one vertex per pose, numbered from 0. Poses that are not finite are left out; their
/// number is not used again.
void write_poses_g2o(const std::filesystem::path& path, std::span<const Pose> T_world_sensor);
/// Writes stamps [s], one per line.
void write_times(const std::filesystem::path& path, std::span<const double> stamps);

}  // namespace dynamic_filter::io
