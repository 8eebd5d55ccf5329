// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "dynamic_filter/cloud.hpp"

namespace dynamic_filter::io {

/// A value within the record of a point, and how it is read.
struct LasField {
    std::string name;
    FieldType stored = FieldType::u8;
    std::size_t at = 0;  ///< [bytes] from the start of the record
    FieldType type = FieldType::u8;
    double scale = 1.0, offset = 0.0;      ///< only if `type` differs from `stored`
    std::uint8_t first_bit = 0, bits = 8;  ///< bits of a u8
};

struct LasHeader {
    std::vector<LasField> fields;  ///< x, y, z are first
    std::size_t record_bytes = 0;
    std::size_t begin = 0;     ///< [bytes] offset of the first record
    std::uint64_t points = 0;  ///< as declared in the header
    std::string crs;           ///< WKT; empty: there is none
    bool gps_time_is_adjusted = false;
};

/// Reads the header. Throws InputError if the file is no LAS file, if its version or point format
/// is unknown, if it is compressed, or if it ends before the points. The points are not checked.
LasHeader parse_las_header(std::span<const std::byte> bytes, const std::filesystem::path& file);

}  // namespace dynamic_filter::io
