// SPDX-License-Identifier: MIT
/// Lets other programs ask for the static map by a message, and tells them what came of it. Topics
/// work alike with ROS 1 and with every DDS of ROS 2, between which services do not.
#pragma once

#include <string>

#include "live/bus.hpp"
#include "live/map_saver.hpp"

namespace dynamic_filter::live {

/// The topics: a request is an empty message, an answer is JSON in a text, latched.
struct SaveTopics {
    io::Topic request, answer;
    SaveTopics(const std::string& prefix, io::MessageEncoding encoding);
};

/// {"saved": true, "file", "points", "bytes"}, or {"saved": false, "why"}.
std::string answer_text(const Saved& saved);

/// Both must outlive the object until the bus has stopped. `saver`: nullptr if no map is to be
/// saved; a request is then answered with the reason.
class SaveRequests {
public:
    SaveRequests(Bus& bus, const std::string& prefix, MapSaver* saver);
    /// Tells all who listen. Thread-safe.
    void answer(const Saved& saved);

private:
    Bus& bus_;
    SaveTopics topics_;
};

}  // namespace dynamic_filter::live
