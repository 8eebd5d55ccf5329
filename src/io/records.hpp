// SPDX-License-Identifier: MIT
/// From a file's records (text, rows or columns of bytes) to a Cloud.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "dynamic_filter/io/cloud.hpp"
#include "text.hpp"

namespace dynamic_filter::io {

/// One column of a file's record. Padding is in the file but not in the Cloud.
struct Column {
    std::string name;
    FieldType type = FieldType::f32;
    std::uint32_t count = 1;
    bool padding = false;
};

std::size_t column_bytes(const Column& column);
std::size_t record_bytes(const std::vector<Column>& columns);  ///< as in the file

/// A cloud with the columns' fields and no points. Throws InputError if x, y, z are missing, not
/// float, or if two fields share a name.
Cloud empty_cloud(const std::vector<Column>& columns, const std::filesystem::path& file);

/// One point a line, blank lines skipped. Throws InputError (line) for junk or a wrong number of
/// values, and for fewer than `points` lines.
void read_ascii(Cloud& cloud, const std::vector<Column>& columns, std::uint64_t points,
                Lines& lines);

/// Whole records from `offset`; `bytes` holds them all.
void take_rows(Cloud& cloud, const std::vector<Column>& columns, std::size_t points,
               std::vector<std::byte>&& bytes, std::size_t offset);

/// All points' first column, then all points' second, and so on; `block` holds them all.
void take_columns(Cloud& cloud, const std::vector<Column>& columns, std::size_t points,
                  std::span<const std::byte> block);

/// Turns the values of big-endian records round.
void swap_bytes(Cloud& cloud);

}  // namespace dynamic_filter::io
