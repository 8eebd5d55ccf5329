// SPDX-License-Identifier: MIT
/// The messages of Foxglove's WebSocket protocol that FoxgloveServer uses.
/// Source: https://github.com/foxglove/ws-protocol/blob/main/docs/spec.md
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "dynamic_filter/bag.hpp"

namespace dynamic_filter::live {

/// What the server offers of a topic. All its messages have the encoding of the topic.
struct FoxgloveChannel {
    std::uint32_t id = 0;
    io::Topic topic;
};

/// The importance of a status.
enum class FoxgloveLevel { info = 0, warning = 1, error = 2 };

/// The first message of a connection. `session` differs for each run of the server.
std::string server_info(const std::string& session);
/// Tells of channels, with the definitions of their messages.
std::string advertisement(const std::vector<FoxgloveChannel>& channels);
/// Tells the client's user something.
std::string status(FoxgloveLevel level, const std::string& message);
/// What comes before the bytes of a message.
std::string message_head(std::uint32_t subscription, std::int64_t nanoseconds);

/// What a client asks for. At most one of the lists has entries.
struct FoxgloveRequest {
    std::vector<std::pair<std::uint32_t, std::uint32_t>>
        subscribe;                           ///< id of subscription, channel
    std::vector<std::uint32_t> unsubscribe;  ///< ids of subscriptions
    std::string unsupported;                 ///< the name of what the server does not do
    std::string wrong;  ///< what was expected, if the request cannot be understood
};

/// Any bytes are taken.
FoxgloveRequest parse_request(std::string_view text);

}  // namespace dynamic_filter::live
