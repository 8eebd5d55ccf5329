// SPDX-License-Identifier: MIT
/// The scan-to-map front-end (Sec. III-B): it turns a window of scans into a static submap.
#pragma once

#include <optional>
#include <vector>

#include "dynamic_filter/range_image.hpp"
#include "dynamic_filter/settings.hpp"
#include "dynamic_filter/stage_times.hpp"
#include "paper/submap.hpp"
#include "paper/window.hpp"

namespace dynamic_filter {

struct FrontEndResult {
    Submap submap;
    std::vector<Labels> labels;  ///< instant verdicts, per scan and point of the window
};

/// Size [rad] of a pixel of a range image: at least `least_deg` [deg], and at least `beams` times
/// the angle between the beams of the sensor. An image finer than the beams has holes, and a hole
/// is no evidence.
float pixel_step(double least_deg, double beams, float beam_spacing);

/// Single caller; uses threads only by parallel_for. Between calls it keeps only the beam pattern
/// of the sensor, which it measures on the first window.
class FrontEnd {
public:
    explicit FrontEnd(const Config& config) : config_(config) {}

    /// Removes points by visibility, reverts some of them by the map, and collects the static
    /// submap (Sec. III-B).
    FrontEndResult process(const Window& window, StageTimes& times);

    /// Beam pattern of the sensor; empty before the first window.
    [[nodiscard]] const std::optional<BeamPattern>& beams() const { return beams_; }

private:
    std::vector<RangeImage> images(const Window& window, float scale) const;
    void revert(const Window& window, std::vector<Labels>& labels) const;
    std::vector<Labels> remove_and_revert(const Window& window) const;  // used by Removert

    Config config_;
    std::optional<BeamPattern> beams_;
};

}  // namespace dynamic_filter
