// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <filesystem>

namespace dynamic_filter::io {

/// Throws InputError if the size of the file alone shows that it holds no cloud.
void refuse_bad_size(const std::filesystem::path& file);

/// Throws InputError if a .bin file of this size [bytes] is empty, or ends within a point.
void refuse_bad_bin_size(const std::filesystem::path& file, std::size_t bytes);

}  // namespace dynamic_filter::io
