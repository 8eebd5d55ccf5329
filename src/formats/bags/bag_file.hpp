// SPDX-License-Identifier: MIT
/// The common interface of the three kinds of bag files.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "dynamic_filter/bag.hpp"

namespace dynamic_filter::io {

/// A message in a file. Each kind of file defines the meaning of `chunk` and `offset`.
struct FoundMessage {
    const Topic& topic;
    std::int64_t recorded_ns = 0;
    std::uint64_t chunk = 0, offset = 0;
    std::span<const std::byte> data;
};
using UseMessage = std::function<void(const FoundMessage&)>;

class BagFile {
public:
    BagFile() = default;
    BagFile(const BagFile&) = delete;
    BagFile& operator=(const BagFile&) = delete;
    virtual ~BagFile() = default;
    /// Calls `use` for every message. Returns what could not be read.
    virtual std::vector<Defect> for_each(const UseMessage& use) const = 0;
    [[nodiscard]] virtual std::vector<std::byte> read(std::uint64_t chunk,
                                                      std::uint64_t offset) const = 0;
};

std::unique_ptr<BagFile> open_mcap(const std::filesystem::path& file);
std::unique_ptr<BagFile> open_rosbag1(const std::filesystem::path& file);
std::unique_ptr<BagFile> open_rosbag2(const std::filesystem::path& file);

/// Normalizes a type: returns "sensor_msgs/PointCloud2" for "sensor_msgs/msg/PointCloud2" and for
/// the name of DDS.
std::string plain_type(const std::string& type);

}  // namespace dynamic_filter::io
