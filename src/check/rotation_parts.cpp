// SPDX-License-Identifier: MIT
#include "check/rotation_parts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "base/numbers.hpp"
#include "dynamic_filter/error.hpp"

namespace dynamic_filter::io {
namespace {

constexpr int kBins = 72;
constexpr double kBin = 360.0 / kBins;  // [deg]

/// What a scan covers, seen from above [deg].
struct Sector {
    double begin = 0.0, width = 360.0;
};

/// All but the widest gap between the directions that more than a few points have.
Sector sector_of(const Points& points) {
    std::array<std::size_t, kBins> counts{};
    std::size_t all = 0;
    for (const Point& p : points) {
        if (!is_measured(p)) continue;
        const double turn = std::atan2(p.y(), p.x()) / (2.0 * std::numbers::pi) + 0.5;
        ++counts[static_cast<std::size_t>(turn * kBins) % kBins];
        ++all;
    }
    constexpr std::size_t kStray = 1000;  // 0.1 % of the points are stray
    const auto is_empty = [&](int bin) {
        return kStray * counts[static_cast<std::size_t>(bin % kBins)] <= all;
    };
    int widest = 0, end = 0, gap = 0;
    for (int bin = 0; bin < 2 * kBins; ++bin) {
        gap = is_empty(bin) ? std::min(gap + 1, kBins) : 0;
        if (gap <= widest) continue;
        widest = gap;
        end = bin + 1;
    }
    return {kBin * (end % kBins), 360.0 - kBin * widest};
}

/// [deg] From one direction to another, -180 to 180.
double turn_between(double from, double to) { return std::remainder(to - from, 360.0); }

struct Parts {
    std::vector<double> widths, steps;  // [deg] of scans, and from each to the next one
};

void add_place(const Recording& recording, std::size_t first, Parts& parts) {
    constexpr std::size_t kScansOfPlace = 12;
    std::vector<double> begins;
    for (std::size_t i = first; i < std::min(first + kScansOfPlace, recording.size()); ++i) {
        try {
            const Sector sector = sector_of(recording.read(i).points);
            parts.widths.push_back(sector.width);
            begins.push_back(sector.begin);
        } catch (const InputError&) {
            continue;  // a rejected scan
        }
    }
    for (std::size_t i = 1; i < begins.size(); ++i) {
        parts.steps.push_back(turn_between(begins[i - 1], begins[i]));
    }
}

}  // namespace

std::optional<Finding> find_rotation_parts(const Recording& recording) {
    constexpr std::size_t kLooks = 3, kLeast = 6;
    constexpr double kHalf = 200.0, kNarrow = 8.0, kTolerance = 10.0;  // [deg]
    Parts parts;
    for (std::size_t k = 0; k < kLooks; ++k) {
        add_place(recording, k * recording.size() / kLooks, parts);
        // Most sensors see all around or always the same part, which the first place shows.
        if (parts.widths.empty() || median(parts.widths) > kHalf) return std::nullopt;
    }
    if (parts.steps.size() < kLeast) return std::nullopt;
    const double width = median(parts.widths), step = median(parts.steps);
    // Parts may overlap or leave a gap, but not by much.
    if (std::abs(step) < kNarrow || std::abs(std::abs(step) - width) > 0.3 * width + kTolerance) {
        return std::nullopt;
    }
    const auto steady = std::count_if(parts.steps.begin(), parts.steps.end(), [&](double s) {
        return std::abs(turn_between(step, s)) < 0.3 * width + kTolerance;
    });
    if (10 * static_cast<std::size_t>(steady) < 9 * parts.steps.size()) return std::nullopt;
    const double count = std::round(360.0 / std::abs(step));
    return Finding{
        fmt::format("each scan covers {:.0f} degrees of a rotation, and the next one goes on where "
                    "it ends: they are parts of scans",
                    360.0 / count),
        fmt::format("join the {:.0f} parts of each rotation into one scan, or record whole "
                    "rotations with the driver of the sensor",
                    count)};
}

}  // namespace dynamic_filter::io
