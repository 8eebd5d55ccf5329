// SPDX-License-Identifier: MIT
#include "recording/two_authors.hpp"

#include <algorithm>
#include <cstdint>
#include <vector>

namespace dynamic_filter::io {
namespace {

/// [m] A turn by 1 rad counts as a metre.
double apart(const Pose& a, const Pose& b) {
    return (a.translation() - b.translation()).norm() +
           Eigen::AngleAxisd(a.linear().transpose() * b.linear()).angle();
}

double way_along(const std::vector<Pose>& poses) {
    double way = 0.0;
    for (std::size_t i = 1; i < poses.size(); ++i) way += apart(poses[i - 1], poses[i]);
    return way;
}

/// Between this pose and the next one, the authors are told apart best.
std::size_t widest_step(const std::vector<Pose>& poses) {
    std::size_t longest = 0;
    double most = 0.0;
    for (std::size_t i = 0; i + 1 < poses.size(); ++i) {
        const double step = apart(poses[i], poses[i + 1]);
        if (step <= most) continue;
        most = step;
        longest = i;
    }
    return longest;
}

/// By pose: its author. From the longest step on, forwards and backwards, each pose is of the
/// author whose last pose is nearer.
std::vector<std::uint8_t> authors_of(const std::vector<Pose>& poses) {
    const std::size_t seed = widest_step(poses);
    std::vector<std::uint8_t> authors(poses.size(), 0);
    authors[seed + 1] = 1;
    const auto follow = [&](std::array<std::size_t, 2> last, std::size_t i) {
        authors[i] = apart(poses[last[1]], poses[i]) < apart(poses[last[0]], poses[i]) ? 1 : 0;
        last[authors[i]] = i;
        return last;
    };
    std::array<std::size_t, 2> last = {seed, seed + 1};
    for (std::size_t i = seed + 2; i < poses.size(); ++i) last = follow(last, i);
    last = {seed, seed + 1};
    for (std::size_t i = seed; i-- > 0;) last = follow(last, i);
    return authors;
}

}  // namespace

std::optional<std::array<Trajectory, 2>> split_authors(const Trajectory& poses) {
    constexpr std::size_t kFew = 20;
    constexpr double kShorter = 0.35;  // one author with noise stays above a half
    if (poses.poses.size() < kFew) return std::nullopt;
    const std::vector<std::uint8_t> authors = authors_of(poses.poses);
    std::array<Trajectory, 2> split;
    for (std::size_t i = 0; i < authors.size(); ++i) {
        split[authors[i]].stamps.push_back(poses.stamps[i]);
        split[authors[i]].poses.push_back(poses.poses[i]);
    }
    if (authors.front() == 1) std::swap(split[0], split[1]);
    const std::size_t fewer = std::min(split[0].poses.size(), split[1].poses.size());
    if (20 * fewer < poses.poses.size()) return std::nullopt;
    const double ways = way_along(split[0].poses) + way_along(split[1].poses);
    if (ways > kShorter * way_along(poses.poses)) return std::nullopt;
    return split;
}

}  // namespace dynamic_filter::io
