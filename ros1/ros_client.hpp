// SPDX-License-Identifier: MIT
/// Calls of ROS 1's master and nodes that end in time, which those of roscpp do not.
#pragma once

#include <xmlrpcpp/XmlRpcValue.h>

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace dynamic_filter::live {

/// What a master or a node answered.
struct RosReply {
    bool is_ok = false;
    XmlRpc::XmlRpcValue value;
};

/// Keeps a connection between calls. Not thread-safe: one client for each thread.
class RosClient {
public:
    /// `uri`: such as "http://localhost:11311". Throws ConfigError if it has no port.
    explicit RosClient(const std::string& uri);
    RosClient(const RosClient&) = delete;
    RosClient& operator=(const RosClient&) = delete;
    ~RosClient();

    /// Empty if there is no answer within 3 s, or one that is none of ROS. Never throws.
    std::optional<RosReply> call(const std::string& method,
                                 const std::vector<XmlRpc::XmlRpcValue>& arguments);
    /// The same, whatever the answer is made of.
    std::optional<XmlRpc::XmlRpcValue> call_any(const std::string& method,
                                                const std::vector<XmlRpc::XmlRpcValue>& arguments);

private:
    class Connection;
    std::string host_;
    std::uint32_t port_ = 0;
    std::unique_ptr<Connection> connection_;
};

/// The elements of an array; empty for all else.
std::vector<XmlRpc::XmlRpcValue> list_of(const XmlRpc::XmlRpcValue& value);
/// A string; empty for all else.
std::string text_of(const XmlRpc::XmlRpcValue& value);

}  // namespace dynamic_filter::live
