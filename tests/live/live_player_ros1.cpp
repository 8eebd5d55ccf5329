// SPDX-License-Identifier: MIT
// Plays a bag (.bag) as a node of ROS 1: live_player_ros1 BAG [OPTIONS]
#include "live/player.hpp"
#include "ros1/ros1_bus.hpp"

using namespace dynamic_filter::live;

int main(int argc, char** argv) {
    PlayerOptions options;
    CLI::App app("Plays a bag as a node of ROS 1 and takes the labels of a live filter.");
    add_player_options(app, options);
    CLI11_PARSE(app, argc, argv);
    constexpr double kLongestStart = 10.0;  // [s]
    Ros1Bus bus({{"__name", "live_player"}}, {}, kLongestStart);
    return play(bus, options);
}
