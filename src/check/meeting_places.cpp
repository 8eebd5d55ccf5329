// SPDX-License-Identifier: MIT
#include "check/meeting_places.hpp"

#include <tsl/robin_map.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>

#include "base/input.hpp"
#include "base/text.hpp"
#include "dynamic_filter/error.hpp"
#include "formats/clouds/pcd_header.hpp"

namespace dynamic_filter::io {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kPositionStep = 2.0;  // [m] of the way between the positions that are looked at
constexpr std::size_t kFew = 1000;     // positions of which all distances are computed
constexpr double kMostCells = 1e15;    // cells of the hash along one axis, so that they fit 64 bits

/// The position in the VIEWPOINT of a scan file.
Eigen::Vector3d viewpoint_of(const std::filesystem::path& scan, PoseFix fix) {
    constexpr std::size_t kHead = 4096;  // a header has only a few hundred bytes
    try {
        const std::string head = read_head(scan, kHead);
        Lines lines(head, scan);
        const Pose pose = parse_pcd_header(lines).viewpoint.value_or(Pose::Identity());
        return fixed(fix, pose).translation();
    } catch (const InputError&) {
        return Eigen::Vector3d::Constant(kNan);
    }
}

/// Indices of positions that are at least `step` [m] of the way apart.
std::vector<std::size_t> thinned(std::span<const Eigen::Vector3d> positions, double step) {
    std::vector<std::size_t> kept;
    for (std::size_t i = 0; i < positions.size(); ++i) {
        if (!positions[i].allFinite()) continue;
        if (!kept.empty() && (positions[i] - positions[kept.back()]).norm() < step) continue;
        kept.push_back(i);
    }
    return kept;
}

double flat_distance(const Eigen::Vector3d& p, const Eigen::Vector3d& q) {
    return (p - q).head<2>().norm();
}

/// Positions in cells of kMeetingDistance, so that the near ones are found without looking at all.
class NearPositions {
public:
    NearPositions(std::span<const Eigen::Vector3d> positions,
                  const std::vector<std::size_t>& chosen)
        : positions_(positions) {
        for (const std::size_t i : chosen) {
            const auto [x, y] = cell_of_position(positions[i]);
            cells_[key(x, y)].push_back(i);
        }
    }
    /// The nearest position in space, of those within kMeetingDistance seen from above. Roads may
    /// lie above each other, so the height decides between positions.
    [[nodiscard]] std::optional<std::size_t> nearest(const Eigen::Vector3d& place) const {
        std::optional<std::size_t> best;
        double least = std::numeric_limits<double>::infinity();
        const auto [x, y] = cell_of_position(place);
        for (std::int64_t dx = -1; dx <= 1; ++dx) {
            for (std::int64_t dy = -1; dy <= 1; ++dy) {
                const auto cell = cells_.find(key(x + dx, y + dy));
                if (cell == cells_.end()) continue;
                for (const std::size_t i : cell->second) {
                    const double distance = (positions_[i] - place).squaredNorm();
                    const bool near = flat_distance(positions_[i], place) <= kMeetingDistance;
                    if (!near || distance >= least) continue;
                    least = distance;
                    best = i;
                }
            }
        }
        return best;
    }

private:
    static std::pair<std::int64_t, std::int64_t> cell_of_position(const Eigen::Vector3d& p) {
        const auto along = [](double v) {
            const double cell = std::floor(v / kMeetingDistance);
            return static_cast<std::int64_t>(std::clamp(cell, -kMostCells, kMostCells));
        };
        return {along(p.x()), along(p.y())};
    }
    /// Different cells may share a key; the distances tell their positions apart.
    static std::uint64_t key(std::int64_t x, std::int64_t y) {
        return static_cast<std::uint64_t>(x) * 0x9E3779B97F4A7C15ULL ^
               static_cast<std::uint64_t>(y) * 0xC2B2AE3D27D4EB4FULL;
    }
    std::span<const Eigen::Vector3d> positions_;
    tsl::robin_map<std::uint64_t, std::vector<std::size_t>> cells_;
};

/// Smallest distance of some positions of both drives; infinite if there are none.
double coarse_gap(std::span<const Eigen::Vector3d> a, std::span<const Eigen::Vector3d> b,
                  const std::vector<std::size_t>& of_a, const std::vector<std::size_t>& of_b) {
    double gap = std::numeric_limits<double>::infinity();
    const std::size_t step_a = of_a.size() / kFew + 1, step_b = of_b.size() / kFew + 1;
    for (std::size_t i = 0; i < of_a.size(); i += step_a) {
        for (std::size_t j = 0; j < of_b.size(); j += step_b) {
            gap = std::min(gap, flat_distance(a[of_a[i]], b[of_b[j]]));
        }
    }
    return gap;
}

/// Farthest-point sampling: each place is the one farthest from those chosen before.
std::vector<MeetingPlace> spread_out(const std::vector<MeetingPlace>& all,
                                     std::span<const Eigen::Vector3d> b, std::size_t most) {
    constexpr double kLeastApart = 3.0;  // [m]
    std::vector<MeetingPlace> chosen;
    std::vector<double> far(all.size(), std::numeric_limits<double>::infinity());
    std::size_t next = 0;
    while (!all.empty() && chosen.size() < most) {
        chosen.push_back(all[next]);
        for (std::size_t i = 0; i < all.size(); ++i) {
            far[i] = std::min(far[i], flat_distance(b[all[i].in_b], b[all[next].in_b]));
        }
        next = static_cast<std::size_t>(std::max_element(far.begin(), far.end()) - far.begin());
        if (far[next] < kLeastApart) break;
    }
    return chosen;
}

}  // namespace

