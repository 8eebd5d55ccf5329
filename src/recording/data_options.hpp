// SPDX-License-Identifier: MIT
/// How a recording is read. The table visit_reading() has a row for each option; the options of the
/// command, the arguments of Python, the file of a part and the checks are made from it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "dynamic_filter/recording.hpp"

namespace dynamic_filter::app {

/// As a pose file: the poses of the recording are not read. A file of that name is meant by ./none.
inline constexpr const char* kNoPoses = "none";

/// As a mask: nothing is taken for the own body.
inline constexpr const char* kNoMask = "none";

/// A recording, and how to read it.
struct DataOptions {
    std::filesystem::path data;
    std::optional<std::filesystem::path> poses{};  ///< or kNoPoses
    std::string format{};                          ///< name of a layout; empty: recognised
    std::string topic{}, pose_topic{};             ///< of a bag; empty: chosen
    std::string pose_fix = "none", time_unit = "s";
    bool points_in_world = false;
    std::string sensor_at{};  ///< "X,Y,Z" [m]; empty: not known
    std::string point_unit = "m";
    std::optional<std::filesystem::path> mask{};  ///< or kNoMask
    std::string deskew = "auto";
    std::size_t first = 0;
    std::optional<std::size_t> last{};
    std::size_t stride = 1;
};

/// A row of the table.
struct ReadingOption {
    const char* name;  ///< as a word of Python; the command's option is "--pose-fix" for "pose_fix"
    const char* help;
    std::vector<std::string> choices{};  ///< empty: any text
    const char* alone = nullptr;         ///< the choice if the command's option has no word
    std::uint64_t low = 0;               ///< smallest whole number
    bool is_place = false;               ///< true: three numbers with commas, or empty
    bool selects = false;                ///< true: chooses scans, and does not change them
};

std::vector<std::string> pose_fix_names();

/// Calls `visit(row, member)` for each option. `Options` is DataOptions or const.
template <class Options, class Visit>
void visit_reading(Options& options, const Visit& visit) {
    const auto row = [&](const ReadingOption& option, auto& member) { visit(option, member); };
    row({.name = "poses",
         .help = "pose file; `none` finds the poses by odometry (default: the recording's own "
                 "poses)"},
        options.poses);
    row({.name = "format",
         .help = "layout of the recording (default: recognised by its files)",
         .choices = io::layout_names()},
        options.format);
    row({.name = "topic", .help = "topic of the scans in a bag (default: the only one)"},
        options.topic);
    row({.name = "pose_topic",
         .help = "topic of the poses in a bag, or /tf (default: the one that fits)"},
        options.pose_topic);
    row({.name = "pose_fix",
         .help = "correct the poses; `check` says which correction is needed",
         .choices = pose_fix_names()},
        options.pose_fix);
    row({.name = "points_in_world",
         .help = "the points are in the world frame, not in the sensor's frame"},
        options.points_in_world);
    row({.name = "sensor_at",
         .help = "X,Y,Z [m] of the sensor in the frame of the points, if that is the vehicle's "
                 "(default: found from the rings of a rotating sensor, or from /tf_static)",
         .is_place = true},
        options.sensor_at);
    row({.name = "point_unit",
         .help = "unit of the coordinates of points; results are in metres",
         .choices = {"m", "cm", "mm", "feet"}},
        options.point_unit);
    row({.name = "mask",
         .help =
             "file of boxes around what moves with the sensor, or its mesh (.stl), which is left "
             "out; `none` leaves nothing out (default: found, if the sensor moves)"},
        options.mask);
    row({.name = "time_unit", .help = "unit of the stamps", .choices = {"s", "ms", "us", "ns"}},
        options.time_unit);
    row({.name = "deskew",
         .help = "undo the sensor's motion during each scan; auto does so if the scans overlay "
                 "better then",
         .choices = {"auto", "on", "off"},
         .alone = "auto"},
        options.deskew);
    row({.name = "first", .help = "index of the first scan to use", .selects = true},
        options.first);
    row({.name = "last", .help = "index of the last scan to use", .selects = true}, options.last);
    row({.name = "stride", .help = "use every n-th scan only", .low = 1, .selects = true},
        options.stride);
}

/// The word of Python as the command spells it: "--pose-fix" for "pose_fix".
std::string as_option(const char* name);
inline std::string as_option(const ReadingOption& option) { return as_option(option.name); }

/// The numbers of "X,Y,Z"; empty if they are no three finite numbers.
std::optional<Eigen::Vector3d> place_of(const std::string& text);

/// Who gave the options, and so how messages spell them.
enum class Asker { command, python };

/// Throws ConfigError if a value is none of the choices of its row, or too small.
void refuse_invalid(const DataOptions& options, Asker asker);

}  // namespace dynamic_filter::app
