// SPDX-License-Identifier: MIT
/// What the tests of the bus of DDS have in common.
#pragma once

#include <arpa/inet.h>
#include <fcntl.h>
#include <sys/socket.h>
#include <unistd.h>

#include <chrono>
#include <functional>
#include <memory>
#include <mutex>
#include <span>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "live/bus.hpp"

namespace dynamic_filter::live {

/// Limits are generous, because the machine may be busy.
inline bool eventually(const std::function<bool()>& what, double seconds = 30.0) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(seconds);
    while (std::chrono::steady_clock::now() < end) {
        if (what()) return true;
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    return what();
}

/// A domain that no other test on this machine uses at the same time: its number is reserved by a
/// port of the domain that DDS does not use.
class ReservedDomain {
public:
    ReservedDomain() {
        constexpr int kFirst = 40, kEnd = 100, kPort = 5;  // below the ports for connections
        for (number_ = kFirst; number_ < kEnd; ++number_) {
            socket_ = socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
            sockaddr_in address{};
            address.sin_family = AF_INET;
            address.sin_port = htons(static_cast<std::uint16_t>(7400 + 250 * number_ + kPort));
            address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
            if (bind(socket_, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0) {
                return;
            }
            close(socket_);
        }
        throw std::runtime_error("no domain is free");
    }
    ReservedDomain(const ReservedDomain&) = delete;
    ReservedDomain& operator=(const ReservedDomain&) = delete;
    ~ReservedDomain() { close(socket_); }
    [[nodiscard]] int number() const { return number_; }

private:
    int number_ = 0, socket_ = -1;
};

/// Messages that a bus has delivered. Copies share them, so that a bus may outlive the test.
class Inbox {
public:
    Bus::Receive receive() {
        return [box = box_](const io::Topic&, const Bytes& message) {
            const std::lock_guard hold(box->lock);
            box->messages.push_back(message);
        };
    }
    [[nodiscard]] std::size_t size() const {
        const std::lock_guard hold(box_->lock);
        return box_->messages.size();
    }
    [[nodiscard]] std::vector<Bytes> messages() const {
        const std::lock_guard hold(box_->lock);
        return box_->messages;
    }

private:
    struct Box {
        std::mutex lock;
        std::vector<Bytes> messages;
    };
    std::shared_ptr<Box> box_ = std::make_shared<Box>();
};

inline std::uint64_t fnv1a(std::span<const std::byte> bytes) {
    std::uint64_t hash = 14695981039346656037U;
    for (const std::byte b : bytes) hash = (hash ^ static_cast<unsigned char>(b)) * 1099511628211U;
    return hash;
}

}  // namespace dynamic_filter::live
