// SPDX-License-Identifier: MIT
#include "check/motion.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numbers>

#include "base/progress.hpp"
#include "check/sensor_place.hpp"
#include "dynamic_filter/check.hpp"
#include "dynamic_filter/error.hpp"
#include "dynamic_filter/writers.hpp"
#include "recording/scans.hpp"
#include "settings/config_file.hpp"

namespace dynamic_filter::app {

namespace {

bool has_times(const io::Recording& recording) {
    try {
        return !recording.read(0).times.empty();
    } catch (const InputError&) {
        return false;
    }
}

std::string centimetres(double metres) { return fmt::format("{:.1f} cm", 100.0 * metres); }

/// "by 0.21 m and 0.15 deg over 20 scans"
std::string error_text(const io::MotionQuality& quality) {
    const io::PoseError& last = quality.errors.back();
    return fmt::format("they are off by {} and {:.2f} deg over {} scans", centimetres(last.shift),
                       last.turn * 180.0 / std::numbers::pi, last.apart);
}

/// Chooses how the motion within scans is undone: by the times of the points, else by their
/// azimuths. The recording then has these times. Returns a note, or "".
std::string choose_deskew(io::Recording& recording, const OdometryConfig& config,
                          const MotionChoice& choice, bool timed, bool is_distorted) {
    if (choice.deskew == "off") return "";
    if (timed) {
        if (choice.deskew != "on" && !is_distorted) return "";
        recording = io::with_times(recording);
        return "the motion during each scan is undone by the times of its points";
    }
    const auto sweep = io::find_sweep(recording, config);
    if (!sweep) return "";
    recording = io::with_times(recording, sweep);
    return fmt::format(
        "the motion during each scan is undone by the azimuths of its points: the sensor turns "
        "{} and begins at {:.0f} deg",
        sweep->clockwise ? "clockwise" : "counterclockwise",
        sweep->seam * 180.0 / std::numbers::pi);
}

void add(std::vector<std::string>& notes, std::string note) {
    if (!note.empty()) notes.push_back(std::move(note));
}

struct Track {
    double way = 0.0;  // [m]
    std::size_t weak = 0, lost = 0, missing = 0;
};

Track summary_of(const std::vector<std::optional<Tracked>>& tracked) {
    Track track;
    std::optional<Eigen::Vector3d> last;
    for (const auto& t : tracked) {
        if (!t) {
            ++track.missing;
            continue;
        }
        const Eigen::Vector3d here = t->T_world_sensor.translation();
        track.way += last ? (here - *last).norm() : 0.0;
        track.weak += t->status == TrackStatus::weak ? 1 : 0;
        track.lost += t->status == TrackStatus::lost ? 1 : 0;
        last = here;
    }
    return track;
}

std::string to_text(const Track& track) {
    std::string text = fmt::format("the odometry went {:.1f} m", track.way);
    if (track.weak > 0) {
        text +=
            fmt::format("; {} scans do not show how far they went in some direction", track.weak);
    }
    if (track.lost > 0) {
        text += fmt::format("; {} scans do not fit those before, so their poses are guesses",
                            track.lost);
    }
    return text;
}

}  // namespace

std::string track_text(const std::vector<std::optional<Tracked>>& tracked) {
    return to_text(summary_of(tracked));
}

std::vector<std::string> choose_motion(io::Recording& recording, Config& config,
                                       const MotionChoice& choice) {
    std::vector<std::string> notes;
    add(notes, choose_sensor_place(recording));
    config.odometry.refine = config.odometry.refine || choice.refine == "on";
    const bool has_poses = recording.info().has_poses;
    const bool asks_poses = has_poses && choice.refine == "auto";
    const io::Recording looked_at = choice.deskew == "off" ? recording : io::with_times(recording);
    const bool timed = has_times(looked_at);
    io::MotionQuality quality;
    if (asks_poses || (timed && choice.deskew == "auto")) {
        quality = io::measure_motion(looked_at, config.odometry);
    }
    if (asks_poses && !config.odometry.refine && quality.has_bad_poses()) {
        config.odometry.refine = true;
        notes.push_back(fmt::format(
            "scans blur by {} at the given poses and by {} at refined ones ({}), so the poses are "
            "refined; --refine off keeps them",
            centimetres(quality.given.least()), centimetres(quality.found.least()),
            error_text(quality)));
    }
    if (!has_poses) notes.emplace_back("no poses are used, so they are found by odometry");
    if (!has_poses || config.odometry.refine) {
        add(notes,
            choose_deskew(recording, config.odometry, choice, timed, quality.found.is_distorted()));
        return notes;
    }
    if (choice.deskew == "on" && !timed) {
        add(notes, choose_deskew(recording, config.odometry, choice, timed, false));
        if (recording.info().sweep) recording = io::deskewed(recording);
    }
    if (choice.deskew == "auto" && quality.given.is_distorted()) {
        recording = io::deskewed(recording);
        notes.push_back(fmt::format(
            "scans blur by {} as they are and by {} with the motion during each scan undone, so it "
            "is undone; --deskew off leaves it",
            centimetres(quality.given.as_measured), centimetres(quality.given.undone)));
    }
    return notes;
}

void ensure_poses(io::Recording& recording, const Config& config, const std::string& deskew,
                  bool quiet) {
    const std::string place = choose_sensor_place(recording);
    if (!place.empty()) recording = io::with_notes(recording, {place});
    if (recording.info().has_poses) return;
    Config chosen = config;
    const auto notes = choose_motion(recording, chosen, {.deskew = deskew});
    std::vector<std::optional<Tracked>> tracked;
    {
        Progress progress("odometry", recording.size(), quiet);
        tracked = io::track_scans(recording, config.odometry, [&] {
            progress.advance();
            return !interrupted();
        });
    }
    const Track track = summary_of(tracked);
    if (track.missing == tracked.size()) {
        throw InputError(recording.info().root, "", "no scan is usable");
    }
    recording = io::with_poses(io::with_notes(recording, notes), tracked);
    recording = io::with_notes(recording, {to_text(track)});
}

void write_poses(const std::filesystem::path& path, const io::Recording& sensor) {
    const io::Recording recording = io::with_sensor_at(sensor, Eigen::Vector3d::Zero());
    if (path.extension() == ".tum") {
        io::write_poses_tum(path, recording.info().stamps, recording.info().T_world_sensor);
    } else {
        io::write_poses_kitti(path, recording.info().T_world_sensor);
    }
}

}  // namespace dynamic_filter::app
