// SPDX-License-Identifier: MIT
/// Services of ROS 1 and 2: a request, and its answer.
#pragma once

#include <functional>
#include <string>
#include <string_view>

#include "formats/messages/message_reader.hpp"
#include "formats/messages/message_writer.hpp"

namespace dynamic_filter::live {

/// How both ROS name the type of a service.
struct ServiceType {
    std::string_view name;  ///< such as "std_srvs/Trigger"
    std::string_view md5;   ///< of the definition: ROS 1 compares types by it
};

/// The request is empty.
inline constexpr ServiceType kTrigger{"std_srvs/Trigger", "937c9679a518e3a18d831e57125ea522"};
/// The request is a bool.
inline constexpr ServiceType kSetBool{"std_srvs/SetBool", "09fb03525b03e7ea1fd3992bafd87e16"};
/// packaging/dynamicfilter_msgs: the request is a path and a format.
inline constexpr ServiceType kSaveMap{"dynamicfilter_msgs/SaveMap",
                                      "3c03fad76ac04a9b2648fc8f582ba959"};

/// Reads the request and writes the answer. Must not throw anything but io::Malformed.
using Serve = std::function<void(io::MessageReader& request, io::MessageWriter& answer)>;

/// The answer of Trigger and SetBool; that of SaveMap begins with it.
struct ServiceAnswer {
    bool success = false;
    std::string message;
};
inline void write(io::MessageWriter& out, const ServiceAnswer& answer) {
    out.number(static_cast<std::uint8_t>(answer.success ? 1 : 0));
    out.text(answer.message);
}
inline ServiceAnswer read_answer(io::MessageReader& in) {
    const bool success = in.number<std::uint8_t>() != 0;
    return {.success = success, .message = in.text()};
}

}  // namespace dynamic_filter::live
