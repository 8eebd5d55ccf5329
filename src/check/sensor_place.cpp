// SPDX-License-Identifier: MIT
#include "check/sensor_place.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include "base/numbers.hpp"
#include "check/beam_origins.hpp"
#include "dynamic_filter/check.hpp"
#include "dynamic_filter/error.hpp"
#include "recording/recording_parts.hpp"

namespace dynamic_filter::io {
namespace {

using Places = std::vector<Eigen::Vector3d>;

/// In every direction the median, in whole centimetres, as it is shown to the user.
Eigen::Vector3d middle_of(const Places& places) {
    Eigen::Vector3d middle;
    for (int axis = 0; axis < 3; ++axis) {
        std::vector<double> along;
        for (const Eigen::Vector3d& place : places) along.push_back(place[axis]);
        middle[axis] = std::round(100.0 * median(std::move(along))) / 100.0 + 0.0;
    }
    return middle;
}

/// The place on which most of the scans agree; empty if they do not.
std::optional<Eigen::Vector3d> common(const Places& places, std::size_t scans) {
    constexpr double kAlike = 0.2;  // [m]
    if (places.empty()) return std::nullopt;
    const Eigen::Vector3d middle = middle_of(places);
    const auto alike = std::count_if(places.begin(), places.end(), [&](const auto& place) {
        return (place - middle).norm() < kAlike;
    });
    return 2 * static_cast<std::size_t>(alike) > scans ? std::optional(middle) : std::nullopt;
}

/// The points as in the files: undone motion would have moved the places that they were seen from.
Recording as_in_files(const Recording& recording) {
    RecordingParts parts = with_sensor_at(recording, Eigen::Vector3d::Zero()).parts();
    parts.info.deskewed = false;
    parts.velocities.clear();
    return Recording(std::move(parts));
}

}  // namespace

std::vector<Eigen::Vector3d> find_sensor_places(const Recording& recording) {
    constexpr std::size_t kScans = 5;
    const Recording files = as_in_files(recording);
    const std::size_t count = std::min(kScans, recording.size());
    std::array<Places, 2> found;
    std::size_t scans = 0;
    Places single;
    for (std::size_t k = 0; k < count; ++k) {
        try {
            const FullScan scan = files.read(k * recording.size() / count);
            const Places places = beam_origins(scan.points);
            ++scans;
            if (places.size() == 1) single.push_back(places.front());
            if (places.size() != 2) continue;
            for (std::size_t i = 0; i < 2; ++i) found[i].push_back(places[i]);
        } catch (const InputError&) {
            continue;  // a rejected scan
        }
    }
    if (const auto one = common(single, scans)) return {*one};
    const auto first = common(found[0], scans), second = common(found[1], scans);
    return first && second ? Places{*first, *second} : Places{};
}

}  // namespace dynamic_filter::io

namespace dynamic_filter::app {

std::string choose_sensor_place(io::Recording& recording) {
    // Each of several sensors is at the origin of its own frame.
    if (recording.info().sensor_at || !recording.parts().sensors.empty()) return "";
    const auto places = io::find_sensor_places(recording);
    const Eigen::Vector3d at = places.size() == 1 ? places.front() : Eigen::Vector3d::Zero();
    recording = io::with_sensor_at(recording, at);
    if (at.isZero()) return "";
    return fmt::format(
        "the beams meet ({:.2f}, {:.2f}, {:.2f}) m from the origin of the points' frame, so the "
        "sensor is there; --sensor-at 0,0,0 keeps it at the origin",
        at.x(), at.y(), at.z());
}

}  // namespace dynamic_filter::app
