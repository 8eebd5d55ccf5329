// SPDX-License-Identifier: MIT
/// The scan-to-map front-end (Sec. III-B): a window of scans in, a static submap out.
#pragma once

#include <optional>
#include <vector>

#include "dynamic_filter/config.hpp"
#include "dynamic_filter/geometry/range_image.hpp"
#include "dynamic_filter/stage_times.hpp"
#include "dynamic_filter/submaps_observe/submap.hpp"
#include "dynamic_filter/submaps_observe/window.hpp"

namespace dynamic_filter {

struct FrontEndResult {
    Submap submap;
    std::vector<Labels> labels;  ///< per scan and point of the window: the instant verdicts
};

/// Pixel of a range image [rad]: at least `least_deg`, and `beams` spacings of the sensor.
/// Finer images than the beams leave holes, and holes are no evidence.
float pixel_step(double least_deg, double beams, float beam_spacing);

/// Single caller. Knows no threads beyond parallel_for; keeps only the sensor's beam pattern, which
/// it reads off the first window.
class FrontEnd {
public:
    explicit FrontEnd(const Config& config) : config_(config) {}

    /// Sec. III-B: remove by visibility, revert by the map, collect the static submap.
    FrontEndResult process(const Window& window, StageTimes& times);

    /// Empty before the first window.
    [[nodiscard]] const std::optional<BeamPattern>& beams() const { return beams_; }

private:
    std::vector<RangeImage> images(const Window& window, float scale) const;
    void revert(const Window& window, std::vector<Labels>& labels) const;
    std::vector<Labels> remove_and_revert(const Window& window) const;  // Removert

    Config config_;
    std::optional<BeamPattern> beams_;
};

}  // namespace dynamic_filter
