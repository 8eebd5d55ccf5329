// SPDX-License-Identifier: MIT
/// @file
/// A point cloud as files store it: packed records with named fields. Reading loses and converts
/// nothing.
///
/// - Units: those of the file, usually metres.
/// - Frames: those of the file: the sensor frame for scans, the world frame for maps.
/// - Shapes: N records; arrays made from them are parallel to the records.
/// - Ownership: values, copied; find() returns a pointer into the cloud.
/// - Threads: plain data; const members and free functions are thread-safe.
/// - Errors: InputError with the byte or the line; Error where a field is missing.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "dynamic_filter/types.hpp"

namespace dynamic_filter::io {

/// Signed and unsigned integers and floats; the number is the size in bits.
enum class FieldType : std::uint8_t { i8, u8, i16, u16, i32, u32, i64, u64, f32, f64 };

std::size_t size_of(FieldType type);  ///< [bytes] of one value

/// A field of each point.
struct Field {
    std::string name;                 ///< as in the file, such as "x" or "intensity"
    FieldType type = FieldType::f32;  ///< type of each value
    std::uint32_t count = 1;          ///< number of values per point
    std::uint32_t offset = 0;         ///< [bytes] from the start of the record of the point
    bool operator==(const Field&) const = default;  ///< compares all four members
};

/// A cloud. `data` holds size() records of `point_bytes` bytes each, little endian, without padding
/// between fields.
struct Cloud {
    std::vector<Field> fields;      ///< in the order of the file
    std::size_t point_bytes = 0;    ///< [bytes] of one record
    std::vector<std::byte> data;    ///< all records
    std::optional<Pose> viewpoint;  ///< VIEWPOINT of a PCD file, unless it is the identity
    /// Coordinate system of x y z as WKT, of a LAS file, or "EPSG:CODE" if it has GeoTIFF keys
    /// instead; empty: not known.
    std::string crs{};
    bool gps_time_is_adjusted = false;  ///< of a LAS file: gps_time counts from 1980, less 1e9 s

    /// Number of points N.
    [[nodiscard]] std::size_t size() const {
        return point_bytes == 0 ? 0 : data.size() / point_bytes;
    }
    /// Returns nullptr if there is no such field.
    [[nodiscard]] const Field* find(const std::string& name) const;
};

/// Adds a field after the existing ones. Only for a cloud without records.
void add_field(Cloud& cloud, const std::string& name, FieldType type, std::uint32_t count = 1);

/// The first value of `field` of each record, converted to double, in the file's unit.
/// Thread-safe.
std::vector<double> values(const Cloud& cloud, const Field& field);

/// Coordinates x, y, z of each record as float (float64 is rounded). Throws Error if one of the
/// fields is missing.
Points positions(const Cloud& cloud);

/// Storage of the points in a PCD file.
enum class PcdData : std::uint8_t { ascii, binary, compressed };

/// Reads a cloud; the extension selects one of the readers below. Fields keep the order and type of
/// the file. Lengths are in the unit of the file, usually metres. Throws InputError with the byte
/// or the line. The memory allocated is bounded by the size of the file. Thread-safe.
Cloud read_cloud(const std::filesystem::path& file);

Cloud read_pcd(const std::filesystem::path& file);  ///< ascii, binary and binary_compressed
Cloud read_ply(const std::filesystem::path& file);  ///< ascii, little endian and big endian
/// Type float32: x y z intensity (KITTI), with an additional ring for .pcd.bin (nuScenes).
Cloud read_bin(const std::filesystem::path& file);
/// LAS 1.0 to 1.4 with all point formats, but not compressed (LAZ). x, y, z are float64 after scale
/// and offset. Colors, time, angle and Extra Bytes become fields; flags and waveforms are left out.
Cloud read_las(const std::filesystem::path& file);
/// A NumPy array of float32 or float64, N x k with k >= 3; its columns are x y z intensity c4 c5
/// ...
Cloud read_npy(const std::filesystem::path& file);
/// .xyz, .txt or .csv with one point per line. Columns are separated by blanks, commas or
/// semicolons. The first line names the columns if it does not consist of numbers; otherwise the
/// names are x y z intensity c4 c5 ... All fields are float64.
Cloud read_text_cloud(const std::filesystem::path& file);

}  // namespace dynamic_filter::io
