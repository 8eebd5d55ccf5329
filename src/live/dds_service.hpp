// SPDX-License-Identifier: MIT
/// Services as ROS 2 sends them by Cyclone DDS (rmw_cyclonedds): a topic of requests and one of
/// answers, whose messages begin with the number of the client and that of its request. Clients of
/// other implementations put both in places that only they know.
#pragma once

#include <dds/dds.h>

#include <chrono>
#include <functional>
#include <string>
#include <thread>

#include "live/bus.hpp"

namespace dynamic_filter::live {

/// Answers the calls of a service in a thread of its own. Throws Error if it cannot be offered.
class DdsService {
public:
    DdsService(dds_entity_t participant, const std::string& name, const ServiceType& type,
               Serve serve);
    DdsService(const DdsService&) = delete;
    DdsService& operator=(const DdsService&) = delete;
    ~DdsService();
    /// Waits for the last call; nothing is answered any more. The participant must still be there.
    void stop();

private:
    void run();
    void answer(const Bytes& message);
    void wait_for_client() const;

    Serve serve_;
    dds_entity_t requests_ = 0, answers_ = 0, waitset_ = 0, stop_ = 0;
    std::thread thread_;
};

using WriteRequest = std::function<void(io::MessageWriter& request)>;

/// How long a client waits.
struct Patience {
    std::chrono::milliseconds for_service, for_answer;
};

/// Calls a service of another program. Returns its answer, which read_dds_answer() opens. Throws
/// Error if nobody offers the service, or no answer comes.
Bytes call_service(dds_entity_t participant, const std::string& name, const ServiceType& type,
                   const WriteRequest& write, const Patience& patience);
/// The answer behind what names the client.
io::MessageReader read_dds_answer(const Bytes& message);

}  // namespace dynamic_filter::live
