// SPDX-License-Identifier: MIT
#include "check/motion.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "base/progress.hpp"
#include "check/choose_poses.hpp"
#include "check/motion_look.hpp"
#include "check/own_body.hpp"
#include "check/scan_times.hpp"
#include "check/sensor_place.hpp"
#include "dynamic_filter/check.hpp"
#include "dynamic_filter/error.hpp"
#include "dynamic_filter/writers.hpp"
#include "geometry/thinning.hpp"
#include "recording/mask.hpp"
#include "recording/recording_parts.hpp"
#include "recording/rig_poses.hpp"
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

/// "the order of its points in the file", or what else tells when points were measured.
std::string source_of(const Sweep& sweep, bool timed) {
    if (timed) return "the times of its points";
    if (sweep.in_order) return "the order of its points in the file";
    return fmt::format("the azimuths of its points (the sensor turns {} and begins at {:.0f} deg)",
                       sweep.clockwise ? "clockwise" : "counterclockwise",
                       sweep.seam * 180.0 / std::numbers::pi);
}

/// What is lost if the motion was asked to be undone, and cannot be.
void add_not_undone(io::Recording& recording) {
    recording = io::with_losses(
        recording, {"the motion during each scan is not undone, as --deskew on asks: the points "
                    "have no times, and neither their order nor their azimuths make scans overlay "
                    "better; give points with a field t, time or timestamp"});
}

/// Chooses how the motion within scans is undone at poses that odometry finds. The recording then
/// has these times. Returns a note, or "".
std::string choose_deskew(io::Recording& recording, const OdometryConfig& config,
                          const MotionChoice& choice, bool timed, bool is_distorted) {
    if (choice.deskew == "off") return "";
    if (timed) {
        if (choice.deskew != "on" && !is_distorted) return "";
        recording = io::with_times(recording);
        return "the motion during each scan is undone by the times of its points";
    }
    const auto sweep = io::find_sweep(recording, config);
    if (!sweep) {
        if (choice.deskew == "on") add_not_undone(recording);
        return "";
    }
    recording = io::with_times(recording, sweep);
    return "the motion during each scan is undone by " + source_of(*sweep, false);
}

/// Where the stamps of scans are, if the times of their points had to be shifted.
std::string stamp_text(const Sweep& sweep, bool timed) {
    if (!timed || sweep.shift == 0.0) return "";
    return fmt::format(", {:.0f} ms {} than they say", 1e3 * std::abs(sweep.shift),
                       sweep.shift < 0.0 ? "earlier" : "later");
}

void add(std::vector<std::string>& notes, std::string note) {
    if (!note.empty()) notes.push_back(std::move(note));
}

struct Track {
    double way = 0.0;  // [m]
    std::size_t weak = 0, lost = 0;
};

Track summary_of(const std::vector<std::optional<Tracked>>& tracked) {
    Track track;
    std::optional<Eigen::Vector3d> last;
    for (const auto& t : tracked) {
        if (!t) continue;
        const Eigen::Vector3d here = t->T_world_sensor.translation();
        track.way += last ? (here - *last).norm() : 0.0;
        track.weak += t->status == TrackStatus::weak ? 1 : 0;
        track.lost += t->status == TrackStatus::lost ? 1 : 0;
        last = here;
    }
    return track;
}

std::string to_text(const Track& track) {
    return fmt::format("the odometry went {:.1f} m", track.way);
}

/// Why poses that the odometry found are not to be trusted, among the losses of the recording.
/// Given poses bind scans that do not show their motion.
void add_doubts(io::Recording& recording, const Track& track) {
    constexpr double kManyWeak = 0.5;  // share of the scans
    std::vector<std::string> doubts;
    if (track.lost > 0) {
        doubts.push_back(fmt::format(
            "{} scans do not fit those before them, so their poses are guesses", track.lost));
    }
    if (!recording.info().has_poses &&
        static_cast<double>(track.weak) > kManyWeak * static_cast<double>(recording.size())) {
        doubts.push_back(
            fmt::format("{} of {} scans do not show how far the sensor went in some direction, "
                        "so their poses may be far off along it; give poses with --poses FILE",
                        track.weak, recording.size()));
    }
    if (!doubts.empty()) recording = io::with_losses(recording, doubts);
}

