// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <filesystem>
#include <string_view>

#include "base/text.hpp"
#include "formats/poses/pose_rows.hpp"

namespace dynamic_filter::io {

/// The line with the titles of the columns.
struct Titles {
    std::size_t line = 0;  ///< from 1; 0 if there is none
    bool are_read = true;  ///< false: they are those of a matrix, whose order is known without them
};

/// Looks at the first line of data, and at the comments before it, of which one may name as many
/// columns as the rows have.
Titles find_titles(std::string_view text, const std::filesystem::path& file);

/// Reads rows below the line `titles`, which names their columns (EuRoC, ERASOR, `rostopic echo -p`
/// and others). Throws InputError.
PoseRows read_pose_table(Lines& lines, std::size_t titles);

}  // namespace dynamic_filter::io
