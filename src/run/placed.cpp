// SPDX-License-Identifier: MIT
#include "run/placed.hpp"

#include <fmt/format.h>

#include <array>

#include <nlohmann/json.hpp>
#include <span>

#include "base/crc.hpp"
#include "check/samples.hpp"
#include "dynamic_filter/error.hpp"
#include "dynamic_filter/file.hpp"
#include "recording/recording_parts.hpp"
#include "run/data_json.hpp"
#include "run/run_state.hpp"

namespace dynamic_filter::app {

namespace {

using Json = nlohmann::ordered_json;
namespace fs = std::filesystem;

constexpr std::size_t kPose = 12, kVelocity = 6;  // numbers of each

/// The upper three rows, one after the other.
void append_rows(const Pose& pose, std::vector<double>& numbers) {
    for (std::size_t i = 0; i < kPose; ++i) {
        numbers.push_back(
            pose.matrix()(static_cast<Eigen::Index>(i / 4), static_cast<Eigen::Index>(i % 4)));
    }
}

/// Distance of the points of the first scan, so that a copy with another unit is another recording.
std::string reach_text(const io::Recording& recording) {
    try {
        const float range = io::typical_range(recording.read(0).points);
        return range > 0.0F ? fmt::format(", points at {:.2g} m", range) : "";
    } catch (const InputError&) {  // is rejected later, with the reason
        return "";
    }
}

Json json_of(const std::optional<Tracked>& tracked) {
    if (!tracked) return nullptr;
    std::vector<double> numbers;
    append_rows(tracked->T_world_sensor, numbers);
    numbers.insert(numbers.end(), tracked->velocity.begin(), tracked->velocity.end());
    return numbers;
}

std::optional<Tracked> tracked_of(const Json& json) {
    if (json.is_null()) return std::nullopt;
    Tracked tracked;
    for (std::size_t i = 0; i < kPose; ++i) {
        tracked.T_world_sensor.matrix()(static_cast<Eigen::Index>(i / 4),
                                        static_cast<Eigen::Index>(i % 4)) = json.at(i);
    }
    for (std::size_t i = 0; i < kVelocity; ++i) {
        tracked.velocity[static_cast<Eigen::Index>(i)] = json.at(kPose + i);
    }
    return tracked;
}

Json json_of(const Sweep& sweep) {
    return {{"clockwise", sweep.clockwise},
            {"seam", sweep.seam},
            {"duration", sweep.duration},
            {"in_order", sweep.in_order},
            {"shift", sweep.shift}};
}

Sweep sweep_of(const Json& json) {
    return {.clockwise = json.at("clockwise"),
            .seam = json.at("seam"),
            .duration = json.at("duration"),
            .in_order = json.value("in_order", false),
            .shift = json.value("shift", 0.0)};
}

/// A line for each scan, because a line of a megabyte is no pleasure in an editor.
std::string lines_of(const std::vector<std::optional<Tracked>>& tracked) {
    std::string text;
    for (const auto& scan : tracked)
        text += (text.empty() ? "\n    " : ",\n    ") + json_of(scan).dump();
    return "[" + text + "\n  ]";
}

}  // namespace

std::string fingerprint_of(const io::Recording& recording) {
    std::vector<double> numbers = recording.info().stamps;
    for (const Pose& pose : recording.info().T_world_sensor) append_rows(pose, numbers);
    return fmt::format("{}, poses and stamps {:08x}{}", scans_text(recording),
                       crc_of(std::as_bytes(std::span(numbers))), reach_text(recording));
}

Placed placed_of(const io::Recording& recording, const DataOptions& how,
                 const std::string& fingerprint) {
    const io::RecordingParts& parts = recording.parts();
    const io::Info& info = parts.info;
    Placed placed{.how = how,
                  .fingerprint = fingerprint,
                  .has_times = parts.with_times,
                  .deskewed = info.deskewed,
                  .sweep = info.sweep,
                  .sensor_at = info.sensor_at};
    if (!info.tracked) return placed;
    for (std::size_t i = 0; i < recording.size(); ++i) {
        const Pose& pose = info.T_world_sensor[i];
        std::optional<Tracked>& tracked = placed.tracked.emplace_back();
        if (!pose.matrix().allFinite()) continue;
        tracked.emplace();
        tracked->T_world_sensor = pose;
        tracked->velocity = parts.velocities[i];
    }
    return placed;
}

void write_placed(const fs::path& folder, const Placed& placed) {
    Json json{{"version", 1},
              {"recording", placed.fingerprint},
              {"reading", json_of(placed.how)},
              {"times", placed.has_times},
              {"deskewed", placed.deskewed},
              {"sweep", placed.sweep ? json_of(*placed.sweep) : Json()}};
    if (placed.sensor_at) {
        const Eigen::Vector3d& at = *placed.sensor_at;
        json["sensor_at"] = {at.x(), at.y(), at.z()};
    }
    std::string text = json.dump(2);
    if (!placed.tracked.empty()) {
        text.resize(text.size() - 2);  // the line end and the brace
        text += ",\n  \"poses_and_velocities\": " + lines_of(placed.tracked) + "\n}";
    }
    io::write_file(folder / kPlacedFile, text + "\n");
}

std::optional<Placed> read_placed(const fs::path& folder) {
    const fs::path file = folder / kPlacedFile;
    if (!fs::is_regular_file(file)) return std::nullopt;
    try {
        const Json json = Json::parse(io::read_file(file));
        if (json.at("version") != 1) {
            throw InputError(file, "version", "is of another version of dynamicfilter");
        }
        Placed placed{.how = data_options_of(json.at("reading")),
                      .fingerprint = json.at("recording"),
                      .has_times = json.at("times"),
                      .deskewed = json.at("deskewed")};
        if (!json.at("sweep").is_null()) placed.sweep = sweep_of(json["sweep"]);
        if (json.contains("sensor_at")) {
            const auto at = json["sensor_at"].get<std::array<double, 3>>();
            placed.sensor_at = Eigen::Vector3d(at[0], at[1], at[2]);
        }
        if (!json.contains("poses_and_velocities")) return placed;
        for (const Json& scan : json["poses_and_velocities"]) {
            placed.tracked.push_back(tracked_of(scan));
        }
        return placed;
    } catch (const nlohmann::json::exception& error) {
        throw InputError(file, "",
                         std::string("is damaged; run again with --overwrite, or give the poses "
                                     "with --poses (") +
                             error.what() + ")");
    }
}

io::Recording placed_again(io::Recording recording, const Placed& placed) {
    if (placed.sensor_at) recording = io::with_sensor_at(recording, *placed.sensor_at);
    // A recording that was opened with --deskew on is deskewed, but without the shift of the run.
    if (placed.deskewed && (!recording.info().deskewed || placed.sweep)) {
        recording = io::deskewed(recording, placed.sweep);
    }
    if (placed.has_times) recording = io::with_times(recording, placed.sweep);
    if (placed.tracked.empty()) return recording;
    return io::with_poses(recording, placed.tracked);
}

}  // namespace dynamic_filter::app
