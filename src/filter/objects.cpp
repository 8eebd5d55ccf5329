// SPDX-License-Identifier: MIT
#include "filter/objects.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/numbers.hpp"
#include "dynamic_filter/parallel.hpp"

namespace dynamic_filter {

namespace {

// Surfaces are compared so often, so near, and if so much of them is seen. Less may be a rim that
// the shadow of something else leaves, and that moves with the shadow.
constexpr double kLookEvery = 0.4;   // [s]
constexpr float kLookReach = 30.0F;  // [m]
constexpr std::size_t kLookPoints = 20, kLookVoxels = 12;
// Share of the last place of an object that is seen empty once it has left. The rest may be hidden,
// often by the object itself.
constexpr double kLeft = 0.4;
constexpr int kLeavingScans = 2;

VoxelKey block_of(const EvidenceGrid& grid, std::uint32_t voxel) {
    return pack(grid.voxels().corner(grid.voxels().block_of_voxel(voxel)));
}

/// True if the voxel had no points, or was surely empty, before that scan.
bool came_with(std::optional<std::uint32_t> scan, const Evidence& e) {
    return scan && e.since >= *scan;
}

/// True if the voxel was seen free first and is occupied since then: something came and stayed. One
/// look may have erred, which is why clusters count such voxels.
bool was_filled(const Evidence& e) {
    return e.n_free > 0 && e.n_switch <= 1 && e.last == Sight::occupied;
}

/// Notes whether the keyframe sees that the object has left its last place, and that it goes on in
/// the same direction: errors of poses make things seem to jump to and fro.
void note_leaving(Track& track, const Cluster& cluster, const Keyframe& keyframe,
                  const EvidenceMap& map) {
    const std::vector<Sight> sights = map.look(keyframe, track.seen.places);
    const auto empty = std::count_if(sights.begin(), sights.end(), is_free);
    const bool has_left = static_cast<double>(empty) >= kLeft * static_cast<double>(sights.size());
    const Point way = track.seen.center - track.left, step = cluster.center - track.seen.center;
    const bool goes_on = track.leaving_scans > 0 && step.dot(way) > 0.0F;
    if (!has_left) {
        track.leaving_scans = 0;
    } else if (goes_on) {
        ++track.leaving_scans;
    } else {
        track.leaving_scans = 1;
        track.left = track.seen.center;
    }
}

}  // namespace

std::optional<Clusters> Objects::clusters_in(const Scan& scan, const PointVoxels& voxels) {
    ++scans_;
    if (last_stamp_ && scan.stamp - *last_stamp_ < config_.every) return std::nullopt;
    return find_clusters(scan.points, voxels, config_);
}

void Objects::update(const Scan& scan, const PointVoxels& voxels, const Clusters& found,
                     EvidenceMap& map, Labels& labels) {
    const double elapsed = last_stamp_ ? scan.stamp - *last_stamp_ : config_.every;
    EvidenceGrid& grid = map.grid();
    const std::uint32_t newest = grid.scans() - 1;
    // Number of scans of the sensor for which this one stands.
    const std::uint32_t scans = std::exchange(scans_, 0);
    const Point sensor = scan.T_world_sensor.translation().cast<float>();
    Point sensor_velocity = Point::Zero();
    if (last_stamp_) sensor_velocity = (sensor - last_sensor_) / static_cast<float>(elapsed);
    last_stamp_ = scan.stamp;
    last_sensor_ = sensor;
    last_scan_ = newest;
    forget(scan.stamp);
    std::vector<Cluster> clusters = describe(found, voxels, grid, labels);
    match(clusters, tracks_, scan.stamp, sensor_velocity, config_);
    const auto& keyframes = map.keyframes().kept();
    const bool is_keyframe = !keyframes.empty() && keyframes.back().index == scan.index;
    const Keyframe* const seen_by = is_keyframe ? &keyframes.back() : nullptr;
    for (Cluster& cluster : clusters) follow(cluster, seen_by, map, scan.stamp, scans);
    find_displaced(scan, found, clusters, grid);
    std::vector<std::optional<std::uint32_t>> moving_from(clusters.size());
    for (std::size_t c = 0; c < clusters.size(); ++c) {
        if (clusters[c].track) moving_from[c] = tracks_.at(*clusters[c].track).moving_from;
    }
    for (std::size_t i = 0; i < labels.size(); ++i) {
        const std::uint32_t c = found.of_points[i];
        if (c == kNoCluster || labels[i] == Label::dynamic) continue;
        if (came_with(moving_from[c], grid[voxels[i]].evidence)) labels[i] = Label::dynamic;
    }
}

std::vector<Cluster> Objects::describe(const Clusters& found, const PointVoxels& voxels,
                                       const EvidenceGrid& grid, const Labels& labels) {
    // Per cluster: twice the number of each voxel, plus one if it is dynamic.
    std::vector<std::vector<std::uint64_t>> members(found.count);
    in_cluster_.resize(grid.size(), kNoCluster);
    for (std::size_t i = 0; i < voxels.size(); ++i) {
        const std::uint32_t c = found.of_points[i];
        if (c == kNoCluster || std::exchange(in_cluster_[voxels[i]], c) == c) continue;
        const bool dynamic = labels[i] == Label::dynamic;
        members[c].push_back(2 * std::uint64_t{voxels[i]} + (dynamic ? 1 : 0));
    }
    for (const auto& of_cluster : members) {
        for (const std::uint64_t member : of_cluster) in_cluster_[member / 2] = kNoCluster;
    }
    std::vector<Cluster> clusters(found.count);
    parallel_for(clusters.size(), 8, [&](std::size_t begin, std::size_t end) {
        for (std::size_t c = begin; c < end; ++c) clusters[c] = describe(members[c], grid);
    });
    return clusters;
}

/// `members`: as in describe() of all. A voxel that lies in two clusters may be listed more than
/// once.
Cluster Objects::describe(std::vector<std::uint64_t>& members, const EvidenceGrid& grid) const {
    std::sort(members.begin(), members.end());
    members.erase(std::unique(members.begin(), members.end()), members.end());
    Cluster cluster;
    cluster.voxels.reserve(members.size());
    for (const std::uint64_t member : members) {
        const auto voxel = static_cast<std::uint32_t>(member / 2);
        const bool dynamic = member % 2 != 0;
        const Evidence& e = grid[voxel].evidence;
        const bool filled = was_filled(e), refilled = e.since > e.first_owner;
        cluster.dynamic += dynamic ? 1U : 0U;
        cluster.came += dynamic || filled ? 1U : 0U;
        if (filled || (dynamic && refilled)) cluster.filled.push_back(e.since);
        cluster.voxels.push_back(voxel);
        cluster.center += grid[voxel].centroid;
        cluster.box.extend(grid[voxel].centroid);
        const auto place = last_there_.find(block_of(grid, voxel));
        if (place != last_there_.end()) ++cluster.shared[place->second.track];
    }
    cluster.center /= static_cast<float>(cluster.voxels.size());
    return cluster;
}

/// If moving objects were last seen where the cluster is: the scan since when the first of them was
/// known.
std::optional<std::uint32_t> Objects::after_moving(const Cluster& cluster) const {
    const double least = config_.overlap * static_cast<double>(cluster.voxels.size());
    std::optional<std::uint32_t> first;
    for (const auto& [id, count] : cluster.shared) {
        const auto& since = tracks_.at(id).moving_from;
        if (since && static_cast<double>(count) >= least) {
            first = std::min(first.value_or(*since), *since);
        }
    }
    return first;
}

/// Adds what the cluster shows of whether its object came to where it is: a scan counts fully if
/// enough of its voxels did, and in part from half of that share on. Few looks at a surface that
/// was never seen before tell little; over many scans they add up. For few voxels, chance is
/// allowed for by about two standard deviations of a share.
void Objects::note_arrival(Track& track, const Cluster& cluster) const {
    const auto voxels = static_cast<double>(cluster.voxels.size());
    const double share = (static_cast<double>(cluster.came) - std::sqrt(voxels)) / voxels;
    const double weight = std::clamp(2.0 * share / config_.arrived_share - 1.0, 0.0, 1.0);
    if (weight == 0.0 || cluster.filled.empty()) return;
    const bool is_first = track.arrived_scans == 0.0;
    track.arrived_scans += weight;
    if (!is_first) return;
    track.arrival = value_at_rank(cluster.filled, cluster.filled.size() / 4);
    if (track.views > 0 || weight < 1.0) return;
    if (const auto since = after_moving(cluster)) {
        track.arrived_scans = config_.arrived_scans;
        track.arrival = std::min(track.arrival, *since);
    }
}

/// True if the object was seen to go some distance.
bool Objects::has_moved(const Track& track) const {
    const auto is_far = [&](const Point& from) {
        return (track.seen.center - from).norm() >= static_cast<float>(config_.gone);
    };
    return (track.dynamic_scans >= config_.dynamic_scans && is_far(track.first_center)) ||
           (track.leaving_scans >= kLeavingScans && is_far(track.left));
}

/// Empty: the track is not that of a moving object so far.
std::optional<std::uint32_t> Objects::moving_from(const Track& track) const {
    if (track.is_displaced) return std::min(track.start, track.there_since);
    const bool moved = has_moved(track), came = track.arrived_scans >= config_.arrived_scans;
    if (moved && came) return std::min(track.start, track.arrival);
    if (moved) return track.start;
    if (came) return track.arrival;
    return std::nullopt;
}

void Objects::begin(Cluster& cluster, const EvidenceGrid& grid) {
    cluster.track = next_++;
    Track& track = tracks_[*cluster.track];
    track.start = last_scan_;
    track.first_center = cluster.center;
    const auto first_quarter = [](const std::vector<std::uint32_t>& scans) {
        return value_at_rank(scans, scans.size() / 4);
    };
    std::vector<std::uint32_t> since, moved;  // of all voxels, and of those of moving objects
    for (const std::uint32_t voxel : cluster.voxels) {
        const Evidence& e = grid[voxel].evidence;
        since.push_back(e.since);
        if (e.moved > config_.share * e.n_own) moved.push_back(e.since);
    }
    track.there_since = first_quarter(since);
    const double least = config_.dynamic_share * static_cast<double>(cluster.voxels.size());
    if (static_cast<double>(moved.size()) >= least) {
        track.moving_from = first_quarter(moved);
    }
}

/// Continues the track of the cluster, or begins a new one. The cluster stands for `scans` scans;
/// `seen_by` is the keyframe of the newest of them, if that is one.
void Objects::follow(Cluster& cluster, const Keyframe* seen_by, EvidenceMap& map, double stamp,
                     std::uint32_t scans) {
    EvidenceGrid& grid = map.grid();
    if (cluster.voxels.size() < static_cast<std::size_t>(config_.fewest)) {
        cluster.track.reset();
        return;
    }
    if (!cluster.track) begin(cluster, grid);
    Track& track = tracks_.at(*cluster.track);
    note_arrival(track, cluster);
    const double least = config_.dynamic_share * static_cast<double>(cluster.voxels.size());
    if (static_cast<double>(cluster.dynamic) >= least) ++track.dynamic_scans;
    if (track.views > 0) {
        if (!track.moving_from && seen_by) note_leaving(track, cluster, *seen_by, map);
        const Point step = cluster.center - track.seen.center;
        const Point velocity = step / static_cast<float>(stamp - track.seen.stamp);
        track.velocity = track.views == 1 ? velocity : Point(0.5F * (track.velocity + velocity));
    }
    ++track.views;
    track.seen = {stamp, cluster.center, cluster.box, {}};
    for (const std::uint32_t voxel : cluster.voxels) {
        track.seen.places.push_back(grid[voxel].centroid);
        occupy(block_of(grid, voxel), *cluster.track);
    }
    if (track.moving_from) {
        for (const std::uint32_t voxel : cluster.voxels) {
            if (came_with(track.moving_from, grid[voxel].evidence)) grid.record_moved(voxel, scans);
        }
        return;
    }
    for (const std::uint32_t voxel : cluster.voxels) track.history[voxel] += scans;
    use_history(track, grid);
}

/// The track was seen in the block of voxels. What moves takes no places from what rests there: it
/// may pass so close that both are one cluster for a while.
void Objects::occupy(VoxelKey block, TrackId track) {
    const auto [place, is_new] = last_there_.insert({block, {track, *last_stamp_}});
    if (is_new) return;
    const bool rests = !tracks_.at(place->second.track).seems_to_move();
    if (!rests || !tracks_.at(track).seems_to_move()) place.value().track = track;
    place.value().stamp = *last_stamp_;
}

/// If the track is now that of a moving object, so are its points until now. Where the object was
/// before the track began, without having left in between, so are all points until now.
void Objects::use_history(Track& track, EvidenceGrid& grid) const {
    track.moving_from = moving_from(track);
    if (!track.moving_from) return;
    for (const auto& [voxel, scans] : track.history) {
        const Evidence& e = grid[voxel].evidence;
        if (!came_with(track.moving_from, e)) continue;
        const bool is_older = track.is_displaced && e.since < track.start;
        const std::uint32_t all = e.n_own > e.moved ? e.n_own - e.moved : 0;
        grid.record_moved(voxel, is_older ? all : scans);
    }
    track.history = {};
}

/// Compares the surfaces of the tracks that are not those of moving objects with earlier views.
void Objects::find_displaced(const Scan& scan, const Clusters& found,
                             const std::vector<Cluster>& clusters, EvidenceGrid& grid) {
    if (last_look_ && scan.stamp - *last_look_ < kLookEvery) return;
    last_look_ = scan.stamp;
    if (!origin_) origin_ = scan.T_world_sensor.translation();
    Pose near = scan.T_world_sensor;  // floats hold what is near
    near.translation() -= *origin_;
    std::vector<Points> points(clusters.size());
    for (std::size_t i = 0; i < found.of_points.size(); ++i) {
        const std::uint32_t c = found.of_points[i];
        if (c == kNoCluster || !clusters[c].track || scan.points[i].norm() > kLookReach) continue;
        if (tracks_.at(*clusters[c].track).moving_from) continue;
        points[c].push_back((near * scan.points[i].cast<double>()).cast<float>());
    }
    const Point from = near.translation().cast<float>();
    std::vector<SteadyWay> ways;
    std::vector<TrackId> ids;
    for (std::size_t c = 0; c < clusters.size(); ++c) {
        const bool is_small = clusters[c].voxels.size() < kLookVoxels;
        if (is_small || points[c].size() < kLookPoints) continue;
        const auto way = tracks_.at(*clusters[c].track).surface.look(scan.stamp, from, points[c]);
        if (!way) continue;
        ways.push_back(*way);
        ids.push_back(*clusters[c].track);
    }
    for (const std::size_t i : which_moved(ways, config_.displaced)) {
        Track& track = tracks_.at(ids[i]);
        track.is_displaced = true;
        use_history(track, grid);
    }
}

/// Removes the tracks that were not seen for too long.
void Objects::forget(double stamp) {
    const auto is_lost = [&](double seen) { return stamp - seen > config_.lost; };
    std::erase_if(tracks_, [&](const auto& track) { return is_lost(track.second.seen.stamp); });
    for (auto it = last_there_.begin(); it != last_there_.end();) {
        it = tracks_.contains(it->second.track) && !is_lost(it->second.stamp)
                 ? std::next(it)
                 : last_there_.erase(it);
    }
}

void Objects::keep(std::span<const std::uint32_t> kept) {
    tsl::robin_map<std::uint32_t, std::uint32_t> renumbered;
    for (std::size_t i = 0; i < kept.size(); ++i) {
        renumbered[kept[i]] = static_cast<std::uint32_t>(i);
    }
    for (auto& [id, track] : tracks_) {
        tsl::robin_map<std::uint32_t, std::uint32_t> history;
        for (const auto& [voxel, scans] : track.history) {
            const auto now = renumbered.find(voxel);
            if (now != renumbered.end()) history[now->second] = scans;
        }
        track.history = std::move(history);
    }
}

}  // namespace dynamic_filter
