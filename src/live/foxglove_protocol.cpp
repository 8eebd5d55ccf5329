// SPDX-License-Identifier: MIT
#include "live/foxglove_protocol.hpp"

#include <limits>
#include <nlohmann/json.hpp>
#include <optional>

#include "formats/messages/definitions.hpp"

namespace dynamic_filter::live {
namespace {

using nlohmann::json;

json described(const FoxgloveChannel& channel) {
    const io::Topic& topic = channel.topic;
    const bool ros1 = topic.encoding == io::MessageEncoding::ros1;
    return {{"id", channel.id},
            {"topic", topic.name},
            {"encoding", ros1 ? "ros1" : "cdr"},
            {"schemaName", ros1 ? topic.type : io::ros2_type(topic.type)},
            {"schemaEncoding", ros1 ? "ros1msg" : "ros2msg"},
            {"schema", io::full_definition(topic.type, topic.encoding)}};
}

/// A text of the client may contain anything.
std::string text_of(const json& message) {
    return message.dump(-1, ' ', false, json::error_handler_t::replace);
}

std::optional<std::uint32_t> id_of(const json& value) {
    if (!value.is_number_unsigned()) return {};
    const auto id = value.get<std::uint64_t>();
    if (id > std::numeric_limits<std::uint32_t>::max()) return {};
    return static_cast<std::uint32_t>(id);
}

/// A member of an object; null if there is none, or if it is no object.
const json& member(const json& object, const char* name) {
    static const json kNone;
    const auto found = object.find(name);
    return found == object.end() ? kNone : *found;
}

FoxgloveRequest wrong(const std::string& expected) {
    FoxgloveRequest request;
    request.wrong = "expected " + expected;
    return request;
}

FoxgloveRequest subscribe_of(const json& message) {
    const json& list = member(message, "subscriptions");
    FoxgloveRequest request;
    if (list.is_array()) {
        for (const json& entry : list) {
            const auto id = id_of(member(entry, "id")), channel = id_of(member(entry, "channelId"));
            if (!id || !channel) return wrong("id and channelId to be numbers");
            request.subscribe.emplace_back(*id, *channel);
        }
    }
    return list.is_array() ? request : wrong("subscriptions to be a list");
}

FoxgloveRequest unsubscribe_of(const json& message) {
    const json& list = member(message, "subscriptionIds");
    FoxgloveRequest request;
    if (list.is_array()) {
        for (const json& entry : list) {
            const auto id = id_of(entry);
            if (!id) return wrong("subscriptionIds to be numbers");
            request.unsubscribe.push_back(*id);
        }
    }
    return list.is_array() ? request : wrong("subscriptionIds to be a list");
}

void append(std::string& bytes, std::uint64_t value, std::size_t size) {
    for (std::size_t i = 0; i < size; ++i) bytes += static_cast<char>((value >> (8 * i)) & 0xFF);
}

}  // namespace

std::string server_info(const std::string& session) {
    return text_of({{"op", "serverInfo"},
                    {"name", "DynamicFilter"},
                    {"capabilities", json::array()},
                    {"supportedEncodings", json::array()},
                    {"metadata", {{"version", DYNAMIC_FILTER_VERSION}}},
                    {"sessionId", session}});
}

std::string advertisement(const std::vector<FoxgloveChannel>& channels) {
    json list = json::array();
    for (const FoxgloveChannel& channel : channels) list.push_back(described(channel));
    return text_of({{"op", "advertise"}, {"channels", std::move(list)}});
}

std::string status(FoxgloveLevel level, const std::string& message) {
    return text_of({{"op", "status"}, {"level", static_cast<int>(level)}, {"message", message}});
}

std::string message_head(std::uint32_t subscription, std::int64_t nanoseconds) {
    std::string head(1, '\x01');
    append(head, subscription, sizeof subscription);
    append(head, static_cast<std::uint64_t>(nanoseconds), sizeof nanoseconds);
    return head;
}

FoxgloveRequest parse_request(std::string_view text) {
    const json message = json::parse(text, nullptr, false);
    const json& op = member(message, "op");
    if (!op.is_string()) return wrong("a JSON object with op");
    const auto& name = op.get_ref<const std::string&>();
    if (name == "subscribe") return subscribe_of(message);
    if (name == "unsubscribe") return unsubscribe_of(message);
    constexpr std::size_t kShown = 40;  // characters of a name
    FoxgloveRequest request;
    request.unsupported = name.empty() ? "a nameless request" : name.substr(0, kShown);
    return request;
}

}  // namespace dynamic_filter::live
