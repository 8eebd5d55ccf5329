// SPDX-License-Identifier: MIT
/// What waits to be sent to a client of FoxgloveServer.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <string>

#include "live/bus.hpp"

namespace dynamic_filter::live {

/// A message to a client: the bytes of `head`, then those of `body`.
struct Outgoing {
    std::string head;
    Bytes body;                      ///< null: `head` is a text
    std::uint32_t subscription = 0;  ///< if it has a body
};

/// Texts are sent before messages. Not thread-safe.
class FoxgloveQueue {
public:
    explicit FoxgloveQueue(std::size_t most_bytes) : most_bytes_(most_bytes) {}

    void put_text(std::string text) { texts_.push_back(std::move(text)); }
    /// Adds a message and drops older ones of the same subscription, so that at most `depth` of
    /// them wait, and at most `most_bytes` of all. False if other messages fill the queue. A
    /// message that alone is larger than the limit is taken if nothing else waits.
    bool put_message(Outgoing message, std::size_t depth);
    /// Drops the messages of a subscription.
    void forget(std::uint32_t subscription);
    void clear();

    /// The next to send; nothing if none waits.
    std::optional<Outgoing> pop();
    [[nodiscard]] bool empty() const { return texts_.empty() && messages_.empty(); }
    [[nodiscard]] std::size_t texts() const { return texts_.size(); }

private:
    void drop_oldest(std::uint32_t subscription);

    std::size_t most_bytes_, bytes_ = 0;  // of the bodies of messages_
    std::deque<std::string> texts_;
    std::deque<Outgoing> messages_;
};

}  // namespace dynamic_filter::live
