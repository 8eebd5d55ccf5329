// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <CLI/CLI.hpp>

#include <csignal>

#include "commands/failure.hpp"
#include "commands/freed_memory.hpp"
#include "live/live_config.hpp"
#include "live/live_options.hpp"
#include "ros1/ros1_bus.hpp"
#include "run/commands.hpp"

namespace {

using namespace dynamic_filter;
using namespace dynamic_filter::app;

constexpr double kLongestStart = 10.0;  // [s] that a master may need, which roslaunch starts, too

struct Arguments {
    std::vector<std::string> own;                   ///< in reverse, as CLI11 takes them
    std::map<std::string, std::string> remappings;  ///< of ROS: "name:=value"
};

Arguments split(int argc, char** argv) {
    Arguments arguments;
    for (int i = argc - 1; i > 0; --i) {
        const std::string word = argv[i];
        const auto sign = word.find(":=");
        if (sign == std::string::npos) {
            arguments.own.push_back(word);
        } else {
            arguments.remappings.emplace(word.substr(0, sign), word.substr(sign + 2));
        }
    }
    return arguments;
}

/// What CLI11 says of wrong arguments, in the form of all other errors.
std::string usage_error(const CLI::App*, const CLI::Error& error) {
    return fmt::format("dynamicfilter_ros1: {}; `dynamicfilter_ros1 --help` lists the options\n",
                       error.what());
}

int filter(int argc, char** argv) {
    CLI::App app("Removes moving objects from the LiDAR scans of ROS 1, as they come.",
                 "dynamicfilter_ros1");
    app.set_version_flag("--version", DYNAMIC_FILTER_VERSION);
    app.failure_message(usage_error);
    app.footer(
        "Arguments of ROS such as points:=/velodyne_points and __name:=filter may be added. "
        "Private\n"
        "parameters of the node are settings, too: ~output/map_rate is output.map_rate.");
    live::LiveOptions options;
    live::add_live_options(app, options);
    Arguments arguments = split(argc, argv);
    try {
        app.parse(std::move(arguments.own));
    } catch (const CLI::ParseError& error) {
        return app.exit(error) == 0 ? kDone : kUsage;
    }
    live::Ros1Bus bus(arguments.remappings, live::changing_settings(), kLongestStart);
    return live::live(bus, options);
}

}  // namespace

int main(int argc, char** argv) {
    keep_freed_memory();
    std::signal(SIGXFSZ, SIG_IGN);  // a file that may not grow is an error like a full disk
    return guarded("dynamicfilter_ros1", [&] { return filter(argc, argv); });
}
