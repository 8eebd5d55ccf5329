// SPDX-License-Identifier: MIT
#include "live/foxglove_handshake.hpp"

#include <gtest/gtest.h>

#include <random>

#include "live/websocket_client.hpp"

namespace dynamic_filter::live {
namespace foxglove_handshake_test {

std::string with(const std::string& from, const std::string& to) {
    std::string request = WebSocketClient::handshake("Origin: http://localhost:8080\r\n");
    const std::size_t at = request.find(from);
    return at == std::string::npos ? "" : request.replace(at, from.size(), to);
}

std::string status_of(const std::string& request) {
    const Handshake result = judge_handshake(request, {});
    EXPECT_NE(result.request.empty(), result.refusal.empty());
    return result.request.empty() ? result.refusal.substr(9, 3) : "101";
}

TEST(FoxgloveHandshake, ProgramsAndKnownPagesMayConnect) {
    const std::vector<std::string> more{"https://robot.example"};
    for (const char* origin :
         {"", "http://localhost", "https://localhost:8443", "http://127.0.0.1:3000",
          "http://[::1]:1", "https://app.foxglove.dev", "https://studio.foxglove.dev",
          "https://lichtblick-suite.github.io", "file://", "https://robot.example"}) {
        EXPECT_TRUE(is_allowed_origin(origin, more)) << origin;
    }
}

TEST(FoxgloveHandshake, OtherPagesMayNotConnect) {
    for (const char* origin :
         {"null", "https://evil.example", "http://localhost.evil.example",
          "http://localhost:80.evil.example", "http://localhost:", "http://localhost:8x",
          "http://127.0.0.10", "http://127.0.0.1.evil.example", "http://[::1]evil",
          "http://app.foxglove.dev", "https://app.foxglove.dev.evil.example",
          "https://app.foxglove.dev:444", "https://evilfoxglove.dev", "ftp://localhost",
          "localhost", "file:///etc", "https://robot.example", "http://localhost,https://evil"}) {
        EXPECT_FALSE(is_allowed_origin(origin, {})) << origin;
    }
}

TEST(FoxgloveHandshake, AnAcceptedRequestIsPassedOnInFewWords) {
    const Handshake result =
        judge_handshake(WebSocketClient::handshake("User-Agent: a\r\nCookie: b\r\n",
                                                   "x, foxglove.sdk.v1, "
                                                   "foxglove.websocket.v1"),
                        {});
    EXPECT_EQ(result.request,
              "GET / HTTP/1.1\r\nHost: localhost\r\nConnection: Upgrade\r\n"
              "Upgrade: websocket\r\nSec-WebSocket-Version: 13\r\n"
              "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n"
              "Sec-WebSocket-Protocol: foxglove.sdk.v1\r\n\r\n");
    EXPECT_EQ(result.refusal, "");
}

TEST(FoxgloveHandshake, WrongRequestsAreRefusedWithAReason) {
    EXPECT_EQ(status_of(with("GET", "GET")), "101");
    EXPECT_EQ(status_of(with("Connection", "CONNECTION")), "101");
    EXPECT_EQ(status_of(with("websocket", "WebSocket")), "101");
    EXPECT_EQ(status_of(with("GET", "POST")), "400");
    EXPECT_EQ(status_of(with("GET /", "CONNECT a:1")), "400");
    EXPECT_EQ(status_of(with("HTTP/1.1", "HTTP/2")), "400");
    EXPECT_EQ(status_of(with("localhost:8080", "evil.example")), "403");
    EXPECT_EQ(status_of(with("Upgrade: websocket", "Upgrade: h2c")), "426");
    EXPECT_EQ(status_of(with("Upgrade: websocket", "Upgrade: other")), "426");
    EXPECT_EQ(status_of(with("Upgrade: websocket\r\n", "")), "426");
    EXPECT_EQ(status_of(with("keep-alive, Upgrade", "keep-alive")), "426");
    EXPECT_EQ(status_of(with("Version: 13", "Version: 12")), "426");
    EXPECT_EQ(status_of(with("dGhlIHNhbXBsZSBub25jZQ==", "c2hvcnQ=")), "400");
    EXPECT_EQ(status_of(with("dGhlIHNhbXBsZSBub25jZQ==", "dGhlIHNhbXBsZSBub25j\"Q==")), "400");
    EXPECT_EQ(status_of(with("foxglove.websocket.v1", "foxglove.websocket.v2")), "400");
    EXPECT_EQ(status_of(with("Sec-WebSocket-Protocol: foxglove.websocket.v1\r\n", "")), "400");
    EXPECT_EQ(status_of(""), "400");
    EXPECT_EQ(status_of("GET / HTTP/1.1\r\n\r\n"), "426");
}

TEST(FoxgloveHandshake, TheRefusedOriginIsNamed) {
    EXPECT_EQ(judge_handshake(with("http://localhost:8080", "https://evil.example"), {}).origin,
              "https://evil.example");
    // Two origins are none that is allowed.
    const auto both =
        WebSocketClient::handshake("Origin: http://localhost\r\nOrigin: https://evil.example\r\n");
    EXPECT_EQ(judge_handshake(both, {}).origin, "http://localhost,https://evil.example");
    EXPECT_EQ(judge_handshake(with("GET", "PUT"), {}).origin, "");
}

TEST(FoxgloveHandshake, AnyBytesAreTaken) {
    std::mt19937 random(1);
    const std::string good = WebSocketClient::handshake("Origin: http://localhost\r\n");
    for (int i = 0; i < 20000; ++i) {
        std::string request = good;
        for (unsigned changes = 1 + random() % 8; changes-- > 0;) {
            request[random() % request.size()] = static_cast<char>(random());
        }
        if (i % 3 == 0) request.resize(random() % request.size());
        const Handshake result = judge_handshake(request, {});
        EXPECT_NE(result.request.empty(), result.refusal.empty());
    }
}

}  // namespace foxglove_handshake_test
}  // namespace dynamic_filter::live
