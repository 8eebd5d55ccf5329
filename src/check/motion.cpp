// SPDX-License-Identifier: MIT
#include "check/motion.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numbers>

#include "base/progress.hpp"
#include "dynamic_filter/check.hpp"
#include "dynamic_filter/error.hpp"
#include "dynamic_filter/writers.hpp"
#include "recording/frames.hpp"
#include "settings/config_file.hpp"

namespace dynamic_filter::app {

namespace {

bool has_times(const io::Sequence& sequence) {
    try {
        return !io::read_frame(sequence, 0).times.empty();
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
/// azimuths. Returns a note, or "".
std::string choose_deskew(io::Sequence& sequence, const OdometryConfig& config,
                          const MotionChoice& choice, bool timed, bool is_distorted) {
    sequence.wants_times = false;
    if (choice.deskew == "off") return "";
    if (timed) {
        sequence.wants_times = choice.deskew == "on" || is_distorted;
        if (!sequence.wants_times) return "";
        return "the motion during each scan is undone by the times of its points";
    }
    sequence.sweep = io::find_sweep(sequence, config);
    sequence.wants_times = sequence.sweep.has_value();
    if (!sequence.sweep) return "";
    return fmt::format(
        "the motion during each scan is undone by the azimuths of its points: the sensor turns "
        "{} and begins at {:.0f} deg",
        sequence.sweep->clockwise ? "clockwise" : "counterclockwise",
        sequence.sweep->seam * 180.0 / std::numbers::pi);
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

std::vector<std::string> choose_motion(io::Sequence& sequence, Config& config,
                                       const MotionChoice& choice) {
    std::vector<std::string> notes;
    config.odometry.refine = config.odometry.refine || choice.refine == "on";
    const bool asks_poses = sequence.has_poses && choice.refine == "auto";
    sequence.wants_times = choice.deskew != "off";
    const bool timed = has_times(sequence);
    io::MotionQuality quality;
    if (asks_poses || (timed && choice.deskew == "auto")) {
        quality = io::measure_motion(sequence, config.odometry);
    }
    if (asks_poses && !config.odometry.refine && quality.has_bad_poses()) {
        config.odometry.refine = true;
        notes.push_back(fmt::format(
            "scans blur by {} at the given poses and by {} at refined ones ({}), so the poses are "
            "refined; --refine off keeps them",
            centimetres(quality.given.least()), centimetres(quality.found.least()),
            error_text(quality)));
    }
    if (!sequence.has_poses) {
        notes.emplace_back("no poses are used, so they are found by odometry");
    }
    if (!sequence.has_poses || config.odometry.refine) {
        add(notes,
            choose_deskew(sequence, config.odometry, choice, timed, quality.found.is_distorted()));
        return notes;
    }
    sequence.wants_times = false;
    if (choice.deskew == "on" && !timed) {
        add(notes, choose_deskew(sequence, config.odometry, choice, timed, false));
        sequence.wants_times = false;
        if (sequence.sweep) io::prepare_deskew(sequence);
    }
    if (choice.deskew == "auto" && quality.given.is_distorted()) {
        io::prepare_deskew(sequence);
        notes.push_back(fmt::format(
            "scans blur by {} as they are and by {} with the motion during each scan undone, so it "
            "is undone; --deskew off leaves it",
            centimetres(quality.given.as_measured), centimetres(quality.given.undone)));
    }
    return notes;
}

void ensure_poses(io::Sequence& sequence, const Config& config, const std::string& deskew,
                  bool quiet) {
    if (sequence.has_poses) return;
    Config chosen = config;
    for (std::string& note : choose_motion(sequence, chosen, {.deskew = deskew})) {
        sequence.notes.push_back(std::move(note));
    }
    std::vector<std::optional<Tracked>> tracked;
    {
        Progress progress("odometry", sequence.size(), quiet);
        tracked = io::track_scans(sequence, config.odometry, [&] {
            progress.advance();
            return !interrupted();
        });
    }
    const Track track = summary_of(tracked);
    if (track.missing == tracked.size()) {
        throw InputError(sequence.root, "", "no scan is usable");
    }
    io::use_poses(sequence, tracked);
    sequence.notes.push_back(to_text(track));
}

void write_poses(const std::filesystem::path& path, const io::Sequence& sequence) {
    if (path.extension() == ".tum") {
        io::write_poses_tum(path, sequence.stamps, sequence.T_world_sensor);
    } else {
        io::write_poses_kitti(path, sequence.T_world_sensor);
    }
}

}  // namespace dynamic_filter::app
