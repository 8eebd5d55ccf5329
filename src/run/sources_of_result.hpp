// SPDX-License-Identifier: MIT
/// The recordings of a run, to be filtered once more together with others.
#pragma once

#include "recording/drives.hpp"
#include "run/drives_of_result.hpp"
#include "run/placed.hpp"

namespace dynamic_filter::app {

/// Throws InputError if the run left no recording.json for the drive.
Placed placed_of_drive(const DriveOfResult& drive);

/// Throws ConfigError where what the run did with the drive cannot be done again together with
/// other drives. `recording`: as it was opened with `placed.how`.
void refuse_own_world(const DriveOfResult& drive, const Placed& placed,
                      const io::Recording& recording);

/// The recording, with the poses that its run had, where they are not its own.
DriveSource source_of(const DriveOfResult& drive, const Placed& placed);

}  // namespace dynamic_filter::app
