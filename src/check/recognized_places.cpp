// SPDX-License-Identifier: MIT
#include "check/recognized_places.hpp"

#include <algorithm>
#include <optional>

#include "base/degree.hpp"
#include "check/place_offset.hpp"
#include "dynamic_filter/parallel.hpp"

namespace dynamic_filter::io {
namespace {

/// A place of the map that looks like one near a place of the drive.
struct LooksAlike {
    const Local* of_map;
    Likeness likeness;
    Point beside;  // [m] from the place of the drive
};

/// Where a place of the drive lies, if it is that of the map.
std::optional<Found> verified(const Local& of_drive, const LooksAlike& alike) {
    constexpr double kTilt = 3.0 * kDegree;  // worlds of their own may lean
    const Eigen::AngleAxisd turn(alike.likeness.turn, Eigen::Vector3d::UnitZ());
    const Pose start = turn * Eigen::Translation3d(-alike.beside.cast<double>());
    const Local& of_map = *alike.of_map;
    const auto offset =
        register_clouds(of_map.cloud, moved(of_drive.cloud, start), of_map.at, kTilt);
    if (!offset || !offset->fits()) return std::nullopt;
    const Pose motion = Eigen::Translation3d(of_map.at) * offset->motion * start *
                        Eigen::Translation3d(-of_drive.at);
    return Found{&of_drive, motion, offset->fit};
}

/// The places of the map that look most like one of the drive, and lie on it. Another lane is some
/// metres beside, so the drive's place is also looked at from there.
std::vector<Found> find_on(const std::vector<Local>& map, const Local& of_drive) {
    constexpr std::size_t kVerified = 12;
    constexpr float kLane = 3.5F;  // [m]
    std::vector<LooksAlike> alike;
    for (const Local& of_map : map) alike.push_back({&of_map, {}, Point::Zero()});
    for (const Point& beside : {Point(0, 0, 0), Point(kLane, 0, 0), Point(-kLane, 0, 0),
                                Point(0, kLane, 0), Point(0, -kLane, 0)}) {
        const PlaceSignature here =
            signature_of(moved(of_drive.cloud, Pose(Eigen::Translation3d(-beside.cast<double>()))));
        for (LooksAlike& best : alike) {
            const Likeness likeness = likeness_of(best.of_map->signature, here);
            if (likeness.distance < best.likeness.distance) best = {best.of_map, likeness, beside};
        }
    }
    std::sort(alike.begin(), alike.end(), [](const LooksAlike& a, const LooksAlike& b) {
        return a.likeness.distance < b.likeness.distance;
    });
    alike.resize(std::min(alike.size(), kVerified));
    std::vector<Found> found;
    for (const LooksAlike& candidate : alike) {
        if (const auto here = verified(of_drive, candidate)) found.push_back(*here);
    }
    return found;
}

double turn_between(const Pose& a, const Pose& b) {
    return Eigen::AngleAxisd(a.linear().transpose() * b.linear()).angle();
}

/// True if both say nearly the same, allowing for what the drive's own way may have drifted.
bool agree(const Found& a, const Found& b) {
    constexpr double kNear = 2.0, kDrift = 0.05, kTurn = 8.0 * kDegree;  // [m], share, [rad]
    const double way = (a.of_drive->at - b.of_drive->at).norm();
    const double apart = (a.motion * b.of_drive->at - b.motion * b.of_drive->at).norm();
    return apart < kNear + kDrift * way && turn_between(a.motion, b.motion) < kTurn;
}

/// See recognize().
std::vector<Found> agreed(const std::vector<Found>& all) {
    constexpr double kRival = 0.6;  // share of the places
    const auto places_with = [&](const Found& leader, const Found* unlike) {
        std::vector<Found> with;
        for (const Found& other : all) {
            if (!agree(leader, other) || (unlike != nullptr && agree(*unlike, other))) continue;
            const auto same = std::find_if(with.begin(), with.end(), [&](const Found& w) {
                return w.of_drive == other.of_drive;
            });
            if (same == with.end())
                with.push_back(other);
            else if (other.fit > same->fit)
                *same = other;
        }
        return with;
    };
    std::vector<Found> best;
    const Found* leader = nullptr;
    for (const Found& found : all) {
        std::vector<Found> with = places_with(found, nullptr);
        if (with.size() <= best.size()) continue;
        best = std::move(with);
        leader = &found;
    }
    if (best.size() < kFewestOnMap) return {};
    for (const Found& found : all) {
        if (agree(*leader, found)) continue;
        const std::size_t rivals = places_with(found, leader).size();
        if (static_cast<double>(rivals) > kRival * static_cast<double>(best.size())) return {};
    }
    return best;
}

}  // namespace

std::vector<Found> recognize(const std::vector<Local>& map, const std::vector<Local>& drive) {
    std::vector<std::vector<Found>> by_place(drive.size());
    parallel_for(drive.size(), 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t k = begin; k < end; ++k) by_place[k] = find_on(map, drive[k]);
    });
    std::vector<Found> all;
    for (const auto& found : by_place) all.insert(all.end(), found.begin(), found.end());
    return agreed(all);
}

}  // namespace dynamic_filter::io
