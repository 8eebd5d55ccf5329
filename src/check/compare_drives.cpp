// SPDX-License-Identifier: MIT
#include "dynamic_filter/check.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/degree.hpp"
#include "check/common_offset.hpp"
#include "check/meeting_places.hpp"
#include "check/place_offset.hpp"
#include "dynamic_filter/parallel.hpp"

namespace dynamic_filter::io {
namespace {

constexpr std::size_t kMostPlaces = 8;
constexpr double kStepA = 4.0, kStepB = 3.0;       // [m] of the way between the scans of a place
constexpr std::size_t kAroundA = 2, kAroundB = 1;  // scans before and after the place
// With one place, a scene that changed or another storey cannot be told from another frame.
constexpr std::size_t kFewestUnlike = 2;
// Number of drives before it with which a drive is compared, so that the time does not grow with
// the number of pairs. Others agree if these do.
constexpr std::size_t kMostCompared = 3;

/// A drive of which the poses are known.
struct Drive {
    std::size_t index = 0;
    const Recording* recording = nullptr;
    Positions positions;
};

bool have_same_poses(const Drive& a, const Drive& b) {
    // Two poses may be equal by chance, such as that of a start.
    constexpr std::size_t kFewest = 3;
    const auto& p = a.recording->info().T_world_sensor;
    const auto& q = b.recording->info().T_world_sensor;
    const auto is_equal = [](const Pose& s, const Pose& t) { return s.matrix() == t.matrix(); };
    return p.size() >= kFewest && std::equal(p.begin(), p.end(), q.begin(), q.end(), is_equal);
}

/// The places at which the clouds show enough; fitting ones and others.
std::vector<PlaceOffset> measure_places(const Drive& a, const Drive& b,
                                        const std::vector<MeetingPlace>& places) {
    std::vector<std::optional<PlaceOffset>> measured(places.size());
    parallel_for(places.size(), 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t k = begin; k < end; ++k) {
            const Eigen::Vector3d at = b.positions[places[k].in_b];
            const auto of_a = scans_around(a.positions, places[k].in_a, kStepA, kAroundA);
            const auto of_b = scans_around(b.positions, places[k].in_b, kStepB, kAroundB);
            measured[k] = register_clouds(cloud_around(*a.recording, of_a, at),
                                          cloud_around(*b.recording, of_b, at), at);
        }
    });
    std::vector<PlaceOffset> known;
    for (const auto& place : measured) {
        if (place) known.push_back(*place);
    }
    return known;
}

/// Takes over the correction as the offset, which is its inverse.
void set_offset(DriveOffset& offset, const CommonOffset& correction,
                const std::vector<PlaceOffset>& fitting) {
    const Eigen::AngleAxisd back(-correction.yaw, Eigen::Vector3d::UnitZ());
    offset.pivot = correction.pivot;
    offset.shift = -(back * correction.shift);
    offset.yaw_deg = -correction.yaw / kDegree;
    offset.agreeing = correction.agreeing();
    offset.spread = *std::max_element(correction.differences.begin(), correction.differences.end());
    offset.least = std::numeric_limits<double>::infinity();
    for (const PlaceOffset& place : fitting) {
        offset.least = std::min(offset.least, place.shift.norm());
        offset.most = std::max(offset.most, place.shift.norm());
    }
}

/// Two drives and where they meet, before their scans are compared.
struct DrivePair {
    DriveOffset offset;
    Meeting meeting;
};

DrivePair pair_of(const Drive& a, const Drive& b) {
    DrivePair pair;
    DriveOffset& offset = pair.offset;
    offset.a = a.index;
    offset.b = b.index;
    if (have_same_poses(a, b)) {
        offset.match = FrameMatch::same_poses;
        return pair;
    }
    pair.meeting = find_meeting(a.positions, b.positions, kMostPlaces);
    offset.gap = pair.meeting.gap;
    const bool meet = !pair.meeting.places.empty();
    if (!meet && std::isfinite(offset.gap)) offset.match = FrameMatch::apart;
    return pair;
}

/// Two drives that fit each other.
DrivePair known_pair(const Drive& a, const Drive& b) {
    DrivePair pair;
    pair.offset.a = a.index;
    pair.offset.b = b.index;
    pair.offset.match = FrameMatch::equal;
    return pair;
}

void measure(DrivePair& pair, const Drive& a, const Drive& b) {
    DriveOffset& offset = pair.offset;
    offset.places = pair.meeting.places.size();
    std::vector<PlaceOffset> places = measure_places(a, b, pair.meeting.places);
    const std::size_t known = places.size();
    std::erase_if(places, [](const PlaceOffset& place) { return !place.fits(); });
    offset.fitting = places.size();
    if (places.empty()) {
        if (known >= kFewestUnlike) offset.match = FrameMatch::unlike;
        return;
    }
    const CommonOffset none = no_offset(places), common = fit_common(places);
    if (none.is_agreed()) {
        offset.match = FrameMatch::equal;
    } else {
        offset.match = common.is_agreed() ? FrameMatch::shifted : FrameMatch::drifting;
    }
    set_offset(offset, common, places);
}

/// The pairs of drive `b` with those drives before it that it meets most.
std::vector<std::size_t> most_met(const std::vector<DrivePair>& pairs) {
    std::vector<std::size_t> order;
    for (std::size_t i = 0; i < pairs.size(); ++i) {
        if (!pairs[i].meeting.places.empty()) order.push_back(i);
    }
    std::stable_sort(order.begin(), order.end(), [&](std::size_t i, std::size_t j) {
        return pairs[i].meeting.passes > pairs[j].meeting.passes;
    });
    if (order.size() > kMostCompared) order.resize(kMostCompared);
    return order;
}

}  // namespace

std::vector<DriveOffset> measure_drive_offsets(std::span<const Recording* const> drives,
                                               std::size_t known) {
    std::vector<Drive> posed;
    for (std::size_t i = 0; i < drives.size(); ++i) {
        if (drives[i]->info().has_poses) posed.push_back({i, drives[i], positions_of(*drives[i])});
    }
    std::vector<DriveOffset> offsets;
    for (std::size_t b = 1; b < posed.size(); ++b) {
        std::vector<DrivePair> pairs;
        for (std::size_t a = 0; a < b; ++a) {
            pairs.push_back(posed[b].index < known ? known_pair(posed[a], posed[b])
                                                   : pair_of(posed[a], posed[b]));
        }
        for (const std::size_t a : most_met(pairs)) measure(pairs[a], posed[a], posed[b]);
        for (const DrivePair& pair : pairs) offsets.push_back(pair.offset);
    }
    return offsets;
}

std::vector<Finding> compare_drives(std::span<const Recording* const> drives) {
    return findings_of(drives, measure_drive_offsets(drives));
}

}  // namespace dynamic_filter::io
