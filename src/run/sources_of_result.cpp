// SPDX-License-Identifier: MIT
#include "run/sources_of_result.hpp"

#include "dynamic_filter/error.hpp"

namespace fs = std::filesystem;

namespace dynamic_filter::app {

Placed placed_of_drive(const DriveOfResult& drive) {
    auto placed = read_placed(drive.folder);
    if (!placed) throw InputError(drive.folder, "", "has no recording.json; is it of a run?");
    return *std::move(placed);
}

void refuse_own_world(const DriveOfResult& drive, const Placed& placed,
                      const io::Recording& recording) {
    if (placed.tracked.empty()) return;
    if (!recording.info().has_poses) {
        throw ConfigError(drive.folder.string() +
                          ": the poses of the run are its own odometry, so they begin a world of "
                          "their own; give all recordings poses in one world");
    }
    if (placed.how.first > 0 || placed.how.last || placed.how.stride > 1) {
        throw ConfigError(
            drive.folder.string() +
            ": was refined for a part of its scans (--first, --last, --stride); `run` "
            "all of them, or with --refine off");
    }
}

DriveSource source_of(const DriveOfResult& drive, const Placed& placed) {
    DriveSource source{.recording = drive.recording};
    if (!placed.tracked.empty()) {
        source.poses = fs::absolute(drive.folder / "poses.txt");
    } else if (placed.how.poses) {
        source.poses = placed.how.poses;
    }
    return source;
}

}  // namespace dynamic_filter::app
