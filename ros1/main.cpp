// SPDX-License-Identifier: MIT
#include <csignal>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "base/exit_code.hpp"
#include "commands/failure.hpp"
#include "commands/freed_memory.hpp"
#include "commands/live.hpp"
#include "live/live_config.hpp"
#include "ros1/ros1_bus.hpp"

namespace {

using namespace dynamic_filter;
using namespace dynamic_filter::app;

constexpr double kLongestStart = 10.0;  // [s] that a master may need, which roslaunch starts, too

struct Arguments {
    std::vector<char*> own;
    std::map<std::string, std::string> remappings;  ///< of ROS: "name:=value"
};

Arguments split(int argc, char** argv) {
    Arguments arguments;
    for (char* const argument : std::span(argv, static_cast<std::size_t>(argc))) {
        const std::string word = argument;
        const auto sign = word.find(":=");
        if (sign == std::string::npos) {
            arguments.own.push_back(argument);
        } else {
            arguments.remappings.emplace(word.substr(0, sign), word.substr(sign + 2));
        }
    }
    return arguments;
}

int filter(int argc, char** argv) {
    const Arguments arguments = split(argc, argv);
    Program program("dynamicfilter_ros1",
                    "Removes moving objects from the LiDAR scans of ROS 1, as they come.");
    Command command = program.options();
    command.footer(
        "Arguments of ROS such as points:=/velodyne_points and __name:=filter may be added. "
        "Private\n"
        "parameters of the node are settings, too: ~output/map_rate is output.map_rate.");
    live::LiveOptions options;
    add_live_options(command, options);
    command.action([&] {
        live::Ros1Bus bus(arguments.remappings, live::changing_settings(), kLongestStart);
        std::vector<Assignment> parameters;
        for (const auto& [key, value] : bus.pop_parameters()) {
            parameters.push_back({key, value, "parameter " + key});
        }
        return live::live(bus, options, live::load_live_config(options.config, parameters));
    });
    return program.run(arguments.own);
}

}  // namespace

int main(int argc, char** argv) {
    keep_freed_memory();
    std::signal(SIGXFSZ, SIG_IGN);  // a file that may not grow is an error like a full disk
    return guarded("dynamicfilter_ros1", [&] { return filter(argc, argv); });
}
