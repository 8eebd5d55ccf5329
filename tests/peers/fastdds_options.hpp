// SPDX-License-Identifier: MIT
/// How a peer takes part, by arguments such as "reliable=0".
#pragma once

#include <fastdds/dds/domain/qos/DomainParticipantQos.hpp>
#include <fastdds/dds/publisher/qos/DataWriterQos.hpp>
#include <fastdds/dds/publisher/qos/PublisherQos.hpp>
#include <fastdds/dds/subscriber/qos/DataReaderQos.hpp>
#include <fastdds/dds/subscriber/qos/SubscriberQos.hpp>
#include <map>
#include <string>

namespace dynamic_filter::peers {

/// domain=N, network=default|loopback, loss=PERCENT (of all packets sent), topic=, type=,
/// reliable=0|1, latched=0|1, depth=N (0: all), partition=NAME, deadline=SECONDS, lease=SECONDS (of
/// liveliness by topic), xcdr2=0|1.
class Options {
public:
    Options(int count, char** arguments);

    [[nodiscard]] std::string text(const std::string& key, const std::string& otherwise = "") const;
    [[nodiscard]] double number(const std::string& key, double otherwise) const;

    [[nodiscard]] eprosima::fastdds::dds::DomainParticipantQos participant() const;
    [[nodiscard]] eprosima::fastdds::dds::PublisherQos publisher() const;
    [[nodiscard]] eprosima::fastdds::dds::SubscriberQos subscriber() const;
    [[nodiscard]] eprosima::fastdds::dds::DataWriterQos writer() const;
    [[nodiscard]] eprosima::fastdds::dds::DataReaderQos reader() const;

private:
    std::map<std::string, std::string> values_;
};

}  // namespace dynamic_filter::peers
