// SPDX-License-Identifier: MIT
#include "check/place_signature.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "base/numbers.hpp"

namespace dynamic_filter::io {
namespace {

using Heights = decltype(PlaceSignature::heights);
constexpr int kRingCount = PlaceSignature::kRings, kSectorCount = PlaceSignature::kSectors;
constexpr float kSeenAround = 40.0F;  // [m]
constexpr float kMostHeight = 4.0F;   // [m] sensors differ in how far up they see
constexpr float kLeastHeight = 0.1F;  // [m] so that the ground is told from nothing

/// Half of 1 less the cosine of the angle between the columns of a and those of b `turn` sectors
/// before them, as a mean over the columns that both have.
double distance_at(const PlaceSignature& a, const PlaceSignature& b, int turn) {
    double sum = 0.0;
    int count = 0;
    for (int sector = 0; sector < kSectorCount; ++sector) {
        const auto of_a = a.heights.col(sector);
        const auto of_b = b.heights.col((sector - turn + kSectorCount) % kSectorCount);
        const float norms = of_a.norm() * of_b.norm();
        if (norms <= 0.0F) continue;
        sum += 1.0 - static_cast<double>(of_a.dot(of_b) / norms);
        ++count;
    }
    return count > 0 ? sum / count : 1.0;
}

}  // namespace

PlaceSignature signature_of(const Points& cloud) {
    constexpr float kNothing = -1e9F;
    Heights high, low;
    high.setConstant(kNothing);
    low.setConstant(-kNothing);
    for (const Point& p : cloud) {
        const float range = p.head<2>().norm();
        if (!(range < kSeenAround)) continue;
        const double turned = std::atan2(p.y(), p.x()) / (2.0 * std::numbers::pi) + 1.0;
        const int ring = static_cast<int>(range / kSeenAround * kRingCount),
                  sector = static_cast<int>(turned * kSectorCount) % kSectorCount;
        high(ring, sector) = std::max(high(ring, sector), p.z());
        low(ring, sector) = std::min(low(ring, sector), p.z());
    }
    std::vector<double> lows;
    for (const float z : low.reshaped()) {
        if (z < -kNothing) lows.push_back(z);
    }
    PlaceSignature signature;
    if (lows.empty()) return signature;
    const auto ground = static_cast<float>(median(std::move(lows)));
    for (int ring = 0; ring < kRingCount; ++ring) {
        for (int sector = 0; sector < kSectorCount; ++sector) {
            if (high(ring, sector) == kNothing) continue;
            signature.heights(ring, sector) =
                std::clamp(high(ring, sector) - ground, kLeastHeight, kMostHeight);
        }
    }
    return signature;
}

Likeness likeness_of(const PlaceSignature& a, const PlaceSignature& b) {
    Likeness best;
    for (int turn = 0; turn < kSectorCount; ++turn) {
        const double distance = distance_at(a, b, turn);
        if (distance >= best.distance) continue;
        best = {distance, turn * 2.0 * std::numbers::pi / kSectorCount};
    }
    return best;
}

}  // namespace dynamic_filter::io
