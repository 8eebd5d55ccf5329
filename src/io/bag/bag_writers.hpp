// SPDX-License-Identifier: MIT
/// What the three kinds of written bags have in common.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "dynamic_filter/io/bag_writer.hpp"

namespace dynamic_filter::io {

std::unique_ptr<BagWriter> create_mcap(const std::filesystem::path& file);
std::unique_ptr<BagWriter> create_rosbag1(const std::filesystem::path& file);
std::unique_ptr<BagWriter> create_rosbag2(const std::filesystem::path& file);

constexpr std::size_t kChunkBytes = std::size_t{1} << 20U;

/// Topics in the order of their first use.
class TopicTable {
public:
    TopicTable(std::filesystem::path file, MessageEncoding encoding)
        : file_(std::move(file)), encoding_(encoding) {}

    /// Its number, and if it is new. Throws OutputError if the bag cannot have it.
    std::pair<std::size_t, bool> number_of(const Topic& topic);
    [[nodiscard]] const std::vector<Topic>& all() const { return topics_; }

private:
    std::filesystem::path file_;
    MessageEncoding encoding_;
    std::vector<Topic> topics_;
};

/// Throws OutputError for a time before 1970.
void check_time(const std::filesystem::path& file, std::int64_t time_ns);

/// True for the topics whose messages hold until the next one, for those who listen later.
bool is_latched(const Topic& topic);

/// ROS 2's quality of service as its bags have it (YAML).
std::string offered_qos(const Topic& topic);

}  // namespace dynamic_filter::io
