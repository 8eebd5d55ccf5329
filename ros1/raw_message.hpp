// SPDX-License-Identifier: MIT
/// A message of roscpp that is bytes of any type.
#pragma once

#include <ros/message_traits.h>
#include <ros/serialization.h>
#include <ros/subscription_callback_helper.h>

#include <cstring>
#include <functional>
#include <set>
#include <string>
#include <utility>

#include "live/bus.hpp"

namespace dynamic_filter::live {

struct RawMessage {
    Bytes bytes;
};

/// What the receiver of a topic expects.
struct Expected {
    io::Topic topic;
    std::string md5;   ///< MD5 sum of the type's definition; empty if it is not known here
    std::string node;  ///< this one, whose own messages are left out
};

/// Hands the bytes of messages on. Those of a publisher with another type are dropped, after one
/// `notice` about it. roscpp calls it for one message after the other.
class RawReceiver final : public ros::SubscriptionCallbackHelper {
public:
    RawReceiver(Expected expected, Bus::Receive receive,
                std::function<void(const std::string&)> notice)
        : expected_(std::move(expected)),
          receive_(std::move(receive)),
          notice_(std::move(notice)) {}

    ros::VoidConstPtr deserialize(
        const ros::SubscriptionCallbackHelperDeserializeParams& params) override;
    void call(ros::SubscriptionCallbackHelperCallParams& params) override;
    const std::type_info& getTypeInfo() override { return typeid(RawMessage); }
    bool isConst() override { return true; }
    bool hasHeader() override { return false; }

private:
    bool fits(const ros::M_string& publisher);

    Expected expected_;
    Bus::Receive receive_;
    std::function<void(const std::string&)> notice_;
    std::set<std::string> refused_;  // names of nodes
};

}  // namespace dynamic_filter::live

namespace ros::message_traits {

template <>
struct MD5Sum<dynamic_filter::live::RawMessage> {
    static const char* value() { return "*"; }
    static const char* value(const dynamic_filter::live::RawMessage&) { return "*"; }
};

template <>
struct DataType<dynamic_filter::live::RawMessage> {
    static const char* value() { return "*"; }
    static const char* value(const dynamic_filter::live::RawMessage&) { return "*"; }
};

}  // namespace ros::message_traits

namespace ros::serialization {

template <>
struct Serializer<dynamic_filter::live::RawMessage> {
    template <class Stream>
    static void write(Stream& stream, const dynamic_filter::live::RawMessage& message) {
        const std::uint32_t length = serializedLength(message);
        if (length > 0) std::memcpy(stream.advance(length), message.bytes->data(), length);
    }
    static std::uint32_t serializedLength(const dynamic_filter::live::RawMessage& message) {
        return static_cast<std::uint32_t>(message.bytes->size());
    }
};

}  // namespace ros::serialization
