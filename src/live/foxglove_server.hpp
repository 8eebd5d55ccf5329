// SPDX-License-Identifier: MIT
/// A server of Foxglove's WebSocket protocol, with which Foxglove and Lichtblick show what the
/// filter publishes. Source: https://github.com/foxglove/ws-protocol, version foxglove.websocket.v1
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "live/bus.hpp"

namespace dynamic_filter::live {

struct FoxgloveOptions {
    std::string address = "127.0.0.1";  ///< on which the server listens
    std::uint16_t port = 8765;          ///< 0: any that is free
    /// Web pages, besides those of this machine and of Foxglove, whose scripts may connect.
    std::vector<std::string> origins;
    std::size_t clients = 16;                          ///< at most; more are refused
    std::size_t client_bytes = std::size_t{64} << 20;  ///< [bytes] that may wait for one client
};

/// Sends the messages of advertised topics to the clients that subscribed to them. Clients cannot
/// publish. A client that is too slow misses messages: of each topic, the newest wait for it, as
/// many as the topic's depth, and as many as fit into `client_bytes` together with those of other
/// topics. The last message of a latched topic is sent to new subscribers. One thread of its own.
/// Thread-safe.
class FoxgloveServer final : public Publisher {
public:
    /// `encoding` is that of all messages. Throws OutputError if it cannot listen.
    FoxgloveServer(io::MessageEncoding encoding, const FoxgloveOptions& options = {});
    ~FoxgloveServer() override;

    void advertise(const io::Topic& topic, const Quality& quality) override;
    [[nodiscard]] bool is_wanted(const std::string& topic) const override;
    bool publish(const std::string& topic, double stamp, const Bytes& message) override;

    [[nodiscard]] std::uint16_t port() const;
    [[nodiscard]] std::string url() const;  ///< such as "ws://127.0.0.1:8765"
    [[nodiscard]] std::size_t clients() const;
    /// Problems since the last call that the user should know of: web pages that were refused.
    std::vector<std::string> pop_notices();

private:
    struct Engine;
    std::unique_ptr<Engine> engine_;
};

}  // namespace dynamic_filter::live
