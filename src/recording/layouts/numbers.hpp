// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string_view>
#include <vector>

#include "base/text.hpp"
#include "dynamic_filter/types.hpp"

namespace dynamic_filter::io {

/// The numbers of `text`, a part of the current line, with blanks between them. Throws InputError.
std::vector<double> read_numbers(std::string_view text, const Lines& where);

/// Reads the 12 numbers of `text` as a rigid motion. A matrix with non-finite numbers becomes
/// lost_pose(). Throws InputError.
Pose read_pose_row(std::string_view text, const Lines& where);

/// Returns 12 for "0000000012.bin"; empty if the name is no number.
std::optional<std::size_t> index_of(const std::filesystem::path& scan);

}  // namespace dynamic_filter::io
