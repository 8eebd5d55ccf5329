// SPDX-License-Identifier: MIT
#include "ros1/ros_node.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace dynamic_filter::live {

namespace {

using XmlRpc::XmlRpcValue;

/// The pairs of text in a list, such as topics with their types.
std::vector<std::pair<std::string, std::string>> pairs_of(const std::optional<RosReply>& reply) {
    std::vector<std::pair<std::string, std::string>> pairs;
    if (!reply || !reply->is_ok) return pairs;
    for (const XmlRpcValue& entry : list_of(reply->value)) {
        const auto pair = list_of(entry);
        if (pair.size() >= 2) pairs.emplace_back(text_of(pair[0]), text_of(pair[1]));
    }
    return pairs;
}

bool is_done(const std::optional<RosReply>& reply) { return reply && reply->is_ok; }

std::string value_text(const XmlRpcValue& value, bool in_list) {
    switch (value.getType()) {
        case XmlRpcValue::TypeBoolean:
            return static_cast<const bool&>(value) ? "true" : "false";
        case XmlRpcValue::TypeInt:
            return fmt::format("{}", static_cast<const int&>(value));
        case XmlRpcValue::TypeDouble:
            return fmt::format("{}", static_cast<const double&>(value));
        case XmlRpcValue::TypeString:
            return in_list ? fmt::format("\"{}\"", text_of(value)) : text_of(value);
        case XmlRpcValue::TypeArray: {
            std::string text;
            for (const XmlRpcValue& element : list_of(value)) {
                text += (text.empty() ? "" : ", ") + value_text(element, true);
            }
            return "[" + text + "]";
        }
        default:
            return "";
    }
}

void add_parameters(const XmlRpcValue& value, const std::string& prefix,
                    std::map<std::string, std::string>& parameters) {
    for (const auto& [key, member] : value) {
        if (member.getType() == XmlRpcValue::TypeStruct) {
            add_parameters(member, prefix + key + ".", parameters);
        } else {
            parameters[prefix + key] = value_text(member, false);
        }
    }
}

}  // namespace

std::vector<SeenTopic> topics_of_others(RosClient& master, const RosNode& node,
                                        const std::map<std::string, std::string>& remappings) {
    const auto state = master.call("getSystemState", {node.name});
    if (!is_done(state)) return {};
    const auto lists = list_of(state->value);
    if (lists.empty()) return {};
    std::map<std::string, std::string> types, own_names;
    for (const auto& [name, type] : pairs_of(master.call("getTopicTypes", {node.name}))) {
        types[name] = type;
    }
    for (const auto& [own, outside] : remappings) own_names[outside] = own;
    std::vector<SeenTopic> topics;
    for (const XmlRpcValue& entry : list_of(lists[0])) {
        const auto topic = list_of(entry);
        if (topic.size() < 2) continue;
        const auto nodes = list_of(topic[1]);
        const auto others =
            std::count_if(nodes.begin(), nodes.end(),
                          [&](const XmlRpcValue& other) { return text_of(other) != node.name; });
        const std::string name = text_of(topic[0]), type = types[name];
        if (others == 0 || type.find('/') == std::string::npos) continue;
        const auto renamed = own_names.find(name);
        // Whether they are latched is only known once they are connected, and matters nowhere.
        topics.push_back({.name = renamed == own_names.end() ? name : renamed->second,
                          .type = type,
                          .publishers = static_cast<std::size_t>(others),
                          .offered = {}});
    }
    std::sort(topics.begin(), topics.end(),
              [](const SeenTopic& a, const SeenTopic& b) { return a.name < b.name; });
    return topics;
}

bool register_anew(RosClient& master, const RosNode& node) {
    RosClient itself(node.uri);
    for (const auto& [topic, type] : pairs_of(itself.call("getPublications", {node.name}))) {
        if (!is_done(master.call("registerPublisher", {node.name, topic, type, node.uri}))) {
            return false;
        }
    }
    for (const auto& [topic, type] : pairs_of(itself.call("getSubscriptions", {node.name}))) {
        const auto reply = master.call("registerSubscriber", {node.name, topic, type, node.uri});
        if (!is_done(reply)) return false;
        // An empty list would end the connections to publishers that are not registered yet.
        if (list_of(reply->value).empty()) continue;
        itself.call("publisherUpdate", {node.name, topic, reply->value});
    }
    return true;
}

std::map<int, std::uint64_t> dropped_messages(RosClient& itself, const RosNode& node) {
    std::map<int, std::uint64_t> dropped;
    // roscpp answers with the value alone: of publications, subscriptions, services.
    const auto reply = itself.call_any("getBusStats", {node.name});
    const auto stats = list_of(reply.value_or(XmlRpcValue()));
    if (stats.size() < 2) return dropped;
    for (const XmlRpcValue& topic : list_of(stats[1])) {
        const auto connections = list_of(topic);  // name and connections
        if (connections.size() < 2) continue;
        for (const XmlRpcValue& entry : list_of(connections[1])) {
            const auto numbers = list_of(entry);  // connection, bytes, messages, dropped, 0
            const auto is_int = [](const XmlRpcValue& v) {
                return v.getType() == XmlRpcValue::TypeInt;
            };
            if (numbers.size() < 4 || !is_int(numbers[0]) || !is_int(numbers[3])) continue;
            dropped[static_cast<const int&>(numbers[0])] =
                static_cast<std::uint64_t>(static_cast<const int&>(numbers[3]));
        }
    }
    return dropped;
}

std::map<std::string, std::string> private_parameters(RosClient& master, const RosNode& node) {
    std::map<std::string, std::string> parameters;
    const auto reply = master.call("getParam", {node.name, node.name});
    if (is_done(reply) && reply->value.getType() == XmlRpcValue::TypeStruct) {
        add_parameters(reply->value, "", parameters);
    }
    return parameters;
}

}  // namespace dynamic_filter::live
