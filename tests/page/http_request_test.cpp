// SPDX-License-Identifier: MIT
#include "page/http_request.hpp"

#include <gtest/gtest.h>

#include <random>

namespace dynamic_filter::app {
namespace http_request_test {

constexpr std::uint16_t kPort = 8080;

std::string get(const std::string& target, const std::string& more = "") {
    return "GET " + target + " HTTP/1.1\r\nHost: 127.0.0.1:8080\r\n" + more;
}

TEST(HttpRequest, HasItsParts) {
    const HttpRequest r =
        parse_request(get("/live?after=7", "ORIGIN:  http://localhost:8080 \r\n"));
    EXPECT_EQ(r.method, "GET");
    EXPECT_EQ(r.path, "/live");
    EXPECT_EQ(r.query, "after=7");
    EXPECT_EQ(r.host, "127.0.0.1:8080");
    EXPECT_EQ(r.origin, "http://localhost:8080");
    EXPECT_EQ(refusal_of(r, kPort), 0);
}

TEST(HttpRequest, EscapesInPathsAreUndone) {
    EXPECT_EQ(parse_request(get("/my%20run%2Freport.html")).path, "/my run/report.html");
    EXPECT_EQ(parse_request(get("/100%")).path, "/100%");
    EXPECT_EQ(parse_request(get("/%zz%4")).path, "/%zz%4");
}

TEST(HttpRequest, WhatIsNotAskedFromHereIsRefused) {
    const auto status = [](const std::string& head) {
        return refusal_of(parse_request(head), kPort);
    };
    EXPECT_EQ(status("GET / HTTP/1.1\r\n"), 403);
    EXPECT_EQ(status("GET / HTTP/1.1\r\nHost: example.org:8080\r\n"), 403);
    EXPECT_EQ(status("GET / HTTP/1.1\r\nHost: 127.0.0.1:81\r\n"), 403);
    EXPECT_EQ(status(get("/", "Origin: http://example.org\r\n")), 403);
    EXPECT_EQ(status(get("/", "Origin: null\r\n")), 403);
    EXPECT_EQ(status(get("/", "Content-Length: 5\r\n")), 413);
    EXPECT_EQ(status(get("/", "Transfer-Encoding: chunked\r\n")), 413);
    EXPECT_EQ(status("POST / HTTP/1.1\r\nHost: 127.0.0.1:8080\r\n"), 405);
    EXPECT_EQ(status("GET http://127.0.0.1:8080/ HTTP/1.1\r\n"), 400);
    EXPECT_EQ(status("GET /\r\n"), 400);
    EXPECT_EQ(status(""), 400);
}

TEST(HttpRequest, ABodyIsTakenOnlyWhereThatIsWanted) {
    constexpr std::size_t kMost = 100;
    const auto status = [](const std::string& more) {
        const std::string head = "POST /edits HTTP/1.1\r\nHost: 127.0.0.1:8080\r\n" + more;
        return refusal_of(parse_request(head), kPort, kMost);
    };
    EXPECT_EQ(status("Content-Length: 100\r\nX-Edit-Token: abc\r\n"), 0);
    EXPECT_EQ(status("Content-Length: 101\r\n"), 413);
    EXPECT_EQ(status("Content-Length: -1\r\n"), 413);
    EXPECT_EQ(status("Content-Length: 99999999999999999999999\r\n"), 413);
    EXPECT_EQ(status("Transfer-Encoding: chunked\r\n"), 413);
    EXPECT_EQ(status("Content-Length: 5\r\nOrigin: http://example.org\r\n"), 403);
    EXPECT_EQ(status("Content-Length: 5\r\nOrigin: null\r\n"), 403);
    EXPECT_EQ(parse_request("POST / HTTP/1.1\r\nX-Edit-Token: abc \r\n").token, "abc");
}

TEST(HttpRequest, AnyBytesAreTaken) {
    std::mt19937 random(3);
    const std::string valid = get("/a%20b?x", "Origin: http://localhost:8080\r\n");
    for (int i = 0; i < 20000; ++i) {
        std::string bytes = valid.substr(0, random() % (valid.size() + 1));
        for (char& c : bytes) {
            if (random() % 16 == 0) c = static_cast<char>(random());
        }
        refusal_of(parse_request(bytes), kPort);
    }
}

}  // namespace http_request_test
}  // namespace dynamic_filter::app
