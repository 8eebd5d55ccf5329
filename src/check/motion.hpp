// SPDX-License-Identifier: MIT
/// What is done about poses that are missing or bad, and about motion during scans.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "check/motion_look.hpp"
#include "dynamic_filter/recording.hpp"
#include "dynamic_filter/settings.hpp"

namespace dynamic_filter::app {

/// How the motion of a recording is to be treated: "auto", "on" or "off" each.
struct MotionChoice {
    std::string refine = "auto", deskew = "auto";
    /// True: poses are found or refined scan by scan, while the scans are judged.
    bool online = false;
    bool quiet = true;               ///< false: shows how far the odometry is
    bool finds_body = false;         ///< true: what moves with the sensor is found and left out
    io::MotionLook* look = nullptr;  ///< of the same recording and deskew, to measure nothing twice
};

/// What was decided about the motion of a recording.
struct ChosenMotion {
    std::vector<std::string> notes;                 ///< what was decided and why, a sentence each
    std::vector<std::optional<Tracked>> tracked{};  ///< by scan; empty: no poses were found
};

/// For a run: finds or refines poses where that is needed, and undoes the motion during scans. With
/// "auto", scans decide: those of some places are looked at, and good poses stay as they are.
/// Afterwards the recording has the poses. Online, `config.odometry.refine` says what is left to
/// do.
ChosenMotion choose_motion(io::Recording& recording, Config& config, const MotionChoice& choice);

/// For whatever needs poses: if the recording lacks some, they are found by odometry, and notes of
/// the recording say how far that got. The own body is found as well, if `choice` says so.
void ensure_poses(io::Recording& recording, const Config& config, const MotionChoice& choice);

/// The recording has these poses afterwards, by scan; what makes them doubtful is among its losses.
/// Returns how far the odometry got, in a sentence.
std::string use_track(io::Recording& recording, const std::vector<std::optional<Tracked>>& tracked);

/// The recording's poses, of the frame of the points of its files, or of the vehicle if the
/// recording is a rig: .tum with stamps, otherwise KITTI's rows.
void write_poses(const std::filesystem::path& path, const io::Recording& sensor);

}  // namespace dynamic_filter::app
