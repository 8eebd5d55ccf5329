// SPDX-License-Identifier: MIT
/// Properties of DynamicMap_Benchmark: poses in VIEWPOINT, and ground truth in the intensity.
#pragma once

#include "dynamic_filter/recording.hpp"
#include "recording/layout.hpp"

namespace dynamic_filter::io {

/// True if any of the .pcd files has a VIEWPOINT other than the identity.
bool any_has_viewpoint(const Paths& scans);

/// Throws InputError if several scans have no pose except the identity. For a single scan, adds a
/// note.
void require_viewpoints(Info& info);

/// Sets `intensity_is_truth` if there is a gt_cloud.pcd, or if all intensities are 0 or 1 and at
/// least one is 1.
void find_intensity_truth(Info& info, const Layout& layout);

}  // namespace dynamic_filter::io
