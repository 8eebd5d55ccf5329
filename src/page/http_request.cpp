// SPDX-License-Identifier: MIT
#include "page/http_request.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>

#include "page/http_text.hpp"

namespace dynamic_filter::app {

namespace {

int hex_digit(char c) {
    if (c >= '0' && c <= '9') return c - '0';
    const int letter = std::tolower(static_cast<unsigned char>(c));
    return letter >= 'a' && letter <= 'f' ? letter - 'a' + 10 : -1;
}

/// "%20" becomes a blank; what is no such escape stays.
std::string decoded(std::string_view text) {
    std::string result;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const int high = i + 2 < text.size() && text[i] == '%' ? hex_digit(text[i + 1]) : -1;
        const int low = high >= 0 ? hex_digit(text[i + 2]) : -1;
        result += low >= 0 ? static_cast<char>(16 * high + low) : text[i];
        if (low >= 0) i += 2;
    }
    return result;
}

bool is_here(std::string_view host, std::uint16_t port) {
    return host == fmt::format("127.0.0.1:{}", port) || host == fmt::format("localhost:{}", port);
}

}  // namespace

HttpRequest parse_request(std::string_view head) {
    HttpRequest request;
    std::string_view line = pop_until(head, "\r\n");
    const std::string_view method = pop_until(line, " ");
    std::string_view target = pop_until(line, " ");
    if (!line.starts_with("HTTP/1.") || !target.starts_with("/")) return request;
    request.method = method;
    request.path = decoded(pop_until(target, "?"));
    request.query = target;
    while (!head.empty()) {
        std::string_view value = pop_until(head, "\r\n");
        const std::string name = lower(pop_until(value, ":"));
        value = trimmed(value);
        if (name == "host") request.host = lower(value);
        if (name == "origin") request.origin = lower(value);
        if (name == "x-edit-token") request.token = value;
        if (name == "content-length") {
            const char* const end = value.data() + value.size();
            const auto [stop, error] = std::from_chars(value.data(), end, request.length);
            if (error != std::errc{} || stop != end) request.length = SIZE_MAX;
        }
        if (name == "transfer-encoding") request.length = SIZE_MAX;
        if (name == "transfer-encoding" || (name == "content-length" && value != "0")) {
            request.has_body = true;
        }
    }
    return request;
}

int refusal_of(const HttpRequest& request, std::uint16_t port, std::size_t body_bytes) {
    if (request.method.empty()) return 400;
    const bool posts = request.method == "POST" && body_bytes > 0;
    if (request.method != "GET" && request.method != "HEAD" && !posts) return 405;
    if (request.has_body && (!posts || request.length > body_bytes)) return 413;
    if (!is_here(request.host, port)) return 403;
    std::string_view origin = request.origin;
    if (origin.empty()) return 0;
    pop_until(origin, "://");
    return is_here(origin, port) ? 0 : 403;
}

const char* reason_of(int status) {
    switch (status) {
        case 200:
            return "OK";
        case 400:
            return "Bad Request";
        case 403:
            return "Forbidden";
        case 404:
            return "Not Found";
        case 405:
            return "Method Not Allowed";
        case 413:
            return "Content Too Large";
        case 409:
            return "Conflict";
        case 431:
            return "Request Header Fields Too Large";
        default:
            return "Error";
    }
}

}  // namespace dynamic_filter::app
