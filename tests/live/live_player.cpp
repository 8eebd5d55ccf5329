// SPDX-License-Identifier: MIT
// Plays a bag (.mcap) by DDS: live_player BAG [--domain N] [OPTIONS]
#include "live/dds_bus.hpp"
#include "live/player.hpp"

using namespace dynamic_filter::live;

int main(int argc, char** argv) {
    PlayerOptions options;
    int domain = 0;
    CLI::App app("Plays a bag by DDS and takes the labels of a live filter.");
    add_player_options(app, options);
    app.add_option("--domain", domain);
    CLI11_PARSE(app, argc, argv);
    DdsBus bus({.domain = domain, .network = {}});
    return play(bus, options);
}
