// SPDX-License-Identifier: MIT
/// Messages recorded on topics: MCAP files, ROS 1 bags (.bag) and ROS 2 bags (a folder of .db3 or
/// .mcap files, with or without metadata.yaml, or one such file).
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
enum class MessageEncoding : std::uint8_t { ros1, cdr };

struct Topic {
    std::string name;
    std::string type;  ///< "sensor_msgs/PointCloud2", without ROS 2's "/msg"
    MessageEncoding encoding = MessageEncoding::cdr;
    bool operator==(const Topic&) const = default;
};

/// Where a message is. Valid for the Bag that gave it.
struct MessageRef {
    std::size_t file = 0;
    std::uint64_t chunk = 0, offset = 0;
};

/// A message on the way through the bag; `data` is valid during the call only.
struct Message {
    const Topic& topic;
    std::int64_t recorded_ns = 0;  ///< when it was written, not what its header says
    MessageRef ref;
    std::span<const std::byte> data;
};

/// What is wrong with a bag.
struct Defect {
    std::string what;
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
    Bag(Bag&&) noexcept;
    ~Bag();

    /// Every message once, file after file, in the order in which they were written. One pass over
    /// all bytes; memory is that of a chunk. Returns what could not be read.
    std::vector<Defect> for_each(const std::function<void(const Message&)>& use) const;

    /// Throws InputError if it cannot be read any more. Thread-safe.
    [[nodiscard]] std::vector<std::byte> read(const MessageRef& message) const;

    [[nodiscard]] const std::vector<std::filesystem::path>& files() const { return paths_; }

private:
    std::vector<std::filesystem::path> paths_;
    std::vector<std::unique_ptr<BagFile>> files_;
};

}  // namespace dynamic_filter::io