/// What the first scan shows of how its points were made.
std::vector<std::string> notes_on_points(const io::Recording& recording) {
    std::vector<std::string> notes;
    try {
        const io::FullScan scan = recording.read(0);
        if (scan.no_returns > 0) {
            notes.push_back(fmt::format(
                "{:.1f} % of the points of the first scan lie on a sphere around the sensor: they "
                "stand for beams without a return, and are left out",
                100.0 * static_cast<double>(scan.no_returns) /
                    static_cast<double>(scan.points.size())));
        }
        const float side = thinning_of(scan.points);
        if (side > 0.0F) {
            notes.push_back(fmt::format(
                "the points of the first scan are about {:.2f} m apart near the sensor too: a "
                "voxel filter has thinned the scans; the filter allows for it, but finds more of "
                "what moves in the scans as measured",
                static_cast<double>(side)));
        }
    } catch (const InputError&) {  // scans that cannot be read are rejected later, with the reason
    }
    return notes;
}

/// What moves with the sensor is left out of the recording afterwards. Returns a note, or "".
std::string leave_out_body(io::Recording& recording) {
    const io::OwnBody body = io::find_own_body(io::as_measured(recording));
    if (body.boxes.empty()) return "";
    recording = io::with_own_body(recording, body.boxes);
    Eigen::AlignedBox3f around;
    for (const Eigen::AlignedBox3f& box : body.boxes) around.extend(box);
    const Point low = around.min(), high = around.max();
    return fmt::format(
        "own body: {:.1f} % of the points, at x {:.1f} to {:.1f} m, y {:.1f} to {:.1f} m, z {:.1f} "
        "to {:.1f} m from the sensor, move with it; they are left out and labelled dynamic "
        "(--mask none keeps them, --mask FILE names other boxes)",
        100.0 * body.share, low.x(), high.x(), low.y(), high.y(), low.z(), high.z());
}

/// Poses of all scans, and what they rest on. The recording has them afterwards.
void use_found_poses(io::Recording& recording, const Config& config, const MotionChoice& choice,
                     ChosenMotion& chosen) {
    Progress progress("odometry", recording.size(), choice.quiet);
    io::PosesChoice found =
        io::choose_poses(recording, config.odometry, choice.refine == "on", [&] {
            progress.advance();
            return !interrupted();
        });
    for (std::string& note : found.notes) chosen.notes.push_back(std::move(note));
    if (found.tracked.empty()) return;
    const auto is_known = [](const auto& pose) { return pose.has_value(); };
    if (std::none_of(found.tracked.begin(), found.tracked.end(), is_known)) {
        throw InputError(recording.info().root, "", "no scan is usable");
    }
    chosen.notes.push_back(use_track(recording, found.tracked));
    chosen.tracked = std::move(found.tracked);
}

/// With times that make scans overlay better; a note says so.
void undo_motion(io::Recording& recording, const io::TimesChoice& times, bool timed,
                 ChosenMotion& chosen) {
    recording = io::deskewed(io::as_measured(recording), times.sweep);
    chosen.notes.push_back(fmt::format(
        "scans blur by {} as they are and by {} with the motion during each scan undone by "
        "{}{}, so it is undone; --deskew off leaves it",
        centimetres(times.blur.as_measured), centimetres(times.blur.undone),
        source_of(*times.sweep, timed), stamp_text(*times.sweep, timed)));
}

/// Poses that were found for the scans of the first sensor place all sensors of a rig.
void place_rig(io::Recording& recording, const io::Recording& first, ChosenMotion& chosen) {
    chosen.tracked = io::tracked_for_all(recording, chosen.tracked);
    if (first.parts().with_times) recording = io::with_times(recording, first.info().sweep);
    use_track(recording, chosen.tracked);
}

/// Whether the motion during scans is undone, by the first of several sensors whose points have
/// times; guesses of these times, by the order of points or their azimuths, would be those of one
/// sensor only.
void undo_motion_of_several(io::Recording& recording, const std::vector<io::Recording>& sensors,
                            const Config& config, const std::string& deskew, ChosenMotion& chosen) {
    if (deskew == "off" || recording.info().deskewed) return;
    const auto timed =
        std::find_if(sensors.begin(), sensors.end(),
                     [](const io::Recording& sensor) { return has_times(io::with_times(sensor)); });
    if (timed == sensors.end()) {
        if (deskew == "on") add_not_undone(recording);
        return;
    }
    io::MotionLook look(*timed, config.odometry, deskew);
    const io::TimesChoice& times = look.times();
    if (!times.sweep) return;
    undo_motion(recording, times, true, chosen);
}

