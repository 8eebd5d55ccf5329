// SPDX-License-Identifier: MIT
/// @file
/// A point cloud as files hold it: packed records with named fields, nothing lost or converted.
///
/// - Units: the file's own, metres by custom.
/// - Frames: the file's own: the sensor's for scans, the world's for maps.
/// - Shapes: N records; arrays made of them are parallel to these.
/// - Ownership: values, copied; find() points into the cloud.
/// - Threads: plain data; const and free functions are thread-safe.
/// - Errors: InputError with the byte or line; Error where a field is missing.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "dynamic_filter/types.hpp"

namespace dynamic_filter::io {

/// Signed and unsigned integers and floats, by their bits.
enum class FieldType : std::uint8_t { i8, u8, i16, u16, i32, u32, i64, u64, f32, f64 };

std::size_t size_of(FieldType type);  ///< [bytes]

/// One of the things that each point has.
struct Field {
    std::string name;                 ///< "x", "intensity", ... as the file has it
    FieldType type = FieldType::f32;  ///< of each value
    std::uint32_t count = 1;          ///< values of this type per point
    std::uint32_t offset = 0;         ///< [bytes] from the start of the point's record
    bool operator==(const Field&) const = default;  ///< all four
};

/// `data` holds size() records of `point_bytes` bytes, little endian, without padding between
/// fields.
struct Cloud {
    std::vector<Field> fields;    ///< in the file's order
    std::size_t point_bytes = 0;  ///< [bytes] of a record
    std::vector<std::byte> data;  ///< the records
    std::optional<Pose>
        viewpoint;  ///< PCD's VIEWPOINT if the file gave one that is not the identity

    /// N.
    [[nodiscard]] std::size_t size() const {
        return point_bytes == 0 ? 0 : data.size() / point_bytes;
    }
    [[nodiscard]] const Field* find(const std::string& name) const;  ///< nullptr if absent
};

/// Adds a field behind the others. Only while the cloud has no records.
void add_field(Cloud& cloud, const std::string& name, FieldType type, std::uint32_t count = 1);

/// The first value of `field` in each record, in the file's unit, converted to double. Thread-safe.
std::vector<double> values(const Cloud& cloud, const Field& field);

/// x, y, z of each record as float (float64 is narrowed). Throws Error if a coordinate is missing.
Points positions(const Cloud& cloud);

/// How a PCD file holds its points.
enum class PcdData : std::uint8_t { ascii, binary, compressed };

/// Reads a cloud, of the kind that its extension says (see below). Fields keep their file order and
/// type. Lengths are in the file's unit, metres by custom. Thread-safe. Throws InputError with the
/// byte or line; allocates no more than the file's bytes justify.
Cloud read_cloud(const std::filesystem::path& file);

Cloud read_pcd(const std::filesystem::path& file);  ///< ascii, binary, binary_compressed
Cloud read_ply(const std::filesystem::path& file);  ///< ascii, little and big endian
Cloud read_bin(const std::filesystem::path& file);  ///< float32 x y z intensity (KITTI), and
                                                    ///< ring if it is a .pcd.bin (nuScenes)
/// LAS 1.0 to 1.4, all point formats, not compressed. x y z are float64 with scale and offset
/// applied; colours, time, angle and Extra Bytes are fields. Flags and waveforms are left out.
Cloud read_las(const std::filesystem::path& file);
/// NumPy's array of float32 or float64, N x k with k >= 3: x y z intensity c4 c5 ...
Cloud read_npy(const std::filesystem::path& file);
/// .xyz, .txt, .csv: a point a line, columns parted by blanks, commas or semicolons, named by the
/// first line if that is none of numbers; otherwise x y z intensity c4 c5 ... All are float64.
Cloud read_text_cloud(const std::filesystem::path& file);

}  // namespace dynamic_filter::io
