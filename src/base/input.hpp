// SPDX-License-Identifier: MIT
/// Reads untrusted files. Only regular files are read, because a device or a pipe could be endless.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace dynamic_filter::io {

std::vector<std::byte> read_bytes(const std::filesystem::path& file);
/// Reads at most `most` bytes from the beginning of a file.
std::string read_head(const std::filesystem::path& file, std::size_t most);

/// The kind of a binary file according to its first bytes, such as "a ROS 1 bag"; empty if unknown
/// or text.
std::string kind_by_content(std::string_view head);

/// A regular file of which parts are read. Thread-safe.
class InputFile {
public:
    /// Throws InputError.
    explicit InputFile(std::filesystem::path path);
    InputFile(const InputFile&) = delete;
    InputFile& operator=(const InputFile&) = delete;
    ~InputFile();

    [[nodiscard]] const std::filesystem::path& path() const { return path_; }
    [[nodiscard]] std::uint64_t size() const { return size_; }
    /// Reads `count` bytes from `offset`. Throws InputError if the file is shorter.
    [[nodiscard]] std::vector<std::byte> read(std::uint64_t offset, std::uint64_t count) const;

private:
    std::filesystem::path path_;
    int descriptor_;
    std::uint64_t size_ = 0;
};

inline std::string_view as_text(std::span<const std::byte> bytes) {
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

}  // namespace dynamic_filter::io
