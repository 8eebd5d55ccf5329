// SPDX-License-Identifier: MIT
/// The temporally consecutive scans that become one submap (Sec. III-B).
#pragma once

#include <optional>
#include <vector>

#include "dynamic_filter/keyframe.hpp"
#include "dynamic_filter/types.hpp"

namespace dynamic_filter {

/// All scans give points to the submap; its keyframes also observe. Thinning the observers, not the
/// points, lets a window span the seconds in which people move away (n matters by the time it
/// spans).
struct Window {
    std::vector<Scan> scans;             ///< `T_world_sensor` is relative to the map frame here
    std::vector<std::size_t> keyframes;  ///< indices into scans, ascending; the first is 0
};

/// Cuts a stream of scans into disjoint windows of n keyframes, by stamps and poses of the data,
/// never by the clock. Single caller.
class WindowCutter {
public:
    /// `keyframes`: how many make a window.
    WindowCutter(const KeyframeConfig& config, int keyframes)
        : config_(config), keyframes_(static_cast<std::size_t>(keyframes)) {}

    /// Adds a scan; returns the window before it if this scan starts a new one.
    std::optional<Window> push(Scan scan);
    /// Returns what is left, if anything.
    std::optional<Window> flush();
    /// Scans pushed so far.
    [[nodiscard]] std::size_t scans() const { return scans_; }

private:
    KeyframeConfig config_;
    std::size_t keyframes_;
    Window window_;
    std::size_t scans_ = 0;
};

}  // namespace dynamic_filter
