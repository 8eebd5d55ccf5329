// SPDX-License-Identifier: MIT
#include "page/http_server.hpp"

#include <fmt/format.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <list>
#include <optional>
#include <string_view>
#include <vector>

#include "dynamic_filter/error.hpp"
#include "page/listener.hpp"

namespace dynamic_filter::app {

namespace {

using Clock = std::chrono::steady_clock;

std::string head_of(const HttpAnswer& answer) {
    return fmt::format(
        "HTTP/1.1 {} {}\r\nContent-Type: {}\r\nContent-Length: {}\r\nConnection: close\r\n"
        "Cache-Control: no-store\r\nX-Content-Type-Options: nosniff\r\n"
        "Cross-Origin-Resource-Policy: same-origin\r\n\r\n",
        answer.status, reason_of(answer.status), answer.type,
        answer.body ? answer.body->size() : 0);
}

}  // namespace

/// Reads a request, then writes the answer.
struct HttpServer::Connection {
    int descriptor;
    const HttpLimits& limits;
    Clock::time_point deadline = Clock::now() + limits.to_ask;
    std::string request{}, head{};
    std::shared_ptr<const std::string> body{};
    std::size_t sent = 0;
    bool answering = false, over = false;

    void answer(const HttpAnswer& a, bool with_body) {
        head = head_of(a);
        body = with_body ? a.body : nullptr;
        answering = true;
        deadline = Clock::now() + limits.to_read;
    }

    void read(const HttpHandler& handler, std::uint16_t port) {
        std::array<char, 16384> bytes;
        const ssize_t n = recv(descriptor, bytes.data(), bytes.size(), 0);
        if (n < 0 && (errno == EAGAIN || errno == EINTR)) return;
        if (n <= 0) {
            over = true;
            return;
        }
        request.append(bytes.data(), static_cast<std::size_t>(n));
        const std::size_t end = request.find("\r\n\r\n");
        if (end == std::string::npos) {
            if (request.size() > limits.request_bytes) answer({431, "text/plain", {}}, false);
            return;
        }
        HttpRequest parsed = parse_request(std::string_view(request).substr(0, end + 2));
        const int refusal = refusal_of(parsed, port, limits.body_bytes);
        if (refusal != 0) return answer({refusal, "text/plain", {}}, false);
        if (request.size() - (end + 4) < parsed.length) return;  // the rest is under way
        parsed.body = request.substr(end + 4, parsed.length);
        answer(handler(parsed), parsed.method != "HEAD");
    }

    void write() {
        while (!over) {
            const bool in_head = sent < head.size();
            const std::size_t at = in_head ? sent : sent - head.size();
            const std::string_view left = in_head ? std::string_view(head).substr(at)
                                          : body  ? std::string_view(*body).substr(at)
                                                  : std::string_view();
            if (left.empty()) {
                shutdown(descriptor, SHUT_WR);
                over = true;
                return;
            }
            const ssize_t n = send(descriptor, left.data(), left.size(), MSG_NOSIGNAL);
            if (n < 0 && (errno == EAGAIN || errno == EINTR)) return;
            if (n <= 0)
                over = true;
            else
                sent += static_cast<std::size_t>(n);
        }
    }
};

HttpServer::HttpServer(std::uint16_t port, HttpHandler handler, HttpLimits limits)
    : handler_(std::move(handler)),
      limits_(limits),
      listener_(listen_at("127.0.0.1", port, "--port")),
      port_(port_of(listener_)) {
    if (pipe(wake_) != 0) {
        close(listener_);
        throw OutputError("pipe", std::strerror(errno));
    }
    thread_ = std::thread([this] { serve(); });
}

HttpServer::~HttpServer() {
    const char stop = 0;
    while (::write(wake_[1], &stop, 1) < 0 && errno == EINTR) {
    }
    thread_.join();
    for (const int descriptor : {listener_, wake_[0], wake_[1]}) close(descriptor);
}

std::string HttpServer::url() const { return fmt::format("http://127.0.0.1:{}/", port_); }

/// Whether one more may come: where all places are taken, one that has not asked yet gives way.
bool HttpServer::has_room(const std::list<Connection>& connections) const {
    return connections.size() < limits_.connections ||
           !std::ranges::all_of(connections, &Connection::answering);
}

/// So connections that say nothing keep nobody out. No more than that at a time, so that those
/// before them are read and answered in between.
void HttpServer::accept_some(std::list<Connection>& connections) const {
    for (std::size_t i = 0; i < limits_.connections && has_room(connections); ++i) {
        const int descriptor = accept_at(listener_);
        if (descriptor < 0) return;
        if (connections.size() >= limits_.connections) {
            const auto oldest = std::ranges::find(connections, false, &Connection::answering);
            close(oldest->descriptor);
            connections.erase(oldest);
        }
        connections.push_back({.descriptor = descriptor, .limits = limits_});
        // What asks at once is not silent when others come.
        connections.back().read(handler_, port_);
    }
}

void HttpServer::serve() {
    std::list<Connection> connections;
    std::vector<pollfd> polled;
    while (true) {
        polled = {{wake_[0], POLLIN, 0}, {has_room(connections) ? listener_ : -1, POLLIN, 0}};
        for (const Connection& c : connections) {
            polled.push_back({c.descriptor, static_cast<short>(c.answering ? POLLOUT : POLLIN), 0});
        }
        constexpr int kWaitMs = 100;  // so that deadlines are noticed
        poll(polled.data(), polled.size(), connections.empty() ? -1 : kWaitMs);
        if (polled[0].revents != 0) break;
        auto at = polled.begin() + 2;
        for (Connection& c : connections) {
            if (at++->revents != 0) {
                if (!c.answering) c.read(handler_, port_);
                if (c.answering) c.write();
            }
            if (Clock::now() > c.deadline) c.over = true;
        }
        for (auto c = connections.begin(); c != connections.end();) {
            if (c->over) close(c->descriptor);
            c = c->over ? connections.erase(c) : std::next(c);
        }
        if (polled[1].revents != 0) accept_some(connections);
    }
    for (const Connection& c : connections) close(c.descriptor);
}

}  // namespace dynamic_filter::app
