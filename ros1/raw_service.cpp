// SPDX-License-Identifier: MIT
#include "ros1/raw_service.hpp"

#include <algorithm>
#include <vector>

#include "formats/messages/message_writer.hpp"

namespace dynamic_filter::live {

namespace {

/// A flag, the length of the answer, and the answer: whether it went well, and a text.
std::vector<std::byte> response_of(const ServiceAnswer& answer) {
    io::MessageWriter out(io::MessageEncoding::ros1);
    const std::size_t size = sizeof(std::uint8_t) + sizeof(std::uint32_t) + answer.message.size();
    out.number(std::uint8_t{1});
    out.number(static_cast<std::uint32_t>(size));
    out.number(static_cast<std::uint8_t>(answer.success ? 1 : 0));
    out.text(answer.message);
    return out.moved_bytes();
}

}  // namespace

ServiceType type_of(ServiceKind kind) {
    return kind == ServiceKind::trigger
               ? ServiceType{"std_srvs/Trigger", "937c9679a518e3a18d831e57125ea522"}
               : ServiceType{"std_srvs/SetBool", "09fb03525b03e7ea1fd3992bafd87e16"};
}

bool RawService::call(ros::ServiceCallbackHelperCallParams& params) {
    const ros::SerializedMessage& request = params.request;
    const auto* const begin = request.buf.get();
    const std::size_t size =
        request.num_bytes - static_cast<std::size_t>(request.message_start - begin);
    if (size != (kind_ == ServiceKind::set_bool ? 1 : 0)) return false;
    const bool value = size > 0 && *request.message_start != 0;
    const std::vector<std::byte> bytes = response_of(serve_(value));
    const boost::shared_array<std::uint8_t> buffer(new std::uint8_t[bytes.size()]);
    std::transform(bytes.begin(), bytes.end(), buffer.get(),
                   [](std::byte b) { return std::to_integer<std::uint8_t>(b); });
    params.response = ros::SerializedMessage(buffer, bytes.size());
    return true;
}

}  // namespace dynamic_filter::live
