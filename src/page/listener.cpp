// SPDX-License-Identifier: MIT
#include "page/listener.hpp"

#include <fmt/format.h>
#include <netdb.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <memory>

#include "dynamic_filter/error.hpp"

namespace dynamic_filter::app {
namespace {

struct FreeAddresses {
    void operator()(addrinfo* list) const { freeaddrinfo(list); }
};
using Addresses = std::unique_ptr<addrinfo, FreeAddresses>;

Addresses resolve(const std::string& address, std::uint16_t port) {
    addrinfo hints{}, *list = nullptr;
    hints.ai_socktype = SOCK_STREAM;
    hints.ai_flags = AI_PASSIVE | AI_NUMERICSERV;
    const int code = getaddrinfo(address.c_str(), std::to_string(port).c_str(), &hints, &list);
    if (code != 0) {
        throw OutputError(address_text(address, port),
                          fmt::format("cannot listen: {}; expected an address of this machine, "
                                      "such as 127.0.0.1, or 0.0.0.0 for all of them",
                                      gai_strerror(code)));
    }
    return Addresses(list);
}

std::string advice_for(int error, const std::string& option) {
    return error == EADDRINUSE ? "stop the program that listens there, or choose another " + option
           : error == EACCES   ? "choose a port above 1023"
                               : "choose an address of this machine, such as 127.0.0.1";
}

}  // namespace

std::string address_text(const std::string& address, std::uint16_t port) {
    const bool is_ipv6 = address.find(':') != std::string::npos;
    return is_ipv6 ? fmt::format("[{}]:{}", address, port) : fmt::format("{}:{}", address, port);
}

int listen_at(const std::string& address, std::uint16_t port, const std::string& option) {
    const Addresses found = resolve(address, port);
    const int listener =
        socket(found->ai_family, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, found->ai_protocol);
    const int yes = 1;
    setsockopt(listener, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
    if (bind(listener, found->ai_addr, found->ai_addrlen) != 0 ||
        listen(listener, SOMAXCONN) != 0) {
        const int error = errno;
        close(listener);
        throw OutputError(
            address_text(address, port),
            fmt::format("cannot listen: {}; {}", std::strerror(error), advice_for(error, option)));
    }
    return listener;
}

std::uint16_t port_of(int listener) {
    sockaddr_storage address{};
    socklen_t size = sizeof address;
    getsockname(listener, reinterpret_cast<sockaddr*>(&address), &size);
    return ntohs(address.ss_family == AF_INET6 ? reinterpret_cast<sockaddr_in6&>(address).sin6_port
                                               : reinterpret_cast<sockaddr_in&>(address).sin_port);
}

int accept_at(int listener) {
    return accept4(listener, nullptr, nullptr, SOCK_NONBLOCK | SOCK_CLOEXEC);
}

}  // namespace dynamic_filter::app
