// SPDX-License-Identifier: MIT
/// Poses in the VIEWPOINT of PCD files.
#pragma once

#include <filesystem>
#include <optional>

#include "recording/layout.hpp"

namespace dynamic_filter::io {

/// Empty for the identity, for other files than .pcd, and for one that cannot be read, which is
/// rejected when it is read.
std::optional<Pose> viewpoint_of(const std::filesystem::path& scan);

/// If the VIEWPOINT of the scans moves, it gives the poses. Whether the points are in the frame of
/// the world or in that of the sensor, the scans tell, and a note says it.
void use_viewpoints(Layout& layout);

}  // namespace dynamic_filter::io
