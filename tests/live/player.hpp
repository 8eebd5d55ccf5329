// SPDX-License-Identifier: MIT
/// Plays the scans and poses of a bag on a bus, as a robot would, and takes what `dynamicfilter
/// live` says to them. Prints counts and latencies as JSON.
#pragma once

#include <CLI/CLI.hpp>

#include <filesystem>
#include <string>

#include "live/bus.hpp"

namespace dynamic_filter::live {

struct PlayerOptions {
    std::filesystem::path bag;  ///< in the encoding of the bus
    std::string topic = "/points", prefix = "/dynamicfilter";
    std::string answer;   ///< topic of a relay of the scans; empty: labels
    int passes = 1;       ///< every second one backwards, with stamps that go on
    double speed = 1.0;   ///< times the sensor's rate
    double wait = 20.0;   ///< [s] for a subscriber
    double jump = 0.0;    ///< [s] by which the clock is set on in the middle of a pass
    bool all = false;     ///< also receive the other topics, as a display would
    bool save = false;    ///< ask for the map after half of the scans, and wait for the answer
    std::string save_as;  ///< the name of the file of that map; empty: the usual one
    bool reset = false;   ///< ask for a new map after half of the scans
    bool pause = false;   ///< ask for a pause during the third quarter of the scans
    bool check = false;   ///< filter the bag here, too, and count the labels that differ
};

void add_player_options(CLI::App& app, PlayerOptions& options);

/// Returns 0 if every scan was answered.
int play(Bus& bus, const PlayerOptions& options);

}  // namespace dynamic_filter::live
