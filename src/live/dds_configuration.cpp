// SPDX-License-Identifier: MIT
#include "live/dds_configuration.hpp"

#include <fmt/format.h>
#include <ifaddrs.h>
#include <net/if.h>
#include <sys/socket.h>

#include <algorithm>
#include <cctype>
#include <memory>

#include "dynamic_filter/error.hpp"

namespace dynamic_filter::live {

namespace {

// The ports of RTPS: those of a domain follow those of the one before.
constexpr int kFirstPort = 7400, kPortsOfDomain = 250, kLastPort = 65535;
constexpr int kFirstUnicast = 10, kPortsOfParticipant = 2;  // of participants, in a domain

bool is_name_of_interface(const std::string& name) {
    return !name.empty() && std::all_of(name.begin(), name.end(), [](unsigned char c) {
        return std::isalnum(c) != 0 || c == '-' || c == '_' || c == '.' || c == ':';
    });
}

/// True if there is an interface besides loopback.
bool has_network() {
    ifaddrs* first = nullptr;
    if (getifaddrs(&first) != 0) return false;
    const std::unique_ptr<ifaddrs, void (*)(ifaddrs*)> list(first, freeifaddrs);
    for (const ifaddrs* i = first; i != nullptr; i = i->ifa_next) {
        if (i->ifa_addr != nullptr && i->ifa_addr->sa_family == AF_INET &&
            (i->ifa_flags & IFF_UP) != 0 && (i->ifa_flags & IFF_LOOPBACK) == 0) {
            return true;
        }
    }
    return false;
}

// "localhost" means what ROS 2 means by it since Iron: what is sent to a group has TTL 0, so it
// does not leave this machine, and no group is received that other machines use. Participants that
// ROS 2 starts with its defaults are found all the same: Fast DDS and those limited to this machine
// at the ports of participants, Cyclone DDS, whose ports are arbitrary, by the group that it
// receives. They announce only the addresses of the network, so that its interface is needed
// besides loopback. Whoever is told the address of this machine can still reach it.
constexpr const char* kGeneralOfThisMachine =
    "<AllowMulticast>spdp</AllowMulticast><MulticastTimeToLive>0</MulticastTimeToLive>"
    // Nothing limits packets on this machine.
    "<MaxMessageSize>65500B</MaxMessageSize><FragmentSize>60000B</FragmentSize>";

std::string interfaces_of_this_machine() {
    return fmt::format(
        "<Interfaces><NetworkInterface name=\"lo\" multicast=\"true\"/>{}</Interfaces>",
        has_network() ? "<NetworkInterface autodetermine=\"true\"/>" : "");
}

std::string discovery_on_this_machine(int domain) {
    const int port = kFirstPort + kPortsOfDomain * domain;
    const int end = std::min(port + kPortsOfDomain, kLastPort);
    const int most = (end - port - kFirstUnicast) / kPortsOfParticipant - 1;
    return fmt::format(
        "<ParticipantIndex>auto</ParticipantIndex>"
        "<MaxAutoParticipantIndex>{}</MaxAutoParticipantIndex>"
        "<Peers><Peer address=\"127.0.0.1\"/><Peer address=\"239.255.0.1:{}\"/></Peers>"
        // Those who start later are looked for, because their group is not received.
        "<SPDPInterval>1s</SPDPInterval>"
        // An own group at own ports: sockets get all groups of their port that the machine
        // receives.
        "<SPDPMulticastAddress>239.255.77.77</SPDPMulticastAddress><Ports>"
        "<MulticastMetaOffset>2</MulticastMetaOffset><MulticastDataOffset>3</MulticastDataOffset>"
        "</Ports>",
        most, port);
}

}  // namespace

std::string dds_configuration(const std::string& network, int domain) {
    std::string general, discovery;
    if (network == "localhost") {
        general = kGeneralOfThisMachine + interfaces_of_this_machine();
        discovery = discovery_on_this_machine(domain);
    } else if (network == "all") {
        general = "<Interfaces><NetworkInterface autodetermine=\"true\"/></Interfaces>";
    } else if (is_name_of_interface(network)) {
        general = fmt::format("<Interfaces><NetworkInterface name=\"{}\"/></Interfaces>", network);
    } else {
        throw ConfigError(fmt::format(
            "bus.network is '{}'; expected localhost, all, or the name of an interface", network));
    }
    return fmt::format(
        "<CycloneDDS><Domain id=\"any\"><General>{}</General><Discovery>{}</Discovery><Internal>"
        "<SocketReceiveBufferSize max=\"10MB\"/></Internal></Domain></CycloneDDS>",
        general, discovery);
}

}  // namespace dynamic_filter::live
