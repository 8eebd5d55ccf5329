// SPDX-License-Identifier: MIT
/// Converts the records of a file (text, rows or columns of bytes) to a Cloud.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "base/text.hpp"
#include "dynamic_filter/cloud.hpp"

namespace dynamic_filter::io {

/// One column of the record of a file. Padding is in the file, but not in the Cloud.
struct Column {
    std::string name;
    FieldType type = FieldType::f32;
    std::uint32_t count = 1;
    bool padding = false;
};

std::size_t column_bytes(const Column& column);
std::size_t record_bytes(const std::vector<Column>& columns);  ///< as in the file, with padding

/// Names the columns "X", "Y", "Z" and "Intensity", in any letters, as all else expects them,
/// unless others have these names.
void name_in_small_letters(std::vector<Column>& columns);

/// Makes a cloud without points that has the fields of the columns. Throws InputError if x, y or z
/// is missing or not one number, or if two fields have the same name.
Cloud empty_cloud(const std::vector<Column>& columns, const std::filesystem::path& file);

/// Reads one point per line; blank lines are skipped. Throws InputError with the line for text that
/// is no number or a wrong number of values, and for fewer than `points` lines.
void read_ascii(Cloud& cloud, const std::vector<Column>& columns, std::uint64_t points,
                Lines& lines);

/// Reads whole records from `offset`; `bytes` must contain all of them.
void read_rows(Cloud& cloud, const std::vector<Column>& columns, std::size_t points,
               std::vector<std::byte>&& bytes, std::size_t offset);

/// Reads the first column of all points, then the second column of all points, and so on; `block`
/// must contain all of them.
void read_columns(Cloud& cloud, const std::vector<Column>& columns, std::size_t points,
                  std::span<const std::byte> block);

/// The same cloud, with coordinates that are integers as float64.
Cloud with_real_coordinates(Cloud cloud);

/// Reverses the byte order of all values, for big-endian files.
void swap_bytes(Cloud& cloud);

}  // namespace dynamic_filter::io
