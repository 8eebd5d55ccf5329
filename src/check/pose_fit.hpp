// SPDX-License-Identifier: MIT
/// How well the scans of a recording overlay at its poses: the evidence by which poses are chosen.
#pragma once

#include <array>
#include <span>
#include <string>

#include "check/pieces.hpp"
#include "dynamic_filter/recording.hpp"
#include "dynamic_filter/settings.hpp"

namespace dynamic_filter::io {

struct PoseFit {
    /// Separations of the scans that are overlaid.
    static constexpr std::array<std::size_t, 4> kApart = {1, 5, 10, 20};
    /// 0..1 for each separation: share of the upright structures that stand where those of the
    /// other scan stand; the rest is unexplained. 0: the recording is shorter.
    std::array<double, 4> overlay{};
    double blur = 0.0;  ///< [m] see overlay_blur()

    [[nodiscard]] double mean_overlay() const;
};

/// The upright structures of each scan, for fit_of().
std::vector<Points> upright_of(std::span<const Scan> scans);

/// Of consecutive scans, with their upright structures, at these poses; all parallel.
PoseFit fit_of(std::span<const Scan> scans, std::span<const Points> upright,
               std::span<const Pose> T_world_sensor, const OdometryConfig& config);

/// Scans by which the poses of a recording are judged, with their upright structures.
struct FitScans {
    struct Place {
        Piece scans;  ///< consecutive
        std::vector<Points> upright;
    };
    std::vector<Place> places;
};
/// Reads 21 consecutive scans at up to five places.
FitScans read_fit_scans(const Recording& recording, const OdometryConfig& config);
/// At the poses of the recording that was read, or at others, by index of the scan.
PoseFit fit_of(const FitScans& scans, const OdometryConfig& config);
PoseFit fit_of(const FitScans& scans, std::span<const Pose> T_world_sensor,
               const OdometryConfig& config);

/// True if the scans overlay clearly better than with the other poses: more structures stand on
/// each other and are hardly less sharp, or as many do, and are sharper.
bool is_better(const PoseFit& fit, const PoseFit& than);

/// "74, 69, 66 and 60 % (1, 5, 10 and 20 scans apart), blur 5.2 cm"
std::string to_text(const PoseFit& fit);

}  // namespace dynamic_filter::io
