// SPDX-License-Identifier: MIT
/// In place of live.cpp where the program is built without DDS.
#include "commands/all.hpp"

namespace dynamic_filter::app {

void add_live(Program& program) {
    program.command("live", "Filter what a robot's LiDAR publishes (left out of this program)")
        .left_out(
            "`live` was left out when this program was built; everything else works. To have it, "
            "install Cyclone DDS, libwebsockets and yaml-cpp (cyclonedds-dev, libwebsockets-dev "
            "and libyaml-cpp-dev on Debian and Ubuntu) and build with -DDYNAMIC_FILTER_LIVE=ON");
}

}  // namespace dynamic_filter::app
