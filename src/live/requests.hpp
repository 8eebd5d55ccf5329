// SPDX-License-Identifier: MIT
/// What other programs may ask of the filter, and the answers. Topics work alike with ROS 1 and
/// with every DDS of ROS 2; services of the same names are those of ROS 1, and of ROS 2 with
/// Cyclone DDS.
#pragma once

#include <atomic>
#include <condition_variable>
#include <mutex>
#include <string>

#include "live/bus.hpp"
#include "live/map_saver.hpp"

namespace dynamic_filter::live {

/// Below the prefix of the outputs. Answers are JSON in a text, latched.
struct RequestTopics {
    io::Topic save;     ///< empty message: the map goes to the file of --map
    io::Topic save_as;  ///< a text: it goes to a file of this name beside that file
    io::Topic saved;    ///< answer: {"saved": true, "file", "points", "bytes"}, or why not
    io::Topic reset;    ///< empty message: the next scan begins a new map
    io::Topic pause;    ///< a bool: scans are left out from now on, or judged again
    io::Topic state;    ///< answer: {"paused": false, "resets": 0}
    RequestTopics(const std::string& prefix, io::MessageEncoding encoding);
};

/// The text of the answer.
std::string answer_text(const Saved& saved);

/// Both must outlive the object until the bus has stopped. `saver`: nullptr if no map is to be
/// saved; a request is then answered with the reason. The getters are thread-safe.
class Requests {
public:
    Requests(Bus& bus, const std::string& prefix, MapSaver* saver);
    /// Tells all who listen. Thread-safe.
    void answer(const Saved& saved);
    /// Calls of services that wait for a map are answered at once from now on: call it before the
    /// bus stops.
    void end();

    [[nodiscard]] bool is_paused() const { return is_paused_; }
    /// True if a new map was asked for since the last call.
    bool pop_reset() { return is_reset_.exchange(false); }

private:
    void receive_messages(MapSaver* saver);
    void offer_services(MapSaver* saver);
    void ask_to_save(MapSaver* saver, const std::string& name);
    Saved save_now(MapSaver* saver, const std::string& name);
    void reset();
    void pause(bool is_paused);
    [[nodiscard]] std::string state_text() const;
    void tell_state();

    Bus& bus_;
    RequestTopics topics_;
    std::atomic<bool> is_paused_ = false, is_reset_ = false;
    std::atomic<unsigned> resets_ = 0;
    std::mutex lock_;  // guards the next two
    Saved last_{};
    bool has_ended_ = false;
    std::condition_variable answered_;
};

}  // namespace dynamic_filter::live
