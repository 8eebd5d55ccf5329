// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <vector>

#include "dynamic_filter/settings.hpp"
#include "dynamic_filter/types.hpp"

namespace dynamic_filter {

/// True if `scan` is at least `interval` later than the last keyframe, or at least `distance` away
/// from it.
bool is_keyframe(const Scan& last, const Scan& scan, const KeyframeConfig& config);

/// Chooses the keyframes among scans, by their poses and stamps alone. Each of several sensors has
/// keyframes as if it were alone.
class KeyframeChoice {
public:
    explicit KeyframeChoice(const KeyframeConfig& config) : config_(config) {}
    /// True if the scan is a keyframe; the next ones are then compared with it.
    bool take(const Scan& scan);
    [[nodiscard]] const KeyframeConfig& config() const { return config_; }

private:
    KeyframeConfig config_;
    std::vector<std::optional<Scan>> last_;  // by Scan::sensor: only its pose and stamp
};

}  // namespace dynamic_filter
