// SPDX-License-Identifier: MIT
/// Sockets that listen, for the page's server and for that of Foxglove.
#pragma once

#include <cstdint>
#include <string>

namespace dynamic_filter::app {

/// "127.0.0.1:8765" or "[::1]:8765".
std::string address_text(const std::string& address, std::uint16_t port);

/// A socket that listens at an address, or at a port that is free if `port` is 0. Owned by the
/// caller. Throws OutputError; if the port is in use, its message names `option`, by which the user
/// chooses another one.
int listen_at(const std::string& address, std::uint16_t port, const std::string& option);

std::uint16_t port_of(int listener);

/// A client that waits at the listener, -1 if there is none. Owned by the caller. Reading and
/// writing do not wait.
int accept_at(int listener);

}  // namespace dynamic_filter::app
