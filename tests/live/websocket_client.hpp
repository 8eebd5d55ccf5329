// SPDX-License-Identifier: MIT
/// A WebSocket client for tests, which can also do what no client should.
#pragma once

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cstdint>
#include <optional>
#include <string>

namespace dynamic_filter::live {

/// A message from the server.
struct Frame {
    int kind = 0;  ///< 1: text, 2: bytes, 8: the connection ends
    std::string payload;
};

class WebSocketClient {
public:
    /// `receive_buffer` [bytes]: if not 0, the system keeps that little for the client.
    explicit WebSocketClient(std::uint16_t port, int receive_buffer = 0)
        : socket_(socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
        if (receive_buffer > 0) {
            setsockopt(socket_, SOL_SOCKET, SO_RCVBUF, &receive_buffer, sizeof receive_buffer);
        }
        const timeval patience{20, 0};
        setsockopt(socket_, SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof patience);
        setsockopt(socket_, SOL_SOCKET, SO_SNDTIMEO, &patience, sizeof patience);
        sockaddr_in address{};
        address.sin_family = AF_INET;
        address.sin_port = htons(port);
        address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
        is_open_ = connect(socket_, reinterpret_cast<sockaddr*>(&address), sizeof address) == 0;
    }
    WebSocketClient(const WebSocketClient&) = delete;
    WebSocketClient& operator=(const WebSocketClient&) = delete;
    ~WebSocketClient() { close(socket_); }

    /// A request for a connection. `more`: headers, each ended by CRLF.
    static std::string handshake(const std::string& more = "",
                                 const std::string& protocols = "foxglove.websocket.v1") {
        return "GET / HTTP/1.1\r\nHost: localhost\r\nConnection: keep-alive, Upgrade\r\n"
               "Upgrade: websocket\r\nSec-WebSocket-Version: 13\r\n"
               "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n"
               "Sec-WebSocket-Protocol: " +
               protocols + "\r\n" + more + "\r\n";
    }
    /// The head of the response to a request; empty if there is none.
    std::string ask(const std::string& request) {
        say(request);
        while (heard_.find("\r\n\r\n") == std::string::npos && hear()) {
        }
        const std::size_t end = heard_.find("\r\n\r\n");
        return end == std::string::npos ? "" : read(end + 4);
    }
    /// True if the server takes the connection.
    bool open(const std::string& more = "") {
        return ask(handshake(more)).starts_with("HTTP/1.1 101 ");
    }
    void say(const std::string& bytes) {
        is_open_ = is_open_ && ::send(socket_, bytes.data(), bytes.size(), MSG_NOSIGNAL) ==
                                   static_cast<ssize_t>(bytes.size());
    }
    /// One frame; `kind` as in the protocol, `length` is what it claims to have.
    void say_frame(int kind, const std::string& payload, bool is_last = true,
                   std::optional<std::uint64_t> length = {}) {
        const std::uint64_t size = length.value_or(payload.size());
        std::string bytes(1, static_cast<char>(kind | (is_last ? 0x80 : 0)));
        const int width = size < 126 ? 0 : size < 65536 ? 2 : 8;
        bytes += static_cast<char>(0x80U | (width == 0 ? size : width == 2 ? 126U : 127U));
        for (int i = width; i-- > 0;) bytes += static_cast<char>((size >> (8 * i)) & 0xFFU);
        say(bytes + std::string(4, '\0') + payload);  // a mask of zeros
    }
    void say_text(const std::string& text) { say_frame(1, text); }

    /// The next message; its kind is 0 if the connection is lost or nothing comes.
    Frame next() {
        Frame message;
        while (true) {
            if (!need(2)) return {};
            const unsigned first = byte(0), second = byte(1);
            const std::size_t width = second == 126 ? 2 : second == 127 ? 8 : 0;
            if (!need(2 + width)) return {};
            std::size_t size = width == 0 ? second : 0;
            for (std::size_t i = 0; i < width; ++i) size = size << 8U | byte(2 + i);
            if (!need(2 + width + size)) return {};
            read(2 + width);
            const int kind = static_cast<int>(first & 0x0FU);
            const std::string payload = read(size);
            if (kind == 9 || kind == 10) continue;
            if (kind != 0) message.kind = kind;
            message.payload += payload;
            if ((first & 0x80U) != 0) return message;
        }
    }
    /// All until the server closes or the connection is lost.
    void drain() {
        while (hear()) heard_.clear();
    }

private:
    [[nodiscard]] unsigned byte(std::size_t i) const {
        return static_cast<unsigned char>(heard_[taken_ + i]);
    }
    bool hear() {
        char bytes[65536];
        const ssize_t count = is_open_ ? recv(socket_, bytes, sizeof bytes, 0) : 0;
        if (count <= 0) return false;
        heard_.append(bytes, static_cast<std::size_t>(count));
        return true;
    }
    bool need(std::size_t size) {
        while (heard_.size() - taken_ < size) {
            if (!hear()) return false;
        }
        return true;
    }
    std::string read(std::size_t size) {
        std::string bytes = heard_.substr(taken_, size);
        taken_ += size;
        if (taken_ == heard_.size()) {
            heard_.clear();
            taken_ = 0;
        }
        return bytes;
    }

    int socket_;
    bool is_open_ = false;
    std::string heard_;
    std::size_t taken_ = 0;
};

}  // namespace dynamic_filter::live
