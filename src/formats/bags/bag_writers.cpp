// SPDX-License-Identifier: MIT
#include "formats/bags/bag_writers.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "base/text.hpp"
#include "dynamic_filter/error.hpp"
#include "formats/messages/definitions.hpp"

namespace dynamic_filter::io {

namespace {

using Create = std::unique_ptr<BagWriter> (*)(const std::filesystem::path&);

/// Returns nullptr if the extension is not that of a bag.
Create creator_for(const std::filesystem::path& path) {
    const std::string extension = to_lower(path.extension().string());
    if (extension == ".mcap") return create_mcap;
    if (extension == ".bag") return create_rosbag1;
    if (extension == ".db3") return create_rosbag2;
    return nullptr;
}

}  // namespace

bool BagWriter::recognises(const std::filesystem::path& path) {
    return creator_for(path) != nullptr;
}

std::unique_ptr<BagWriter> BagWriter::create(const std::filesystem::path& path) {
    if (const Create create = creator_for(path)) return create(path);
    throw ConfigError(path.string() + ": no kind of bag; expected .mcap, .bag or .db3");
}

std::pair<std::size_t, bool> TopicTable::number_of(const Topic& topic) {
    const auto found = std::find_if(topics_.begin(), topics_.end(),
                                    [&](const Topic& known) { return known.name == topic.name; });
    const auto number = static_cast<std::size_t>(found - topics_.begin());
    if (found != topics_.end()) {
        if (*found == topic) return {number, false};
        throw OutputError(file_, fmt::format("topic {} holds {} already, and cannot hold {}, too",
                                             topic.name, found->type, topic.type));
    }
    if (topic.encoding != encoding_) {
        throw OutputError(file_,
                          fmt::format("the messages of topic {} have the encoding of ROS {}; this "
                                      "kind of bag has the other one",
                                      topic.name, encoding_ == MessageEncoding::cdr ? 1 : 2));
    }
    if (find_definition(topic.type) == nullptr) {
        throw OutputError(file_, fmt::format("topic {}: the definition of {} is not known",
                                             topic.name, topic.type));
    }
    topics_.push_back(topic);
    return {number, true};
}

void check_time(const std::filesystem::path& file, std::int64_t time_ns) {
    if (time_ns >= 0) return;
    throw OutputError(file, fmt::format("a message of {} ns is from before 1970", time_ns));
}

bool is_latched(const Topic& topic) { return topic.name.ends_with("tf_static"); }

std::string offered_qos(const Topic& topic) {
    constexpr int kVolatile = 2, kTransientLocal = 1;
    constexpr std::string_view kForever = "\n    sec: 9223372036\n    nsec: 854775807\n";
    return fmt::format(
        "- history: 1\n  depth: 10\n  reliability: 1\n  durability: {}\n  deadline:{}"
        "  lifespan:{}  liveliness: 1\n  liveliness_lease_duration:{}"
        "  avoid_ros_namespace_conventions: false\n",
        is_latched(topic) ? kTransientLocal : kVolatile, kForever, kForever, kForever);
}

}  // namespace dynamic_filter::io
