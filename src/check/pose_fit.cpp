// SPDX-License-Identifier: MIT
#include "check/pose_fit.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <vector>

#include "check/pieces.hpp"
#include "dynamic_filter/parallel.hpp"
#include "tracking/overlay_blur.hpp"
#include "tracking/upright.hpp"

namespace dynamic_filter::io {
namespace {

constexpr std::size_t kFitPlaces = 5, kFitInARow = 21;

/// Mean over the pieces that are long enough.
PoseFit mean_of(const std::vector<PoseFit>& fits) {
    PoseFit mean;
    for (std::size_t k = 0; k < mean.overlay.size(); ++k) {
        double count = 0.0;
        for (const PoseFit& fit : fits) {
            mean.overlay[k] += fit.overlay[k];
            count += fit.overlay[k] > 0.0 ? 1.0 : 0.0;
        }
        if (count > 0.0) mean.overlay[k] /= count;
    }
    for (const PoseFit& fit : fits) mean.blur += fit.blur / static_cast<double>(fits.size());
    return mean;
}

template <class PoseAt>
PoseFit mean_fit(const FitScans& scans, const OdometryConfig& config, const PoseAt& pose_at) {
    std::vector<PoseFit> fits(scans.places.size());
    parallel_for(fits.size(), 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t k = begin; k < end; ++k) {
            const FitScans::Place& place = scans.places[k];
            std::vector<Pose> poses;
            for (const Scan& scan : place.scans) poses.push_back(pose_at(scan));
            fits[k] = fit_of(place.scans, place.upright, poses, config);
        }
    });
    return fits.empty() ? PoseFit{} : mean_of(fits);
}

}  // namespace

double PoseFit::mean_overlay() const {
    double sum = 0.0, count = 0.0;
    for (const double share : overlay) {
        sum += share;
        count += share > 0.0 ? 1.0 : 0.0;
    }
    return count > 0.0 ? sum / count : 0.0;
}

std::vector<Points> upright_of(std::span<const Scan> scans) {
    std::vector<Points> upright;
    for (const Scan& scan : scans) upright.push_back(upright_points(scan.points));
    return upright;
}

PoseFit fit_of(std::span<const Scan> scans, std::span<const Points> upright,
               std::span<const Pose> T_world_sensor, const OdometryConfig& config) {
    PoseFit fit;
    for (std::size_t k = 0; k < fit.overlay.size(); ++k) {
        const std::size_t apart = PoseFit::kApart[k];
        double sum = 0.0, count = 0.0;
        for (std::size_t i = apart; i < scans.size(); ++i) {
            sum += upright_overlay(upright[i - apart], upright[i],
                                   T_world_sensor[i - apart].inverse() * T_world_sensor[i]);
            count += 1.0;
        }
        if (count > 0.0) fit.overlay[k] = sum / count;
    }
    fit.blur = overlay_blur(scans, T_world_sensor, config);
    return fit;
}

FitScans read_fit_scans(const Recording& recording, const OdometryConfig& config) {
    FitScans result;
    for (Piece& piece : read_pieces(recording, kFitPlaces, kFitInARow)) {
        result.places.push_back({std::move(piece), {}});
    }
    parallel_for(result.places.size(), 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t k = begin; k < end; ++k) {
            FitScans::Place& place = result.places[k];
            place.upright = upright_of(place.scans);
            place.scans = thinned_piece(place.scans, config);
        }
    });
    return result;
}

PoseFit fit_of(const FitScans& scans, const OdometryConfig& config) {
    return mean_fit(scans, config, [](const Scan& scan) { return scan.T_world_sensor; });
}

PoseFit fit_of(const FitScans& scans, std::span<const Pose> T_world_sensor,
               const OdometryConfig& config) {
    return mean_fit(scans, config, [&](const Scan& scan) { return T_world_sensor[scan.index]; });
}

bool is_better(const PoseFit& fit, const PoseFit& than) {
    constexpr double kMore = 1.05, kAsMany = 0.97;  // factors of the overlay
    constexpr double kSharper = 0.97;               // factor of the blur
    const double share = fit.mean_overlay(), other = than.mean_overlay();
    if (share > kMore * other) return fit.blur < than.blur / kSharper;
    return share > kAsMany * other && fit.blur < kSharper * than.blur;
}

std::string to_text(const PoseFit& fit) {
    std::vector<std::string> shares, apart;
    for (std::size_t k = 0; k < fit.overlay.size(); ++k) {
        if (fit.overlay[k] <= 0.0) continue;
        shares.push_back(fmt::format("{:.0f}", 100.0 * fit.overlay[k]));
        apart.push_back(std::to_string(PoseFit::kApart[k]));
    }
    return fmt::format("{} % ({} scans apart), blur {:.1f} cm", fmt::join(shares, ", "),
                       fmt::join(apart, ", "), 100.0 * fit.blur);
}

}  // namespace dynamic_filter::io
