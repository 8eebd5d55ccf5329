// SPDX-License-Identifier: MIT
/// Where a live filter gets its messages from, and where it sends them: ROS 1, or ROS 2 by DDS. A
/// message is the bytes of its encoding (see dynamic_filter/bag.hpp), so that the readers and
/// writers of bags serve the network, too.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "dynamic_filter/bag.hpp"
#include "live/service.hpp"

namespace dynamic_filter::live {

/// The bytes of a message; never changed once it is made, so threads may share it.
using Bytes = std::shared_ptr<const std::vector<std::byte>>;

/// How a topic is delivered.
struct Quality {
    bool reliable = true;   ///< lost packets are sent again
    bool latched = false;   ///< late subscribers get the last message ("transient local")
    std::size_t depth = 5;  ///< number of messages that are kept for a slow receiver

    bool operator==(const Quality&) const = default;
};

/// A topic that others publish.
struct SeenTopic {
    std::string name;            ///< such as "/points"
    std::string type;            ///< such as "sensor_msgs/PointCloud2"; without "/msg" of ROS 2
    std::size_t publishers = 0;  ///< number of publishers, without those of this process
    Quality offered;             ///< the least that all publishers offer
};

/// [s] The clock of this machine: the stamp of messages that belong to no scan.
inline double seconds_since_epoch() {
    return std::chrono::duration<double>(std::chrono::system_clock::now().time_since_epoch())
        .count();
}

/// Takes messages that the filter publishes. Thread-safe.
class Publisher {
public:
    Publisher() = default;
    Publisher(const Publisher&) = delete;
    Publisher& operator=(const Publisher&) = delete;
    virtual ~Publisher() = default;

    /// Announces a topic; the encoding is that of the bus. Throws Error if that is not possible.
    virtual void advertise(const io::Topic& topic, const Quality& quality) = 0;
    /// True if somebody receives the topic, so that its messages need to be made.
    [[nodiscard]] virtual bool is_wanted(const std::string& topic) const = 0;
    /// Sends a message of an advertised topic. Never waits for a receiver. False if the message
    /// was not taken, because a receiver is too slow for it. `stamp` [s] is that of the message.
    virtual bool publish(const std::string& topic, double stamp, const Bytes& message) = 0;
};

/// A bus of messages. Thread-safe.
class Bus : public Publisher {
public:
    /// Called in threads of the bus, one message of a topic after the other. Must not throw.
    using Receive = std::function<void(const io::Topic& topic, const Bytes& message)>;

    [[nodiscard]] virtual io::MessageEncoding encoding() const = 0;
    /// For messages to the user, such as "ROS 2, domain 0, on this machine only".
    [[nodiscard]] virtual std::string description() const = 0;
    /// What others publish now.
    [[nodiscard]] virtual std::vector<SeenTopic> seen() const = 0;
    /// Receives a topic. Replaces an earlier subscription of the same topic; that one may still be
    /// busy with a message when this returns.
    virtual void subscribe(const io::Topic& topic, const Quality& quality, Receive receive) = 0;
    /// Offers a service. `serve` is called in a thread of its own, one call after the other, so
    /// that it may take its time. Throws Error if that is not possible.
    virtual void serve(const std::string& name, const ServiceType& type, Serve serve) = 0;
    /// Ends all subscriptions and services: once it has returned, nothing is received any more.
    virtual void stop() = 0;
    /// Number of messages that were lost on their way to this process, as far as the bus knows.
    [[nodiscard]] virtual std::uint64_t lost() const = 0;
    /// Problems since the last call that the user should know of, such as a lost master.
    virtual std::vector<std::string> pop_notices() = 0;
    /// Values of the configuration that came with the bus or changed since the last call, such as
    /// {"map.rate", "0.5"} of ROS 1's parameter server.
    virtual std::vector<std::pair<std::string, std::string>> pop_parameters() = 0;
};

}  // namespace dynamic_filter::live
