// SPDX-License-Identifier: MIT
/// The settings of `dynamicfilter live`, and those of its filter. One TOML file holds both.
#pragma once

#include <string>
#include <vector>

#include "dynamic_filter/parallel.hpp"
#include "dynamic_filter/settings.hpp"
#include "settings/config_file.hpp"

namespace dynamic_filter::live {

/// Each field is explained by its row in visit_live().
struct LiveConfig {
    struct Bus {
        int domain = 0;
        std::string network;
    } bus;
    struct Input {
        std::string cloud, pose, world, qos = "auto";
        double wait = 0.2, silence = 2.0, decide = 5.0;
        int queue = 2;
        bool deskew = false;
        std::string mask;
    } input;
    struct Output {
        std::string prefix = "/dynamicfilter", qos = "reliable", map_frame = "map";
        double map_rate = 1.0, map_radius = 50.0;
        int settle_after = 10;
        bool transform = true;
    } output;
    struct Grid {
        double rate = 1.0, radius = 20.0, cell = 0.1, robot_height = 1.5, step = 0.1;
    } grid;
    struct Foxglove {
        bool serve = false;
        std::string address = "127.0.0.1", origins;
        int port = 8765;
    } foxglove;
    struct Limits {
        double horizon = 200.0;
        int map_mib = 2048, threads = 0;
    } limits;
    Config filter{};
};

/// Calls f(setting, member) for every field but the filter's, in the order of the struct.
template <class C, class F>
void visit_live(C& c, F&& f) {
    constexpr bool kWhileRunning = true;
    f(Setting{"bus.domain", "", "", "DDS domain, as ROS_DOMAIN_ID; ROS 2 only", 0, 232},
      c.bus.domain);
    f(Setting{"bus.network", "", "",
              "localhost, all (the default interface), or the name of an interface such as eth0; "
              "empty: what CYCLONEDDS_URI says, or else localhost; ROS 2 only"},
      c.bus.network);
    f(Setting{"input.cloud", "", "",
              "topic of the scans, or several with blanks between them, of the sensors of one "
              "vehicle; empty: the only one"},
      c.input.cloud);
    f(Setting{"input.pose", "", "",
              "/tf, a topic of Odometry or PoseStamped, or none for own odometry; empty: /tf, or "
              "else the first topic with poses, or else own odometry"},
      c.input.pose);
    f(Setting{"input.world", "", "",
              "frame of /tf in which the map is; empty: the root of the frame of the scans"},
      c.input.world);
    f(Setting{"input.qos", "", "",
              "auto asks for what the publisher offers; with reliable, lost packets are sent again",
              0, 0, kAllMethods, "auto reliable best_effort"},
      c.input.qos);
    f(Setting{"input.wait", "s", "", "how long a scan waits for its pose", 0, 10}, c.input.wait);
    f(Setting{"input.decide", "s", "",
              "with an empty input.pose: how long scans come without any pose until the own "
              "odometry begins",
              0, 3600},
      c.input.decide);
    f(Setting{"input.silence", "s", "", "without a scan for so long, the input has stopped", 0.1,
              3600, kAllMethods, "", kWhileRunning},
      c.input.silence);
    f(Setting{"input.queue", "", "", "number of scans that may wait for the filter", 1, 100},
      c.input.queue);
    f(Setting{"input.deskew", "", "",
              "whether the motion of the sensor during each scan is undone; scans must hold the "
              "times of their points"},
      c.input.deskew);
    f(Setting{"input.mask", "", "",
              "file of boxes in the sensor frame that hold the own body, or its mesh (.stl); "
              "empty: none"},
      c.input.mask);
    f(Setting{"output.prefix", "", "", "what the names of the published topics begin with"},
      c.output.prefix);
    f(Setting{"output.qos", "", "", "how scans are published", 0, 0, kAllMethods,
              "reliable best_effort"},
      c.output.qos);
    f(Setting{"output.map_frame", "", "", "name of the world frame of the own odometry"},
      c.output.map_frame);
    f(Setting{"output.map_rate", "Hz", "", "how often the local static map is published; 0: never",
              0, 50, kAllMethods, "", kWhileRunning},
      c.output.map_rate);
    f(Setting{"output.map_radius", "m", "", "radius of the local static map", 1, 1000, kAllMethods,
              "", kWhileRunning},
      c.output.map_radius);
    f(Setting{"output.settle_after", "", "",
              "corrections of a scan are published after so many later scans; 0: none", 0, 1000},
      c.output.settle_after);
    f(Setting{"output.transform", "", "",
              "whether the own odometry publishes the transform of its world frame in /tf"},
      c.output.transform);
    f(Setting{"grid.rate", "Hz", "", "how often the occupancy grid is published; 0: never", 0, 10},
      c.grid.rate);
    f(Setting{"grid.radius", "m", "", "half the width of the occupancy grid", 2, 50},
      c.grid.radius);
    f(Setting{"grid.cell", "m", "", "width of a cell of the occupancy grid", 0.02, 0.25},
      c.grid.cell);
    f(Setting{"grid.robot_height", "m", "",
              "what hangs higher above the floor is no obstacle of the occupancy grid", 0.05, 10},
      c.grid.robot_height);
    f(Setting{"grid.step", "m", "", "what the robot may climb, in the occupancy grid", 0.01, 0.5},
      c.grid.step);
    f(Setting{"foxglove.serve", "", "", "whether Foxglove and Lichtblick can connect"},
      c.foxglove.serve);
    f(Setting{"foxglove.address", "", "",
              "on which the server for Foxglove listens; 0.0.0.0 lets other machines see the "
              "sensor's data"},
      c.foxglove.address);
    f(Setting{"foxglove.port", "", "", "of the server for Foxglove; 0: any that is free", 0, 65535},
      c.foxglove.port);
    f(Setting{"foxglove.origins", "", "",
              "further web pages that may connect, separated by blanks, such as "
              "https://foxglove.example.org"},
      c.foxglove.origins);
    f(Setting{"limits.horizon", "m", "", "the map farther away than this is forgotten; 0: never", 0,
              1e6},
      c.limits.horizon);
    f(Setting{"limits.map_mib", "MiB", "", "limit on the memory of the map; 0: none", 0, 1e6},
      c.limits.map_mib);
    f(Setting{"limits.threads", "", "", "threads for the computations; 0: all cores", 0,
              kMostThreads},
      c.limits.threads);
}

/// Calls f(setting, member) for every field, also of the filter.
template <class C, class F>
requires std::same_as<std::remove_const_t<C>, LiveConfig>
void visit(C& c, F&& f) {
    visit_live(c, f);
    visit(c.filter, f);
}

/// The topics of input.cloud: one for each sensor.
std::vector<std::string> cloud_topics(const LiveConfig& config);

/// Sets one setting of live or of the filter. Throws ConfigError, which names the nearest key.
void set(LiveConfig& config, const std::string& key, const std::string& value);

/// Throws ConfigError that lists what is wrong.
void validate(const LiveConfig& config);

/// Preset, then parameters of ROS, then file, then assignments; checked. Throws ConfigError
/// that names all mistakes. ROS_DOMAIN_ID is the default of bus.domain.
LiveConfig load_live_config(const app::ConfigOptions& options,
                            std::vector<app::Assignment> parameters);

/// Keys of the settings that may change while the filter runs.
std::vector<std::string> changing_settings();
/// Sets one of changing_settings(). Throws ConfigError for any other.
void change(LiveConfig& config, const std::string& key, const std::string& value);

/// Every setting of live, but not of the filter, as TOML with its meaning as a comment.
std::string to_toml(const LiveConfig& config);

}  // namespace dynamic_filter::live
