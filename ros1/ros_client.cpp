// SPDX-License-Identifier: MIT
#include "ros1/ros_client.hpp"

#include <fmt/format.h>
#include <ros/network.h>
#include <xmlrpcpp/XmlRpcClient.h>
#include <xmlrpcpp/XmlRpcException.h>

#include <chrono>

#include "dynamic_filter/error.hpp"

namespace dynamic_filter::live {

namespace {

using XmlRpc::XmlRpcValue;

constexpr double kLongestCall = 3.0;  // [s]

}  // namespace

class RosClient::Connection final : XmlRpc::XmlRpcClient {
public:
    using XmlRpcClient::XmlRpcClient;

    /// False if there is no answer, or a fault.
    bool call(const char* method, const XmlRpcValue& arguments, XmlRpcValue& result) {
        if (!executeNonBlock(method, arguments)) return false;
        _disp.work(kLongestCall);
        return executeCheckDone(result) && !isFault();
    }
};

RosClient::RosClient(const std::string& uri) {
    if (!ros::network::splitURI(uri, host_, port_)) {
        throw ConfigError(fmt::format(
            "ROS: '{}' is no address; expected one such as http://localhost:11311", uri));
    }
}

RosClient::~RosClient() = default;

std::optional<RosReply> RosClient::call(const std::string& method,
                                        const std::vector<XmlRpcValue>& arguments) {
    const auto answer = call_any(method, arguments);
    if (!answer) return std::nullopt;
    const auto reply = list_of(*answer);  // code, message, value; code 1 is success
    if (reply.size() != 3 || reply[0].getType() != XmlRpcValue::TypeInt) return std::nullopt;
    return RosReply{static_cast<const int&>(reply[0]) == 1, reply[2]};
}

std::optional<XmlRpcValue> RosClient::call_any(const std::string& method,
                                               const std::vector<XmlRpcValue>& arguments) {
    XmlRpcValue list, answer;
    list.setSize(0);
    for (std::size_t i = 0; i < arguments.size(); ++i) list[static_cast<int>(i)] = arguments[i];
    const bool was_open = connection_ != nullptr;
    if (!was_open) {
        connection_ = std::make_unique<Connection>(host_.c_str(), static_cast<int>(port_), "/");
    }
    const auto start = std::chrono::steady_clock::now();
    try {
        if (connection_->call(method.c_str(), list, answer)) return answer;
    } catch (const XmlRpc::XmlRpcException&) {  // the answer is no XML-RPC
    }
    connection_.reset();
    // The other side may have closed the connection since the last call, or be a new process.
    const std::chrono::duration<double> waited = std::chrono::steady_clock::now() - start;
    return was_open && waited.count() < kLongestCall ? call_any(method, arguments) : std::nullopt;
}

std::vector<XmlRpcValue> list_of(const XmlRpcValue& value) {
    std::vector<XmlRpcValue> list;
    if (value.getType() != XmlRpcValue::TypeArray) return list;
    for (int i = 0; i < value.size(); ++i) list.push_back(value[i]);
    return list;
}

std::string text_of(const XmlRpcValue& value) {
    return value.getType() == XmlRpcValue::TypeString ? static_cast<const std::string&>(value) : "";
}

}  // namespace dynamic_filter::live