Positions positions_of(const Recording& recording) {
    Positions positions(recording.size(), Eigen::Vector3d::Constant(kNan));
    if (!recording.info().has_poses) return positions;
    for (std::size_t i = 0; i < recording.size(); ++i) {
        positions[i] =
            i < recording.info().T_world_sensor.size()
                ? Eigen::Vector3d(recording.info().T_world_sensor[i].translation())
                : viewpoint_of(recording.info().scan_files[i], recording.info().pose_fix);
    }
    return positions;
}

Meeting find_meeting(std::span<const Eigen::Vector3d> a, std::span<const Eigen::Vector3d> b,
                     std::size_t most) {
    const std::vector<std::size_t> of_a = thinned(a, 0.25 * kPositionStep),
                                   of_b = thinned(b, kPositionStep);
    const NearPositions near(a, of_a);
    Meeting meeting;
    meeting.gap = std::numeric_limits<double>::infinity();
    std::vector<MeetingPlace> all;
    for (const std::size_t in_b : of_b) {
        const auto in_a = near.nearest(b[in_b]);
        if (!in_a) continue;
        all.push_back({*in_a, in_b});
        meeting.gap = std::min(meeting.gap, flat_distance(a[*in_a], b[in_b]));
    }
    if (all.empty()) meeting.gap = coarse_gap(a, b, of_a, of_b);
    meeting.passes = all.size();
    meeting.places = spread_out(all, b, most);
    return meeting;
}

std::vector<double> way_of(const Positions& positions) {
    std::vector<double> way(positions.size(), 0.0);
    std::size_t last = 0;
    for (std::size_t i = 1; i < positions.size(); ++i) {
        const double step = (positions[i] - positions[last]).norm();
        way[i] = way[i - 1] + (std::isfinite(step) ? step : 0.0);
        if (positions[i].allFinite()) last = i;
    }
    return way;
}

std::vector<std::size_t> scans_around(std::span<const Eigen::Vector3d> positions,
                                      std::size_t middle, double step, std::size_t count) {
    std::vector<std::size_t> chosen;
    const auto walk = [&](int direction) {
        std::size_t last = middle;
        std::size_t i = middle;
        for (std::size_t taken = 0; taken < count;) {
            const bool at_end = direction < 0 ? i == 0 : i + 1 == positions.size();
            if (at_end) return;
            i = direction < 0 ? i - 1 : i + 1;
            // Written so that a position that is not finite is passed over.
            if (!((positions[i] - positions[last]).norm() >= step)) continue;
            chosen.push_back(i);
            last = i;
            ++taken;
        }
    };
    walk(-1);
    std::reverse(chosen.begin(), chosen.end());
    chosen.push_back(middle);
    walk(1);
    return chosen;
}

}  // namespace dynamic_filter::io
