// SPDX-License-Identifier: MIT
/// Code that the three bag writers share.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "dynamic_filter/bag.hpp"

namespace dynamic_filter::io {

std::unique_ptr<BagWriter> create_mcap(const std::filesystem::path& file);
std::unique_ptr<BagWriter> create_rosbag1(const std::filesystem::path& file);
std::unique_ptr<BagWriter> create_rosbag2(const std::filesystem::path& file);

constexpr std::size_t kChunkBytes = std::size_t{1} << 20U;

/// Numbers the topics in the order of their first use.
class TopicTable {
public:
    TopicTable(std::filesystem::path file, MessageEncoding encoding)
        : file_(std::move(file)), encoding_(encoding) {}

    /// Returns the number of the topic, and true if it is new. Throws OutputError if the bag cannot
    /// hold the topic.
    std::pair<std::size_t, bool> number_of(const Topic& topic);
    [[nodiscard]] const std::vector<Topic>& all() const { return topics_; }

private:
    std::filesystem::path file_;
    MessageEncoding encoding_;
    std::vector<Topic> topics_;
};

/// Throws OutputError for a time before 1970.
void check_time(const std::filesystem::path& file, std::int64_t time_ns);

/// True for latched topics: late subscribers get their last message, too.
bool is_latched(const Topic& topic);

/// The quality-of-service settings of ROS 2, in the YAML form that bags contain.
std::string offered_qos(const Topic& topic);

}  // namespace dynamic_filter::io
