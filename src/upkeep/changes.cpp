// SPDX-License-Identifier: MIT
#include "upkeep/changes.hpp"

#include <algorithm>
#include <set>

#include "base/little_endian.hpp"
#include "dynamic_filter/error.hpp"
#include "objects/pieces.hpp"
#include "recording/world_records.hpp"

namespace dynamic_filter::app {

namespace {

constexpr double kTouching = 0.3;  // [m]
constexpr double kVoxel = 0.2;     // [m]
// What passes by is in a voxel for a few scans; what is in it for more may rest, whatever its
// label.
constexpr std::uint32_t kScansAtRest = 10;
constexpr double kMostAtRest = 0.5;  // share of the voxels; another car may stand in the same place
// What is smaller, was seen for a moment, or is so far away that few points of a scan hit it, may
// as well be an error of the poses or a beam that grazes an edge. Chosen on the city with seed 1.
constexpr std::size_t kLeastPoints = 200, kLeastScans = 3, kLeastPointsOfScan = 5;

Change change_of(Piece piece, const std::vector<std::uint32_t>& scans,
                 const std::vector<double>& stamps) {
    std::set<std::uint32_t> seen_in;
    for (const std::uint32_t i : piece.points) seen_in.insert(scans[i]);
    Change change{piece.box, seen_in.size()};
    change.first = change.last = stamps[*seen_in.begin()];
    for (const std::uint32_t scan : seen_in) {  // drives need not be in the order of their stamps
        change.first = std::min(change.first, stamps[scan]);
        change.last = std::max(change.last, stamps[scan]);
    }
    change.collected = std::move(piece.points);
    return change;
}

}  // namespace

void ChangedPoints::add(const io::FullScan& scan, const Labels& alone, const Labels& together) {
    if (layout_.fields.empty()) layout_ = layout_of(scan, false);
    refuse_other_fields(scan, layout_);
    const auto number = static_cast<std::uint32_t>(stamps_.size());
    std::vector<std::uint32_t> changed;
    for (std::uint32_t i = 0; i < scan.points.size(); ++i) {
        if (alone[i] == Label::unknown || !is_measured(scan.points[i])) continue;
        const Eigen::Vector3d place = scan.T_world_sensor * scan.points[i].cast<double>();
        const WorldVoxel voxel = world_voxel(place, kVoxel);
        if (alone[i] == Label::dynamic) {
            Times& times = dynamic_[voxel];
            if (times.last_scan != number) times = {number, times.scans + 1};
            continue;
        }
        static_.insert(voxel);
        if (together[i] != Label::dynamic) continue;
        changed.push_back(i);
        places_.push_back(place);
    }
    scans_.resize(places_.size(), number);
    stamps_.push_back(scan.stamp);
    const auto records = world_records(scan, layout_, changed);
    records_.insert(records_.end(), records.begin(), records.end());
}

bool ChangedPoints::is_at_rest(const WorldVoxel& voxel) const {
    if (static_.contains(voxel)) return true;
    const auto found = dynamic_.find(voxel);
    return found != dynamic_.end() && found->second.scans >= kScansAtRest;
}

double ChangedPoints::share_at_rest(const std::vector<std::uint32_t>& points,
                                    const ChangedPoints& other_date) const {
    std::set<WorldVoxel> voxels;
    for (const std::uint32_t i : points) voxels.insert(world_voxel(places_[i], kVoxel));
    const auto count = std::count_if(voxels.begin(), voxels.end(), [&](const WorldVoxel& voxel) {
        return other_date.is_at_rest(voxel);
    });
    return static_cast<double>(count) / static_cast<double>(voxels.size());
}

std::vector<Change> ChangedPoints::changes(const ChangedPoints& other_date) const {
    std::vector<Change> changes;
    for (Piece& piece : pieces_of(places_, kTouching)) {
        if (piece.points.size() < kLeastPoints) continue;
        if (share_at_rest(piece.points, other_date) > kMostAtRest) continue;
        Change change = change_of(std::move(piece), scans_, stamps_);
        const bool is_far = change.points() < kLeastPointsOfScan * change.scans;
        if (change.scans >= kLeastScans && !is_far) changes.push_back(std::move(change));
    }
    std::stable_sort(changes.begin(), changes.end(),
                     [](const Change& a, const Change& b) { return a.points() > b.points(); });
    return changes;
}

io::Cloud ChangedPoints::cloud(const std::vector<Change>& changes) const {
    io::Cloud cloud;
    cloud.fields = layout_.fields;
    cloud.point_bytes = layout_.point_bytes;
    if (cloud.fields.empty()) {  // no scan
        for (const char* axis : {"x", "y", "z"}) io::add_field(cloud, axis, io::FieldType::f32);
    }
    constexpr const char* kNumber = "change";
    if (cloud.find(kNumber) != nullptr) {
        throw ConfigError("the scans have a field `change`, which clouds of changes have, too");
    }
    io::add_field(cloud, kNumber, io::FieldType::u32);
    std::uint32_t number = 0;
    for (const Change& change : changes) {
        ++number;
        for (const std::uint32_t i : change.collected) {
            append_record(cloud.data, records_, i, layout_.point_bytes);
            put(cloud.data, number);
        }
    }
    return cloud;
}

}  // namespace dynamic_filter::app
