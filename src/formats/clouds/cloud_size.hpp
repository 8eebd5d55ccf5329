// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>

namespace dynamic_filter::io {

/// Throws InputError if the size of the file alone shows that it holds no cloud.
void refuse_bad_size(const std::filesystem::path& file);

}  // namespace dynamic_filter::io
