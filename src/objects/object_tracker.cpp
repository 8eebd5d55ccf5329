// SPDX-License-Identifier: MIT
#include "objects/object_tracker.hpp"

#include "base/numbers.hpp"
#include "geometry/angle.hpp"
#include "objects/pieces.hpp"

#include <algorithm>
#include <limits>
#include <map>

namespace dynamic_filter::app {

namespace {

constexpr double kCell = 0.2;        // [m] of pieces
constexpr std::size_t kFewest = 5;   // points of a new object
constexpr double kLongestGap = 2.0;  // [s] without a sighting
constexpr double kNear = 0.4;        // [m] that an object may be off by
constexpr double kTurns = 0.5;       // share of its way that it may be off by, and [m/s]
constexpr double kFastest = 12.0;    // [m/s] of what was seen once
constexpr double kFarthest = 4.0;    // [m] that any object may be off by
constexpr double kSlow = 0.5;        // [m/s] below which a direction tells little
constexpr double kLarger = 0.4;      // [m] by which two are larger than one
constexpr std::size_t kRecent = 5;   // sightings that tell what an object is like now

double gap(const Eigen::AlignedBox3d& a, const Eigen::AlignedBox3d& b) {
    return a.exteriorDistance(b);
}

Eigen::Vector3d flat(const Eigen::Vector3d& v) { return {v.x(), v.y(), 0.0}; }

/// Whether a box exceeds an extent by so much that two objects must be in it.
bool is_larger(const Eigen::AlignedBox3d& box, const Eigen::Vector3d& extent) {
    return (box.sizes() - extent).head<2>().maxCoeff() > kLarger;
}

/// Extent of a box along a direction in the plane.
struct Extent {
    double low, high;
    [[nodiscard]] double length() const { return high - low; }
};
Extent along(const Eigen::AlignedBox3d& box, const Eigen::Vector3d& direction) {
    const double middle = box.center().dot(direction);
    const double half = 0.5 * box.sizes().dot(direction.cwiseAbs());
    return {middle - half, middle + half};
}
double overlap(const Extent& a, const Extent& b) {
    return std::min(a.high, b.high) - std::max(a.low, b.low);
}

/// The median over the last scans, because a box is too large where two objects touched.
Eigen::Vector3d usual_extent(const MovingObject& object) {
    const std::size_t count = std::min(kRecent, object.sightings.size());
    Eigen::Vector3d extent;
    for (int axis = 0; axis < 3; ++axis) {
        std::vector<double> sizes;
        for (std::size_t back = 1; back <= count; ++back) {
            sizes.push_back(object.sightings[object.sightings.size() - back].box.sizes()[axis]);
        }
        extent[axis] = median(std::move(sizes));
    }
    return extent;
}

/// Whether two objects stayed in place to each other over the last three scans.
bool keep_company(const MovingObject& a, const MovingObject& b) {
    constexpr std::size_t kScans = 3;
    constexpr double kShift = 0.4;  // [m]
    if (std::min(a.sightings.size(), b.sightings.size()) < kScans) return false;
    bool is_same_scan = true;
    const auto apart = [&](std::size_t back) {
        const Sighting& then_a = a.sightings[a.sightings.size() - 1 - back];
        const Sighting& then_b = b.sightings[b.sightings.size() - 1 - back];
        is_same_scan &= then_a.scan == then_b.scan;
        return flat(then_b.box.center() - then_a.box.center());
    };
    const Eigen::Vector3d now = apart(0);
    return (apart(1) - now).norm() <= kShift && (apart(2) - now).norm() <= kShift && is_same_scan;
}

/// Two sides of a vehicle, one of them seen through its windows.
bool are_abreast(const MovingObject& a, const MovingObject& b) {
    constexpr double kWide = 2.8, kShare = 0.5;  // [m] of a bus
    const Eigen::AlignedBox3d &box_a = a.sightings.back().box, &box_b = b.sightings.back().box;
    const Eigen::Vector3d heading = a.velocity.normalized(), side{-heading.y(), heading.x(), 0.0};
    const Extent long_a = along(box_a, heading), long_b = along(box_b, heading);
    return overlap(long_a, long_b) > kShare * std::min(long_a.length(), long_b.length()) &&
           along(box_a.merged(box_b), side).length() < kWide;
}

/// Whether two objects are parts of one vehicle: they move in place to each other, and are closer
/// than two things that fast would be, or larger than people.
bool are_one(const MovingObject& a, const MovingObject& b) {
    constexpr double kDrives = 0.8, kFast = 3.0, kPerson = 2.5, kFastGap = 1.2, kSlowGap = 0.6;
    const double speed = std::min(a.velocity.norm(), b.velocity.norm());
    if (speed < kDrives) return false;
    if (!keep_company(a, b)) return false;
    const double apart = gap(a.sightings.back().box, b.sightings.back().box);
    if (speed > kFast && apart < kFastGap) return true;
    const auto length = [](const MovingObject& o) { return usual_extent(o).head<2>().maxCoeff(); };
    if (std::max(length(a), length(b)) < kPerson) return false;
    return apart < kSlowGap || are_abreast(a, b);
}

/// Fills in velocity and heading of the newest sighting, and of those before it that could not know
/// them.
void note_motion(MovingObject& object) {
    std::vector<Sighting>& sightings = object.sightings;
    sightings.back().velocity = object.velocity;
    if (sightings.size() == 2) sightings.front().velocity = object.velocity;
    if (object.velocity.norm() < kSlow) {
        if (object.went) sightings.back().heading = sightings[sightings.size() - 2].heading;
        return;
    }
    const double heading =
        angle_of(static_cast<float>(object.velocity.y()), static_cast<float>(object.velocity.x()));
    sightings.back().heading = heading;
    if (object.went) return;
    object.went = true;
    for (Sighting& before : sightings) before.heading = heading;
}

/// An object, where it should be by now.
struct Candidate {
    std::uint32_t object;
    Eigen::AlignedBox3d box;
    double slack;                    // [m]
    Eigen::Vector3d largest, usual;  // [m] extents
    bool was_seen_once;

