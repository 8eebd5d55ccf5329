// SPDX-License-Identifier: MIT
/// @file
/// Writes bags that other programs can read: MCAP and SQLite as ROS 2 writes them, and .bag of ROS
/// 1.
///
/// - Units: [ns] since the epoch of the recorder.
/// - Shapes: messages are bytes, see messages.hpp.
/// - Ownership: topics and bytes are borrowed for the call.
/// - Threads: single caller.
/// - Errors: OutputError, and ConfigError from create(). Without commit(), no file is left.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>

#include "dynamic_filter/io/bag.hpp"

namespace dynamic_filter::io {

/// Writes a bag that appears complete with commit(), or not at all. The same calls give the same
/// bytes. Memory: one chunk (1 MiB, or one larger message) and an index. Single caller. All members
/// throw OutputError.
class BagWriter {
public:
    /// Chooses the format by the extension: .mcap (zstd), .db3, or .bag (lz4). Throws ConfigError
    /// for any other extension.
    static std::unique_ptr<BagWriter> create(const std::filesystem::path& path);
    /// True if create() knows the extension, in upper or lower case.
    static bool recognises(const std::filesystem::path& path);

    BagWriter() = default;
    BagWriter(const BagWriter&) = delete;
    BagWriter& operator=(const BagWriter&) = delete;
    virtual ~BagWriter() = default;

    /// The encoding that messages must have: `ros1` for .bag, `cdr` for the others.
    [[nodiscard]] virtual MessageEncoding encoding() const = 0;

    /// Writes a message. A topic is registered when it is first used; its type must be one of those
    /// that dynamic_filter/io/messages.hpp makes. `time_ns` is the time of recording: not negative,
    /// in any order.
    virtual void write(const Topic& topic, std::int64_t time_ns,
                       std::span<const std::byte> data) = 0;

    /// Completes the bag. Nothing can be written after it.
    virtual void commit() = 0;
};

}  // namespace dynamic_filter::io