/// Of several sensors, the first one shows what holds for all. Poses are found and refined for it,
/// if it is known where the others are beside it. No own body is looked for, because each sensor
/// sees it elsewhere.
ChosenMotion choose_for_several(io::Recording& recording, const std::vector<io::Recording>& sensors,
                                Config& config, MotionChoice choice) {
    const bool moves_together = io::knows_places(recording.parts()) && !choice.online;
    const std::string refine = choice.refine, deskew = choice.deskew;
    if (!moves_together) choice.refine = "off";
    if (!moves_together && !recording.info().has_poses) {
        throw InputError(recording.info().root, "",
                         "has no poses; online, odometry follows one sensor alone. Give poses, or "
                         "leave --online out");
    }
    io::Recording first = sensors.front();
    if (!has_times(io::with_times(first))) choice.deskew = "off";
    choice.finds_body = false;
    io::MotionLook look(first, config.odometry, choice.deskew);
    choice.look = &look;
    const std::string doubt = moves_together || refine == "off" ? "" : io::doubt_about_poses(look);
    ChosenMotion chosen = choose_motion(first, config, choice);
    if (!chosen.tracked.empty()) {
        place_rig(recording, first, chosen);
    } else if (first.info().deskewed) {
        recording = io::deskewed(io::as_measured(recording), first.info().sweep);
    } else if (choice.deskew != deskew) {
        undo_motion_of_several(recording, sensors, config, deskew, chosen);
    }
    if (!doubt.empty()) {
        recording = io::with_losses(
            recording, {doubt + "; the poses of several sensors are not refined here: choose the "
                                "clouds of one with --topic TOPIC@FRAME, or say where each sensor "
                                "is in a rig file (docs/rigs.md)"});
    }
    return chosen;
}

}  // namespace

ChosenMotion choose_motion(io::Recording& recording, Config& config, const MotionChoice& choice) {
    const std::vector<io::Recording> sensors = io::by_sensor(recording);
    if (sensors.size() > 1) return choose_for_several(recording, sensors, config, choice);
    ChosenMotion chosen;
    add(chosen.notes, choose_sensor_place(recording));
    for (std::string& note : notes_on_points(recording)) add(chosen.notes, std::move(note));
    const bool has_poses = recording.info().has_poses;
    io::MotionLook own_look(recording, config.odometry, choice.deskew);
    io::MotionLook& look = choice.look == nullptr ? own_look : *choice.look;
    const io::TimesChoice& times = look.times();
    const bool timed = choice.deskew != "off" && has_times(io::with_times(recording));
    bool refines = has_poses && (choice.refine == "on" || config.odometry.refine);
    if (has_poses && choice.refine == "auto" && !refines) {
        const std::string doubt = io::doubt_about_poses(look);
        refines = !doubt.empty();
        if (refines) {
            chosen.notes.push_back(doubt + ", so the poses are refined; --refine off keeps them");
        }
    }
    if (!has_poses) chosen.notes.emplace_back("no poses are used, so they are found by odometry");
    config.odometry.refine = refines && choice.online;
    if (!has_poses || refines) {
        const bool is_distorted =
            timed && choice.deskew == "auto" && look.quality().found.is_distorted();
        add(chosen.notes, choose_deskew(recording, config.odometry, choice, timed, is_distorted));
        if (!choice.online) {
            use_found_poses(recording, config, choice, chosen);
            if (choice.finds_body) add(chosen.notes, leave_out_body(recording));
        }
        return chosen;
    }
    if (times.sweep) {
        undo_motion(recording, times, timed, chosen);
    } else if (choice.deskew == "on" && !recording.info().deskewed) {
        add_not_undone(recording);
    }
    if (choice.finds_body) add(chosen.notes, leave_out_body(recording));
    return chosen;
}

void ensure_poses(io::Recording& recording, const Config& config, const MotionChoice& choice) {
    const bool has_poses = recording.info().has_poses && !recording.info().sparse_poses;
    std::vector<std::string> notes;
    add(notes, choose_sensor_place(recording));
    if (has_poses) {
        for (std::string& note : notes_on_points(recording)) add(notes, std::move(note));
        if (choice.finds_body) add(notes, leave_out_body(recording));
    }
    recording = io::with_notes(recording, notes);
    if (has_poses) return;
    Config chosen = config;
    const auto motion = choose_motion(recording, chosen, choice);
    recording = io::with_notes(recording, motion.notes);
}

std::string use_track(io::Recording& recording,
                      const std::vector<std::optional<Tracked>>& tracked) {
    const Track track = summary_of(tracked);
    add_doubts(recording, track);
    recording = io::with_poses(recording, tracked);
    return to_text(track);
}

void write_poses(const std::filesystem::path& path, const io::Recording& sensor) {
    const io::Recording recording = io::knows_places(sensor.parts())
                                        ? io::with_vehicle_poses(sensor)
                                        : io::with_sensor_at(sensor, Eigen::Vector3d::Zero());
    if (path.extension() == ".tum") {
        io::write_poses_tum(path, recording.info().stamps, recording.info().T_world_sensor);
    } else {
        io::write_poses_kitti(path, recording.info().T_world_sensor);
    }
}

}  // namespace dynamic_filter::app
