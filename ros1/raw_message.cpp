// SPDX-License-Identifier: MIT
#include "ros1/raw_message.hpp"

#include <fmt/format.h>

namespace dynamic_filter::live {

namespace {

std::string field(const ros::M_string& header, const std::string& key) {
    const auto found = header.find(key);
    return found == header.end() ? "" : found->second;
}

}  // namespace

/// The subscription takes all types, because roscpp says nothing of a publisher that it refuses.
bool RawReceiver::fits(const ros::M_string& publisher) {
    const std::string node = field(publisher, "callerid");
    if (node == expected_.node) return false;
    const std::string type = field(publisher, "type"), md5 = field(publisher, "md5sum");
    if (type == expected_.topic.type && (expected_.md5.empty() || md5 == expected_.md5)) {
        return true;
    }
    if (refused_.insert(node).second) {
        notice_(
            fmt::format("{}: the messages of {} are left out: they are {} with MD5 sum {}, "
                        "expected {}{}",
                        expected_.topic.name, node, type, md5, expected_.topic.type,
                        expected_.md5.empty() ? "" : " with " + expected_.md5));
    }
    return false;
}

ros::VoidConstPtr RawReceiver::deserialize(
    const ros::SubscriptionCallbackHelperDeserializeParams& params) {
    if (!params.connection_header || !fits(*params.connection_header)) return {};
    const auto* const begin = reinterpret_cast<const std::byte*>(params.buffer);
    return boost::make_shared<const RawMessage>(
        RawMessage{std::make_shared<const std::vector<std::byte>>(begin, begin + params.length)});
}

void RawReceiver::call(ros::SubscriptionCallbackHelperCallParams& params) {
    const auto message = boost::static_pointer_cast<const RawMessage>(params.event.getMessage());
    receive_(expected_.topic, message->bytes);
}

}  // namespace dynamic_filter::live
