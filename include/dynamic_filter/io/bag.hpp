// SPDX-License-Identifier: MIT
/// @file
/// Messages recorded on topics: MCAP files, ROS 1 bags (.bag) and ROS 2 bags (a folder of .db3 or
/// .mcap files, with or without metadata.yaml, or one such file).
///
/// - Units: [ns] since the recorder's epoch, [bytes].
/// - Shapes: messages are bytes, see messages.hpp.
/// - Ownership: a Bag owns its open files; a Message borrows from it for the call.
/// - Threads: read() from any; the rest single caller.
/// - Errors: InputError; what is damaged, not all unreadable, is a Defect.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace dynamic_filter::io {

/// How a message's fields are packed: ROS 1's serialisation, or CDR as ROS 2 has it.
enum class MessageEncoding : std::uint8_t {
    ros1,  ///< little endian, unaligned
    cdr    ///< aligned, either order of bytes, with a header of 4 bytes
};

/// What messages are published on.
struct Topic {
    std::string name;  ///< "/points"
    std::string type;  ///< "sensor_msgs/PointCloud2", without ROS 2's "/msg"
    MessageEncoding encoding = MessageEncoding::cdr;  ///< of its messages
    bool operator==(const Topic&) const = default;    ///< all three
};

/// Where a message is. Valid for the Bag that gave it.
struct MessageRef {
    std::size_t file = 0;      ///< of Bag::files()
    std::uint64_t chunk = 0;   ///< [bytes] in the file, or a row
    std::uint64_t offset = 0;  ///< [bytes] in the chunk
};

/// A message on the way through the bag; `data` is valid during the call only.
struct Message {
    const Topic& topic;               ///< of the bag
    std::int64_t recorded_ns = 0;     ///< [ns] when it was written, not what its header says
    MessageRef ref;                   ///< to read() it again
    std::span<const std::byte> data;  ///< in the topic's encoding
};

/// What is wrong with a bag.
struct Defect {
    std::string what;  ///< one sentence, with the file and the byte
    bool lost = true;  ///< messages are missing; otherwise they may be, which nothing says
};

class BagFile;

/// Needs no index: what is readable of a truncated or damaged file is read, and the rest is noted.
class Bag {
public:
    /// True for what looks like a bag by its name: .mcap, .bag, .bag.active, .db3, or a folder with
    /// such files.
    static bool recognises(const std::filesystem::path& path);

    /// Throws InputError if it is no bag at all.
    explicit Bag(const std::filesystem::path& path);
    Bag(Bag&&) noexcept;  ///< the other one can only be destroyed
    ~Bag();

    /// Every message once, file after file, in the order in which they were written. One pass over
    /// all bytes; memory is that of a chunk. Returns what could not be read.
    std::vector<Defect> for_each(const std::function<void(const Message&)>& use) const;

    /// Throws InputError if it cannot be read any more. Thread-safe.
    [[nodiscard]] std::vector<std::byte> read(const MessageRef& message) const;

    /// In the order in which for_each() reads them.
    [[nodiscard]] const std::vector<std::filesystem::path>& files() const { return paths_; }

private:
    std::vector<std::filesystem::path> paths_;
    std::vector<std::unique_ptr<BagFile>> files_;
};

}  // namespace dynamic_filter::io
