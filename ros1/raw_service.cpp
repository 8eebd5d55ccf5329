// SPDX-License-Identifier: MIT
#include "ros1/raw_service.hpp"

#include <cstring>
#include <span>
#include <vector>

namespace dynamic_filter::live {

namespace {

/// A flag, the length of the answer, and the answer.
ros::SerializedMessage response_of(const std::vector<std::byte>& answer) {
    io::ByteWriter out;
    out.number(std::uint8_t{1});
    out.block(answer);
    const boost::shared_array<std::uint8_t> buffer(new std::uint8_t[out.bytes.size()]);
    std::memcpy(buffer.get(), out.bytes.data(), out.bytes.size());
    return {buffer, out.bytes.size()};
}

}  // namespace

bool RawService::call(ros::ServiceCallbackHelperCallParams& params) {
    const ros::SerializedMessage& request = params.request;
    const auto before = static_cast<std::size_t>(request.message_start - request.buf.get());
    const std::span<const std::byte> bytes(
        reinterpret_cast<const std::byte*>(request.message_start), request.num_bytes - before);
    try {
        io::MessageReader in(bytes, io::MessageEncoding::ros1);
        io::MessageWriter out(io::MessageEncoding::ros1);
        serve_(in, out);
        params.response = response_of(out.moved_bytes());
        return true;
    } catch (const io::Malformed&) {
        return false;
    }
}

}  // namespace dynamic_filter::live
