// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "live/bus.hpp"
#include "live/dds_service.hpp"

namespace dynamic_filter::live {

struct DdsOptions {
    int domain = 0;  ///< ROS_DOMAIN_ID
    /// "localhost" (this machine, however its participants are configured), "all" (other machines,
    /// too, by the interface that Cyclone DDS prefers, as ROS 2 does by default), or the name of an
    /// interface, such as "eth0". Empty: as CYCLONEDDS_URI says, and "localhost" without it.
    std::string network;
};

/// ROS 2 without ROS: Cyclone DDS, with the names of topics and types that ROS 2 uses on the wire.
class DdsBus final : public Bus {
public:
    /// Throws Error if the domain cannot be joined, ConfigError if its number is wrong.
    explicit DdsBus(const DdsOptions& options);
    ~DdsBus() override;

    void advertise(const io::Topic& topic, const Quality& quality) override;
    [[nodiscard]] bool is_wanted(const std::string& topic) const override;
    bool publish(const std::string& topic, double stamp, const Bytes& message) override;

    [[nodiscard]] io::MessageEncoding encoding() const override { return io::MessageEncoding::cdr; }
    [[nodiscard]] std::string description() const override;
    [[nodiscard]] std::vector<SeenTopic> seen() const override;
    void subscribe(const io::Topic& topic, const Quality& quality, Receive receive) override;
    void serve(const std::string& name, const ServiceType& type, Serve serve) override;
    /// Calls a service of another program (see call_service()).
    Bytes call(const std::string& name, const ServiceType& type, const WriteRequest& write,
               const Patience& patience);
    void stop() override;
    [[nodiscard]] std::uint64_t lost() const override;
    std::vector<std::string> pop_notices() override;
    std::vector<std::pair<std::string, std::string>> pop_parameters() override { return {}; }

private:
    struct Engine;
    std::unique_ptr<Engine> engine_;
};

/// The names of ROS 2 on the wire: "/points" is "rt/points", and "sensor_msgs/PointCloud2" is
/// "sensor_msgs::msg::dds_::PointCloud2_".
std::string dds_topic_name(const std::string& topic);
std::string dds_type_name(const std::string& type);
/// The reverse; empty if the name is none of ROS 2's topics or messages.
std::string topic_of_dds(const std::string& name);
std::string type_of_dds(const std::string& name);

}  // namespace dynamic_filter::live
