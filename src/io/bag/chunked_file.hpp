// SPDX-License-Identifier: MIT
/// Where MCAP and ROS 1 bags agree: records, some of them chunks that hold records themselves.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

#include "io/bag/bag_file.hpp"
#include "io/bag/chunk_cache.hpp"
#include "io/input.hpp"

namespace dynamic_filter::io {

constexpr std::uint64_t kNoChunk = UINT64_MAX;

/// A message is found by the chunk it lies in, and its record's offset there; without a chunk, by
/// its record's offset in the file.
class ChunkedFile : public BagFile {
public:
    explicit ChunkedFile(const std::filesystem::path& path) : file_(path) {}
    [[nodiscard]] std::vector<std::byte> read(std::uint64_t chunk,
                                              std::uint64_t offset) const final;

protected:
    [[nodiscard]] const InputFile& file() const { return file_; }
    // These throw Malformed.
    /// The whole record, or as much of it as the file holds.
    [[nodiscard]] virtual std::vector<std::byte> record_at(std::uint64_t at) const = 0;
    /// The content of the chunk whose record is at that place.
    [[nodiscard]] virtual std::vector<std::byte> read_chunk(std::uint64_t at) const = 0;
    /// The data of the message whose record begins there.
    [[nodiscard]] virtual std::vector<std::byte> message_in(std::span<const std::byte> bytes,
                                                            std::uint64_t offset) const = 0;

private:
    InputFile file_;
    ChunkCache chunks_;
};

}  // namespace dynamic_filter::io
