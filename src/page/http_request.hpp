// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace dynamic_filter::app {

/// The parts of a request that matter here. `method` empty: it is none.
struct HttpRequest {
    std::string method, path, query, host, origin;
    std::string token;  ///< header X-Edit-Token
    bool has_body = false;
    std::size_t length = 0;  ///< [bytes] of the body, if it says so
    std::string body;        ///< where the server takes any
};

/// Request line and headers, each ended by CRLF. Any bytes are taken.
HttpRequest parse_request(std::string_view head);

/// Status to refuse it with, 0 if it may be answered: only GET and HEAD without a body, and POST
/// with one of up to `body_bytes` (0: no POST), from this machine's own pages (another site's page
/// could otherwise read along: Host and Origin are checked).
int refusal_of(const HttpRequest& request, std::uint16_t port, std::size_t body_bytes = 0);

const char* reason_of(int status);

}  // namespace dynamic_filter::app
