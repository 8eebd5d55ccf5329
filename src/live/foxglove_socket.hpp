// SPDX-License-Identifier: MIT
/// Sockets of FoxgloveServer.
#pragma once

#include <cstdint>
#include <string>

namespace dynamic_filter::live {

/// "127.0.0.1:8765" or "[::1]:8765".
std::string address_text(const std::string& address, std::uint16_t port);

/// A socket that listens at an address, or at a port that is free if `port` is 0. Owned by the
/// caller. Throws OutputError.
int listen_at(const std::string& address, std::uint16_t port);

std::uint16_t port_of(int listener);

/// A client that waits at the listener, -1 if there is none. Owned by the caller. Its connection
/// ends if it vanishes, and keeps little of what is sent in the system, where it gets old.
int accept_at(int listener);

}  // namespace dynamic_filter::live
