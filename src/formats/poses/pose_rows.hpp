// SPDX-License-Identifier: MIT
/// Rows of numbers without titles (KITTI, TUM, matrices), and what they share with rows that have
/// some.
#pragma once

#include <cstddef>
#include <string_view>
#include <vector>

#include "base/text.hpp"
#include "dynamic_filter/poses.hpp"

namespace dynamic_filter::io {

/// The rows of a pose file in the order of the file, which need not be that of time.
struct PoseRows {
    PoseFile file;
    std::size_t back = 0;  ///< first line whose stamp is before that of the row above; 0 if none is
};

/// Appends a stamp. Throws InputError at the current line if the stamp is not finite.
void append_stamp(PoseRows& rows, double stamp, const Lines& where);

/// Sorts the rows by time, and notes that. Throws InputError if the path gets longer by it, because
/// these are then several trajectories one after another.
PoseFile in_order(PoseRows rows, const std::filesystem::path& file);

/// The cells of a line, parted by commas if it has any, otherwise by blanks.
std::vector<std::string_view> cells_of(std::string_view line);

/// Throws InputError if a cell is no number.
std::vector<double> numbers_of(std::string_view line, const Lines& lines);

bool are_finite(const std::vector<double>& row);

/// Reads rows of as many numbers each: 12, 13, 16 or 17 (a matrix, also after a stamp or an index),
/// 8 (TUM), or 4 (a row of a 4x4 matrix). `titles`: the number of a line to pass over. Throws
/// InputError.
PoseRows read_pose_rows(Lines& lines, std::size_t titles = 0);

}  // namespace dynamic_filter::io