    /// How badly a piece continues it; infinite if it cannot.
    [[nodiscard]] double cost(const Piece& piece) const {
        const double apart = gap(box, piece.box);
        const double away = flat(box.center() - piece.box.center()).norm();
        const bool fits = was_seen_once ? away <= slack : apart <= slack;
        return fits ? apart + 0.3 * away : std::numeric_limits<double>::infinity();
    }
};

Candidate candidate(std::uint32_t number, const MovingObject& object, double stamp) {
    const Sighting& last = object.sightings.back();
    const double since = stamp - last.stamp;
    const bool once = object.sightings.size() == 1;
    const double unsure =
        once ? kFastest * since : kTurns * (object.velocity.norm() * since + since);
    Eigen::AlignedBox3d box = last.box;
    box.translate(Eigen::Vector3d(object.velocity * since));
    return {number, box, std::min(kNear + unsure, kFarthest), object.largest, usual_extent(object),
            once};
}

/// The objects that go on as each piece, in the order of the pieces.
using Claims = std::vector<std::vector<const Candidate*>>;
Claims claims_on(const std::vector<Piece>& pieces, const std::vector<Candidate>& candidates) {
    struct Pair {
        double cost;
        std::size_t piece;
        std::size_t candidate;
    };
    std::vector<Pair> pairs;
    for (std::size_t p = 0; p < pieces.size(); ++p) {
        for (std::size_t c = 0; c < candidates.size(); ++c) {
            const double cost = candidates[c].cost(pieces[p]);
            if (std::isfinite(cost)) pairs.push_back({cost, p, c});
        }
    }
    std::stable_sort(pairs.begin(), pairs.end(),
                     [](const Pair& a, const Pair& b) { return a.cost < b.cost; });
    // First each object takes the piece that continues it best and that nobody took; what was seen
    // once comes last.
    Claims claims(pieces.size());
    std::vector<bool> has_piece(candidates.size());
    const auto take = [&](const Pair& pair) {
        claims[pair.piece].push_back(&candidates[pair.candidate]);
        has_piece[pair.candidate] = true;
    };
    for (const bool once : {false, true}) {
        for (const Pair& pair : pairs) {
            if (candidates[pair.candidate].was_seen_once != once) continue;
            if (!has_piece[pair.candidate] && claims[pair.piece].empty()) take(pair);
        }
    }
    for (const Pair& pair : pairs) {
        const Candidate& c = candidates[pair.candidate];
        if (c.was_seen_once) continue;
        auto& others = claims[pair.piece];
        if (others.empty()) {  // a second part of an object that is hidden in the middle
            Eigen::AlignedBox3d both = c.box;
            if (!is_larger(both.extend(pieces[pair.piece].box), c.largest)) take(pair);
        } else if (!has_piece[pair.candidate] && c.box.intersects(pieces[pair.piece].box)) {
            // Two that walk side by side.
            const bool is_two = std::all_of(others.begin(), others.end(), [&](const auto* other) {
                return is_larger(pieces[pair.piece].box, other->usual);
            });
            if (is_two) take(pair);
        }
    }
    return claims;
}

/// Each point goes to the object whose box is nearest.
void divide(const Piece& piece, std::span<const Candidate* const> claims,
            std::span<const Eigen::Vector3d> places, std::vector<std::uint32_t>& owners) {
    if (claims.size() == 1) {
        for (const std::uint32_t i : piece.points) owners[i] = claims.front()->object;
        return;
    }
    for (const std::uint32_t i : piece.points) {
        const auto cost = [&](const Candidate* c) {
            return c->box.exteriorDistance(places[i]) +
                   0.01 * flat(places[i] - c->box.center()).norm();
        };
        const Candidate* nearest = *std::min_element(
            claims.begin(), claims.end(),
            [&](const Candidate* a, const Candidate* b) { return cost(a) < cost(b); });
        owners[i] = nearest->object;
    }
}

}  // namespace

bool ObjectTracker::may_go_on(std::uint32_t object) const {
    const MovingObject& o = objects_[object];
    return !o.has_ended && stamp_ - o.sightings.back().stamp <= kLongestGap;
}

const Sighting& ObjectTracker::sighting(std::uint32_t object, std::size_t scan) const {
    const auto& sightings = objects_[object].sightings;
    return *std::partition_point(sightings.begin(), sightings.end(),
                                 [&](const Sighting& s) { return s.scan < scan; });
}

void ObjectTracker::forget(std::uint32_t object, std::size_t scan) {
    auto& sightings = objects_[object].sightings;
    if (sightings.size() <= kRecent) return;
    const auto recent = sightings.end() - static_cast<std::ptrdiff_t>(kRecent);
    sightings.erase(sightings.begin(),
                    std::partition_point(sightings.begin(), recent,
                                         [&](const Sighting& s) { return s.scan <= scan; }));
}

std::vector<std::uint32_t> ObjectTracker::follow(std::span<const Eigen::Vector3d> places,
                                                 std::size_t scan, double stamp) {
    stamp_ = stamp;
    std::erase_if(open_, [&](std::uint32_t object) { return !may_go_on(object); });
    std::vector<Candidate> candidates;
    for (const std::uint32_t object : open_) {
        candidates.push_back(candidate(object, objects_[object], stamp));
    }
    const std::vector<Piece> pieces = pieces_of(places, kCell);
    const Claims claims = claims_on(pieces, candidates);
    std::vector<std::uint32_t> owners(places.size(), kNoObject);
    for (std::size_t p = 0; p < pieces.size(); ++p) {
        if (!claims[p].empty()) {
            divide(pieces[p], claims[p], places, owners);
        } else if (pieces[p].points.size() >= kFewest) {
            const auto number = static_cast<std::uint32_t>(objects_.size());
            objects_.emplace_back();
            open_.push_back(number);
            for (const std::uint32_t i : pieces[p].points) owners[i] = number;
        }
    }
    note(places, owners, scan);
    return owners;
}

void ObjectTracker::note(std::span<const Eigen::Vector3d> places,
                         const std::vector<std::uint32_t>& owners, std::size_t scan) {
    constexpr double kNewest = 0.5;  // weight of the newest step in the velocity
    std::map<std::uint32_t, Sighting> seen;
    auto at = seen.end();
    for (std::size_t i = 0; i < places.size(); ++i) {
        if (owners[i] == kNoObject) continue;
        if (at == seen.end() || at->first != owners[i]) at = seen.try_emplace(owners[i]).first;
        Sighting& sighting = at->second;
        if (sighting.points == 0) sighting.scan = scan, sighting.stamp = stamp_;
        sighting.box.extend(places[i]);
        ++sighting.points;
    }
    for (const auto& [number, sighting] : seen) {
        MovingObject& object = objects_[number];
        if (!object.sightings.empty()) {
            const Sighting& before = object.sightings.back();
            const double since = std::max(stamp_ - before.stamp, 1e-3);
            const Eigen::Vector3d step = (sighting.box.center() - before.box.center()) / since;
            const double weight = object.sightings.size() == 1 ? 1.0 : kNewest;
            object.velocity += weight * (flat(step) - object.velocity);
        }
        object.largest = object.largest.cwiseMax(sighting.box.sizes());
        object.points += sighting.points;
        object.sightings.push_back(sighting);
        note_motion(object);
    }
    unite(seen);
}

/// The older one of two sides of a vehicle goes on as both.
void ObjectTracker::unite(const std::map<std::uint32_t, Sighting>& seen) {
    for (auto a = seen.begin(); a != seen.end(); ++a) {
        for (auto b = std::next(a); b != seen.end(); ++b) {
            MovingObject &older = objects_[a->first], &younger = objects_[b->first];
            if (older.has_ended || younger.has_ended || !are_one(older, younger)) continue;
            older.sightings.back().box.extend(younger.sightings.back().box);
            older.largest = older.largest.cwiseMax(older.sightings.back().box.sizes());
            younger.has_ended = true;
        }
    }
}

}  // namespace dynamic_filter::app
