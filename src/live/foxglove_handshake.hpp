// SPDX-License-Identifier: MIT
/// The HTTP request with which a client of FoxgloveServer opens its connection. It is judged here,
/// and libwebsockets only sees a request made from what was accepted: Debian's 4.1 can be made to
/// use freed memory by other requests (CVE-2025-11677).
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace dynamic_filter::live {

/// The names of the protocol; the messages that are used here are the same in both.
inline constexpr std::string_view kFoxgloveProtocols[] = {"foxglove.websocket.v1",
                                                          "foxglove.sdk.v1"};

/// The longest request that is read [bytes].
inline constexpr std::size_t kLongestHandshake = 16384;

/// The answer to a request.
struct Handshake {
    std::string request;  ///< for libwebsockets; empty if the request is refused
    std::string refusal;  ///< response to send before closing
    std::string origin;   ///< the web page, if it was refused because of it
};

/// True if programs (no origin), pages of this machine, Foxglove's and Lichtblick's applications,
/// or one of `more` sent the request. Any other web page could read what the sensors see.
bool is_allowed_origin(std::string_view origin, const std::vector<std::string>& more);

/// Judges a request: request line and headers, with the empty line at the end. Any bytes are taken.
Handshake judge_handshake(std::string_view head, const std::vector<std::string>& origins);

/// Refuses a request with a status of HTTP and a reason for the user.
Handshake refused(int status, std::string_view why);

}  // namespace dynamic_filter::live
