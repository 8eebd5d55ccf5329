// SPDX-License-Identifier: MIT
/// Bytes of untrusted files. Only regular files are read: a device or a pipe could be endless.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace dynamic_filter::io {

std::vector<std::byte> read_bytes(const std::filesystem::path& file);
/// At most `most` bytes from the beginning.
std::string read_head(const std::filesystem::path& file, std::size_t most);

inline std::string_view as_text(std::span<const std::byte> bytes) {
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

}  // namespace dynamic_filter::io
