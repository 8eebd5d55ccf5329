// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "live/bus.hpp"

namespace dynamic_filter::live {

/// ROS 1, by roscpp: messages as bytes of any type. Survives a master that goes and comes back:
/// topics are then registered anew. Values below the node's private parameters are parameters of
/// the configuration; the names that `watched` lists are followed while the node runs.
///
/// A publisher whose type is not the one of its subscription is a notice, and its messages are
/// dropped. When ROS ends the node (`rosnode kill`, or another node of its name), that is a notice,
/// and SIGTERM for this process; the bus goes on until it is destroyed. A process can have one bus
/// in its life, because roscpp cannot start twice.
class Ros1Bus final : public Bus {
public:
    /// Waits until there is a master, but not longer than `wait` [s]; throws Error then.
    /// `remappings`: as on roscpp's command line (names, "__name", "__ns", "__master"...). Throws
    /// ConfigError if one of them or ROS_MASTER_URI is wrong.
    Ros1Bus(const std::map<std::string, std::string>& remappings, std::vector<std::string> watched,
            double wait);
    ~Ros1Bus() override;

    void advertise(const io::Topic& topic, const Quality& quality) override;
    [[nodiscard]] bool is_wanted(const std::string& topic) const override;
    bool publish(const std::string& topic, double stamp, const Bytes& message) override;

    [[nodiscard]] io::MessageEncoding encoding() const override {
        return io::MessageEncoding::ros1;
    }
    [[nodiscard]] std::string description() const override;
    [[nodiscard]] std::vector<SeenTopic> seen() const override;
    void subscribe(const io::Topic& topic, const Quality& quality, Receive receive) override;
    void serve(const std::string& name, const ServiceType& type, Serve serve) override;
    void stop() override;
    [[nodiscard]] std::uint64_t lost() const override;
    std::vector<std::string> pop_notices() override;
    std::vector<std::pair<std::string, std::string>> pop_parameters() override;

private:
    struct Engine;
    std::unique_ptr<Engine> engine_;
};

}  // namespace dynamic_filter::live
