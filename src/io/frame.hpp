// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <filesystem>

#include "dynamic_filter/io/sequence.hpp"

namespace dynamic_filter::io {

/// The point cloud of scan i without its pose. Throws InputError.
Cloud read_scan(const Sequence& sequence, std::size_t i);

/// Throws InputError if the size of the file alone shows that it holds no cloud.
void refuse_bad_size(const std::filesystem::path& file);

}  // namespace dynamic_filter::io
