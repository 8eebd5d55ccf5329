// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace dynamic_filter::app {

/// The parts of a request that matter here. `method` empty: it is none.
struct HttpRequest {
    std::string method, path, query, host, origin;
    bool has_body = false;
};

/// Request line and headers, each ended by CRLF. Any bytes are taken.
HttpRequest parse_request(std::string_view head);

/// Status to refuse it with, 0 if it may be answered: only GET and HEAD without a body, from this
/// machine's own pages (another site's page could otherwise read along: Host and Origin are
/// checked).
int refusal_of(const HttpRequest& request, std::uint16_t port);

const char* reason_of(int status);

}  // namespace dynamic_filter::app
