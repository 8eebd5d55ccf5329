// SPDX-License-Identifier: MIT
/// The common part of MCAP and ROS 1 bags: both consist of records, and some records are chunks
/// that contain records.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

#include "base/input.hpp"
#include "formats/bags/bag_file.hpp"
#include "formats/bags/chunk_cache.hpp"

namespace dynamic_filter::io {

constexpr std::uint64_t kNoChunk = UINT64_MAX;

/// A message is located by its chunk and by the offset of its record in the chunk. A message
/// outside of chunks is located by the offset of its record in the file.
class ChunkedFile : public BagFile {
public:
    explicit ChunkedFile(const std::filesystem::path& path) : file_(path) {}
    [[nodiscard]] std::vector<std::byte> read(std::uint64_t chunk,
                                              std::uint64_t offset) const final;

protected:
    [[nodiscard]] const InputFile& file() const { return file_; }
    // The following functions throw Malformed.
    /// The whole record, or the part of it that the file contains.
    [[nodiscard]] virtual std::vector<std::byte> record_at(std::uint64_t at) const = 0;
    /// Content of the chunk whose record begins at `at`.
    [[nodiscard]] virtual std::vector<std::byte> read_chunk(std::uint64_t at) const = 0;
    /// Data of the message whose record begins at this place.
    [[nodiscard]] virtual std::vector<std::byte> message_in(std::span<const std::byte> bytes,
                                                            std::uint64_t offset) const = 0;

private:
    InputFile file_;
    ChunkCache chunks_;
};

}  // namespace dynamic_filter::io
