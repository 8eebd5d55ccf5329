// SPDX-License-Identifier: MIT
/// The temporally consecutive scans that become one submap (Sec. III-B).
#pragma once

#include <optional>
#include <vector>

#include "dynamic_filter/config.hpp"
#include "dynamic_filter/types.hpp"

namespace dynamic_filter {

/// All scans give points to the submap; its keyframes also observe. Thinning the observers, not the
/// points, lets a window span the seconds in which people move away (n matters by the time it
/// spans).
struct Window {
    std::vector<Scan> scans;             ///< `T_world_sensor` is relative to the map frame here
    std::vector<std::size_t> keyframes;  ///< indices into scans, ascending; the first is 0
};

/// True if `scan` comes late enough after the last keyframe, or far enough from it, to be one too.
bool is_keyframe(const Scan& last, const Scan& scan, const Config::Submap& config);

/// Cuts a stream of scans into disjoint windows of n keyframes, by stamps and poses of the data,
/// never by the clock. Single caller.
class WindowCutter {
public:
    explicit WindowCutter(const Config::Submap& config) : config_(config) {}

    /// Adds a scan; returns the window before it if this scan starts a new one.
    std::optional<Window> push(Scan scan);
    /// Returns what is left, if anything.
    std::optional<Window> flush();

private:
    Config::Submap config_;
    Window window_;
};

}  // namespace dynamic_filter
