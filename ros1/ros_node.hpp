// SPDX-License-Identifier: MIT
/// What a node of ROS 1 asks its master and itself.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "live/bus.hpp"
#include "ros1/ros_client.hpp"

namespace dynamic_filter::live {

struct RosNode {
    std::string name;  ///< such as "/dynamicfilter"
    std::string uri;   ///< of its own XML-RPC server
};

/// The topics that other nodes publish, as this node names them before remappings, sorted by name.
std::vector<SeenTopic> topics_of_others(RosClient& master, const RosNode& node,
                                        const std::map<std::string, std::string>& remappings);

/// Tells a new master all that the node publishes and subscribes to; roscpp does that only once.
/// Connections to publishers that the master does not know yet are kept. False if a call failed.
bool register_anew(RosClient& master, const RosNode& node);

/// Number of messages that were dropped because they came faster than they were taken, by the
/// number of the connection.
std::map<int, std::uint64_t> dropped_messages(RosClient& itself, const RosNode& node);

/// The private parameters of the node, such as {"map.rate", "0.5"} for ~map/rate. Texts are as they
/// are, lists as in TOML.
std::map<std::string, std::string> private_parameters(RosClient& master, const RosNode& node);

}  // namespace dynamic_filter::live
