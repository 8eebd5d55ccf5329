// SPDX-License-Identifier: MIT
#include "live/foxglove_handshake.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <map>

#include "page/http_text.hpp"

namespace dynamic_filter::live {
namespace {

// Foxglove and Lichtblick on the web, and their desktop applications, whose page is a file.
// "null" is not among them, because any page can have it by a sandboxed frame.
constexpr std::string_view kKnownOrigins[] = {"https://app.foxglove.dev",
                                              "https://studio.foxglove.dev",
                                              "https://lichtblick-suite.github.io", "file://"};
constexpr std::string_view kThisMachine[] = {"localhost", "127.0.0.1", "[::1]"};

using app::lower;
using app::pop_until;
using app::trimmed;
using Headers = std::map<std::string, std::string>;

/// Names in lower case; values of a repeated header are joined by commas, as HTTP says.
Headers headers_of(std::string_view head) {
    Headers headers;
    while (!head.empty()) {
        std::string_view line = pop_until(head, "\r\n");
        const std::string name = lower(pop_until(line, ":"));
        std::string& value = headers[name];
        value += (value.empty() ? "" : ",") + std::string(trimmed(line));
    }
    return headers;
}

std::vector<std::string> items_of(std::string_view list) {
    std::vector<std::string> items;
    while (!list.empty()) items.emplace_back(trimmed(pop_until(list, ",")));
    return items;
}

bool lists(const std::string& list, std::string_view item) {
    const auto items = items_of(list);
    return std::find(items.begin(), items.end(), item) != items.end();
}

/// 16 bytes in Base64.
bool is_key(std::string_view key) {
    return key.size() == 24 && key.ends_with("==") &&
           std::all_of(key.begin(), key.end() - 2, [](unsigned char c) {
               return std::isalnum(c) != 0 || c == '+' || c == '/';
           });
}

bool is_this_machine(std::string_view origin) {
    const std::string_view scheme = pop_until(origin, "://");
    if (scheme != "http" && scheme != "https") return false;
    return std::any_of(std::begin(kThisMachine), std::end(kThisMachine), [&](auto host) {
        if (!origin.starts_with(host)) return false;
        const std::string_view port = origin.substr(host.size());
        return port.empty() || (port.size() > 1 && port.front() == ':' &&
                                std::all_of(port.begin() + 1, port.end(),
                                            [](unsigned char c) { return std::isdigit(c) != 0; }));
    });
}

/// The first protocol of the client's list that is known here; empty if there is none.
std::string_view protocol_of(const std::string& list) {
    for (const std::string& item : items_of(list)) {
        for (const std::string_view known : kFoxgloveProtocols) {
            if (item == known) return known;
        }
    }
    return {};
}

std::string_view reason_of(int status) {
    return status == 400   ? "Bad Request"
           : status == 403 ? "Forbidden"
           : status == 426 ? "Upgrade Required"
           : status == 431 ? "Request Header Fields Too Large"
                           : "Service Unavailable";
}

}  // namespace

bool is_allowed_origin(std::string_view origin, const std::vector<std::string>& more) {
    const auto is_it = [&](std::string_view known) { return known == origin; };
    return origin.empty() || is_this_machine(origin) ||
           std::any_of(std::begin(kKnownOrigins), std::end(kKnownOrigins), is_it) ||
           std::any_of(more.begin(), more.end(), is_it);
}

Handshake refused(int status, std::string_view why) {
    std::string response = fmt::format(
        "HTTP/1.1 {} {}\r\nContent-Type: text/plain; charset=utf-8\r\nContent-Length: {}\r\n"
        "{}Connection: close\r\nX-Content-Type-Options: nosniff\r\n\r\n{}\n",
        status, reason_of(status), why.size() + 1,
        status == 426 ? "Upgrade: websocket\r\nSec-WebSocket-Version: 13\r\n" : "", why);
    return {.request = {}, .refusal = std::move(response), .origin = {}};
}

Handshake judge_handshake(std::string_view head, const std::vector<std::string>& origins) {
    std::string_view line = pop_until(head, "\r\n");
    const bool is_get = pop_until(line, " ") == "GET" && pop_until(line, " ").starts_with('/');
    if (!is_get || line != "HTTP/1.1") return refused(400, "expected GET / HTTP/1.1");
    Headers headers = headers_of(head);
    const std::string& origin = headers["origin"];
    if (!is_allowed_origin(origin, origins)) {
        Handshake stranger =
            refused(403, "pages of this origin may not connect; see foxglove.origins");
        stranger.origin = origin;
        return stranger;
    }
    if (!lists(lower(headers["connection"]), "upgrade") ||
        !lists(lower(headers["upgrade"]), "websocket") ||
        headers["sec-websocket-version"] != "13") {
        return refused(426,
                       "Here is a WebSocket for Foxglove: in it, choose \"Open connection\", "
                       "\"Foxglove WebSocket\", and this address with ws:// in front.");
    }
    const std::string& key = headers["sec-websocket-key"];
    if (!is_key(key)) return refused(400, "Sec-WebSocket-Key: expected 16 bytes in Base64");
    const std::string_view protocol = protocol_of(headers["sec-websocket-protocol"]);
    if (protocol.empty()) {
        return refused(400, fmt::format("Sec-WebSocket-Protocol: expected {}",
                                        fmt::join(kFoxgloveProtocols, " or ")));
    }
    return {.request = fmt::format(
                "GET / HTTP/1.1\r\nHost: localhost\r\nConnection: Upgrade\r\n"
                "Upgrade: websocket\r\nSec-WebSocket-Version: 13\r\nSec-WebSocket-Key: {}\r\n"
                "Sec-WebSocket-Protocol: {}\r\n\r\n",
                key, protocol),
            .refusal = {},
            .origin = {}};
}

}  // namespace dynamic_filter::live
