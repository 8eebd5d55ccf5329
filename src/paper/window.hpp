// SPDX-License-Identifier: MIT
/// Windows of consecutive scans, each of which becomes one submap (Sec. III-B).
#pragma once

#include <optional>
#include <vector>

#include "dynamic_filter/settings.hpp"
#include "dynamic_filter/types.hpp"

namespace dynamic_filter {

/// A window of scans. All scans give points to the submap, but only the keyframes are observers.
/// This lets a window span several seconds, in which people move away, at a limited cost.
struct Window {
    std::vector<Scan> scans;             ///< `T_world_sensor` is relative to the map frame here
    std::vector<std::size_t> keyframes;  ///< indices into `scans`, ascending; the first is 0
};

/// Cuts a stream of scans into disjoint windows of n keyframes. It uses the stamps and poses of the
/// scans, never the time of day, so the windows are reproducible. Single caller.
class WindowCutter {
public:
    /// `keyframes` is the number of keyframes per window.
    WindowCutter(const KeyframeConfig& config, int keyframes)
        : config_(config), keyframes_(static_cast<std::size_t>(keyframes)) {}

    /// Adds a scan. If the scan starts a new window, returns the previous window.
    std::optional<Window> push(Scan scan);
    /// Returns the remaining scans as a window, if there are any.
    std::optional<Window> flush();
    /// Number of scans pushed so far.
    [[nodiscard]] std::size_t scans() const { return scans_; }

private:
    KeyframeConfig config_;
    std::size_t keyframes_;
    Window window_;
    std::size_t scans_ = 0;
};

}  // namespace dynamic_filter
