// SPDX-License-Identifier: MIT
#include "peers/fastdds_options.hpp"

#include <stdexcept>

#include "peers/fastdds_version.hpp"

namespace dynamic_filter::peers {

namespace dds = eprosima::fastdds::dds;
namespace rtps = eprosima::fastdds::rtps;

namespace {

Duration duration(double seconds) { return Duration(static_cast<long double>(seconds)); }

/// What writers and readers have in common.
template <class Qos>
void set_qos(const Options& options, Qos& qos) {
    qos.reliability().kind = options.number("reliable", 1) != 0 ? dds::RELIABLE_RELIABILITY_QOS
                                                                : dds::BEST_EFFORT_RELIABILITY_QOS;
    qos.durability().kind = options.number("latched", 0) != 0 ? dds::TRANSIENT_LOCAL_DURABILITY_QOS
                                                              : dds::VOLATILE_DURABILITY_QOS;
    const int depth = static_cast<int>(options.number("depth", 10));
    qos.history().kind = depth == 0 ? dds::KEEP_ALL_HISTORY_QOS : dds::KEEP_LAST_HISTORY_QOS;
    if (depth > 0) qos.history().depth = depth;
    const double deadline = options.number("deadline", 0), lease = options.number("lease", 0);
    if (deadline > 0) qos.deadline().period = duration(deadline);
    if (lease > 0) {
        qos.liveliness().kind = dds::MANUAL_BY_TOPIC_LIVELINESS_QOS;
        qos.liveliness().lease_duration = duration(lease);
        qos.liveliness().announcement_period = duration(lease / 2);
    }
}

}  // namespace

Options::Options(int count, char** arguments) {
    for (int i = 2; i < count; ++i) {
        const std::string argument = arguments[i];
        const std::size_t equals = argument.find('=');
        if (equals == std::string::npos)
            throw std::runtime_error("expected key=value: " + argument);
        values_[argument.substr(0, equals)] = argument.substr(equals + 1);
    }
}

std::string Options::text(const std::string& key, const std::string& otherwise) const {
    const auto found = values_.find(key);
    return found == values_.end() ? otherwise : found->second;
}

double Options::number(const std::string& key, double otherwise) const {
    const auto found = values_.find(key);
    return found == values_.end() ? otherwise : std::stod(found->second);
}

dds::DomainParticipantQos Options::participant() const {
    dds::DomainParticipantQos qos = dds::PARTICIPANT_QOS_DEFAULT;
    if (text("network", "loopback") == "default") return qos;
    const auto configure = [&qos](const auto& transport) {
        transport->interfaceWhiteList = {"127.0.0.1"};
        qos.transport().use_builtin_transports = false;
        qos.transport().user_transports.push_back(transport);
    };
    const double loss = number("loss", 0);
    if (loss > 0) {
        auto lossy = std::make_shared<rtps::test_UDPv4TransportDescriptor>();
        lossy->percentageOfMessagesToDrop = static_cast<std::uint8_t>(loss);
        configure(lossy);
    } else {
        configure(std::make_shared<rtps::UDPv4TransportDescriptor>());
    }
    return qos;
}

dds::PublisherQos Options::publisher() const {
    dds::PublisherQos qos = dds::PUBLISHER_QOS_DEFAULT;
    if (const std::string name = text("partition"); !name.empty()) {
        qos.partition().push_back(name.c_str());
    }
    return qos;
}

dds::SubscriberQos Options::subscriber() const {
    dds::SubscriberQos qos = dds::SUBSCRIBER_QOS_DEFAULT;
    if (const std::string name = text("partition"); !name.empty()) {
        qos.partition().push_back(name.c_str());
    }
    return qos;
}

dds::DataWriterQos Options::writer() const {
    dds::DataWriterQos qos = dds::DATAWRITER_QOS_DEFAULT;
    set_qos(*this, qos);
    // As ROS 2 does, whose messages have no limit; a writer that keeps all waits for its readers.
    qos.publish_mode().kind = dds::SYNCHRONOUS_PUBLISH_MODE;
    qos.endpoint().history_memory_policy = kGrowing;
    constexpr double kPatience = 20;
    qos.reliability().max_blocking_time = duration(kPatience);
    if (number("xcdr2", 0) != 0) {
        qos.representation().m_value = {dds::XCDR2_DATA_REPRESENTATION};
    }
    return qos;
}

dds::DataReaderQos Options::reader() const {
    dds::DataReaderQos qos = dds::DATAREADER_QOS_DEFAULT;
    set_qos(*this, qos);
    qos.endpoint().history_memory_policy = kGrowing;
    return qos;
}

}  // namespace dynamic_filter::peers
