// SPDX-License-Identifier: MIT
/// Files of the work in progress: a magic number, a version, and checksums, so that a file of
/// another version, of another run, or a damaged one is never taken for good.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace dynamic_filter::app {

std::vector<std::byte> packed(std::span<const std::byte> bytes);  ///< by zlib, fast
/// Throws InputError that names `file` if the bytes are not `size` packed ones.
std::vector<std::byte> unpacked(std::span<const std::byte> bytes, std::size_t size,
                                const std::filesystem::path& file);

/// 64 bits as 16 hexadecimal digits, from all bytes of a text (FNV-1a).
std::string fingerprint(std::string_view text);

/// A file of one text: "MAGIC VERSION FINGERPRINT CRC SIZE\n", then the bytes.
void write_checked(const std::filesystem::path& file, std::string_view magic, std::string_view run,
                   std::span<const std::byte> bytes);
/// Throws InputError if it is damaged or of another kind or version, and ConfigError if it belongs
/// to another run.
std::vector<std::byte> read_checked(const std::filesystem::path& file, std::string_view magic,
                                    std::string_view run);

}  // namespace dynamic_filter::app
