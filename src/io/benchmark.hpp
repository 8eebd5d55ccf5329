// SPDX-License-Identifier: MIT
/// What is peculiar to DynamicMap_Benchmark: poses in VIEWPOINT, ground truth in the intensity.
#pragma once

#include "dynamic_filter/io/sequence.hpp"
#include "layout.hpp"

namespace dynamic_filter::io {

/// Throws InputError if several scans have no pose but the identity; notes it for a single one.
void require_viewpoints(Sequence& sequence);

/// Sets `intensity_is_truth`: a gt_cloud.pcd is there, or all intensities are 0 or 1 and not all 0.
void find_intensity_truth(Sequence& sequence, const Layout& layout);

}  // namespace dynamic_filter::io
