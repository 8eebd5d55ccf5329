// SPDX-License-Identifier: MIT
/// @file
/// Bags that other programs read: MCAP and SQLite as ROS 2 writes them, and ROS 1's .bag.
///
/// - Units: [ns] since the recorder's epoch.
/// - Shapes: messages are bytes, see messages.hpp.
/// - Ownership: topics and bytes are borrowed for the call.
/// - Threads: single caller.
/// - Errors: OutputError, and ConfigError from create(); nothing is left of a bag without commit().
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>

#include "dynamic_filter/io/bag.hpp"

namespace dynamic_filter::io {

/// A bag that appears whole with commit(), or not at all. The same calls give the same bytes.
/// Memory is that of a chunk (1 MiB, or one message) and an index. Single caller. All functions
/// throw OutputError.
class BagWriter {
public:
    /// By extension: .mcap (zstd), .db3, or .bag (lz4). Throws ConfigError for any other.
    static std::unique_ptr<BagWriter> create(const std::filesystem::path& path);
    /// Whether create() knows the extension, in any case.
    static bool recognises(const std::filesystem::path& path);

    BagWriter() = default;
    BagWriter(const BagWriter&) = delete;
    BagWriter& operator=(const BagWriter&) = delete;
    virtual ~BagWriter() = default;

    /// How messages must be packed: ROS 1's way for .bag, CDR for the others.
    [[nodiscard]] virtual MessageEncoding encoding() const = 0;

    /// A topic is announced when it is first used; its type must be one of those that
    /// dynamic_filter/io/messages.hpp makes. `time_ns` is when the message counts as recorded: not
    /// negative, in any order.
    virtual void write(const Topic& topic, std::int64_t time_ns,
                       std::span<const std::byte> data) = 0;

    /// The last call.
    virtual void commit() = 0;
};

}  // namespace dynamic_filter::io
