// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <list>
#include <memory>
#include <string>
#include <thread>

#include "page/http_request.hpp"

namespace dynamic_filter::app {

struct HttpAnswer {
    int status = 404;
    std::string type = "text/plain; charset=utf-8";
    std::shared_ptr<const std::string> body;  ///< shared, as many may ask for one report
};

/// Called in the server's thread.
using HttpHandler = std::function<HttpAnswer(const HttpRequest& request)>;

struct HttpLimits {
    std::size_t connections = 64, request_bytes = 8192;
    std::size_t body_bytes = 0;                              ///< of a POST; 0: none is taken
    std::chrono::milliseconds to_ask{5000}, to_read{60000};  ///< a client's time
};

/// What a viewer needs of HTTP, and nothing else: GET, HEAD and, where a body is allowed, POST on
/// 127.0.0.1, one request a connection, in one thread of its own. Not a library's server, because
/// those at hand give each client a thread, or accept connections without bound. Here all has
/// limits: where all connections are in use, a new one displaces the oldest one that has not asked
/// yet, or else waits in the kernel's queue. Requests that name another host or come from another
/// site's page are refused (403).
class HttpServer {
public:
    /// Port 0: any that is free. Throws OutputError if it cannot listen.
    HttpServer(std::uint16_t port, HttpHandler handler, HttpLimits limits = {});
    ~HttpServer();
    HttpServer(const HttpServer&) = delete;
    HttpServer& operator=(const HttpServer&) = delete;

    [[nodiscard]] std::uint16_t port() const { return port_; }
    [[nodiscard]] std::string url() const;

private:
    struct Connection;
    void serve();
    void accept_some(std::list<Connection>& connections) const;
    [[nodiscard]] bool has_room(const std::list<Connection>& connections) const;

    HttpHandler handler_;
    HttpLimits limits_;
    int listener_ = -1, wake_[2] = {-1, -1};
    std::uint16_t port_ = 0;
    std::thread thread_;  // the last: it uses the others
};

}  // namespace dynamic_filter::app
