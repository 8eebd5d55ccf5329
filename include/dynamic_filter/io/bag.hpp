// SPDX-License-Identifier: MIT
/// @file
/// Reads recorded messages from MCAP files, ROS 1 bags (.bag) and ROS 2 bags. A ROS 2 bag is a
/// folder of .db3 or .mcap files, with or without metadata.yaml, or one such file.
///
/// - Units: [ns] since the epoch of the recorder, [bytes].
/// - Shapes: messages are bytes, see messages.hpp.
/// - Ownership: a Bag owns its open files; a Message borrows from it for the call.
/// - Threads: read() may be called from any thread; all other members have a single caller.
/// - Errors: InputError if nothing can be read; damage to a part of a bag is returned as a Defect.
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

/// How the fields of a message are serialized: as in ROS 1, or as CDR in ROS 2.
enum class MessageEncoding : std::uint8_t {
    ros1,  ///< little endian, without alignment
    cdr    ///< with alignment, in either byte order, after a header of 4 bytes
};

/// A topic of a bag.
struct Topic {
    std::string name;  ///< such as "/points"
    std::string type;  ///< such as "sensor_msgs/PointCloud2"; without "/msg" of ROS 2
    MessageEncoding encoding = MessageEncoding::cdr;  ///< encoding of its messages
    bool operator==(const Topic&) const = default;    ///< compares all three members
};

/// The position of a message. Valid only for the Bag that returned it.
struct MessageRef {
    std::size_t file = 0;      ///< index into Bag::files()
    std::uint64_t chunk = 0;   ///< [bytes] from the start of the file, or the number of a row
    std::uint64_t offset = 0;  ///< [bytes] from the start of the chunk
};

/// A message of a bag; `data` is valid only during the call.
struct Message {
    const Topic& topic;  ///< topic of the bag
    /// [ns] when the recorder received it; its header may have another stamp.
    std::int64_t recorded_ns = 0;
    MessageRef ref;                   ///< position, for Bag::read()
    std::span<const std::byte> data;  ///< bytes in the encoding of the topic
};

/// A part of a bag that cannot be read.
struct Defect {
    std::string what;  ///< one sentence, with the file and the byte
    /// True: messages are missing. False: messages may be missing, but the file does not tell.
    bool lost = true;
};

class BagFile;

/// Reads bags without an index. From a truncated or damaged file, everything readable is read, and
/// the rest is reported.
class Bag {
public:
    /// True if the path looks like a bag: .mcap, .bag, .bag.active, .db3, or a folder with such
    /// files.
    static bool recognises(const std::filesystem::path& path);

    /// Throws InputError if the path is no bag.
    explicit Bag(const std::filesystem::path& path);
    Bag(Bag&&) noexcept;  ///< the moved-from object can only be destroyed
    ~Bag();

    /// Calls `use` once for every message, file after file, in the order in which they were
    /// written. Reads all bytes once; needs memory for one chunk. Returns what could not be read.
    std::vector<Defect> for_each(const std::function<void(const Message&)>& use) const;

    /// Reads one message again. Throws InputError if it cannot be read any more. Thread-safe.
    [[nodiscard]] std::vector<std::byte> read(const MessageRef& message) const;

    /// Files of the bag, in the order in which for_each() reads them.
    [[nodiscard]] const std::vector<std::filesystem::path>& files() const { return paths_; }

private:
    std::vector<std::filesystem::path> paths_;
    std::vector<std::unique_ptr<BagFile>> files_;
};

}  // namespace dynamic_filter::io
