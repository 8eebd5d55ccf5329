// SPDX-License-Identifier: MIT
#include "filter/objects.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "base/numbers.hpp"

namespace dynamic_filter {

namespace {

// Surfaces are compared so often, so near, and if so much of them is seen. Less may be a rim that
// the shadow of something else leaves, and that moves with the shadow.
constexpr double kLookEvery = 0.4;   // [s]
constexpr float kLookReach = 30.0F;  // [m]
constexpr std::size_t kLookPoints = 20, kLookVoxels = 12;

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

}  // namespace

void Objects::update(const Scan& scan, const PointVoxels& voxels, EvidenceGrid& grid,
                     Labels& labels) {
    if (last_stamp_ && scan.stamp - *last_stamp_ < config_.every) return;
    const std::uint32_t newest = grid.scans() - 1;
    // Number of scans for which this one stands.
    const std::uint32_t scans = last_stamp_ ? newest - last_scan_ : 1;
    last_stamp_ = scan.stamp;
    last_scan_ = newest;
    forget(scan.stamp);
    const Clusters found = find_clusters(scan.points, voxels, config_);
    std::vector<Cluster> clusters = describe(found, voxels, grid, labels);
    match(clusters, grid, scan.stamp);
    for (Cluster& cluster : clusters) follow(cluster, grid, scan.stamp, scans);
    find_displaced(scan, found, clusters, grid);
    for (std::size_t i = 0; i < labels.size(); ++i) {
        if (found.of_points[i] == kNoCluster || labels[i] != Label::static_) continue;
        const auto& id = clusters[found.of_points[i]].track;
        if (!id) continue;
        if (came_with(tracks_.at(*id).moving_from, grid[voxels[i]].evidence)) {
            labels[i] = Label::dynamic;
        }
    }
}

std::vector<Objects::Cluster> Objects::describe(const Clusters& found, const PointVoxels& voxels,
                                                const EvidenceGrid& grid,
                                                const Labels& labels) const {
    std::vector<std::vector<std::pair<std::uint32_t, bool>>> members(found.count);
    for (std::size_t i = 0; i < voxels.size(); ++i) {
        if (found.of_points[i] == kNoCluster) continue;
        members[found.of_points[i]].emplace_back(voxels[i], labels[i] == Label::dynamic);
    }
    std::vector<Cluster> clusters(found.count);
    for (std::size_t c = 0; c < clusters.size(); ++c) {
        std::sort(members[c].begin(), members[c].end());
        members[c].erase(std::unique(members[c].begin(), members[c].end()), members[c].end());
        Cluster& cluster = clusters[c];
        Eigen::AlignedBox3f box;
        for (const auto& [voxel, dynamic] : members[c]) {
            const Evidence& e = grid[voxel].evidence;
            const bool filled = was_filled(e), refilled = e.since > e.first_owner;
            cluster.dynamic += dynamic ? 1U : 0U;
            cluster.came += dynamic || filled ? 1U : 0U;
            if (filled || (dynamic && refilled)) cluster.filled.push_back(e.since);
            if (!cluster.voxels.empty() && cluster.voxels.back() == voxel) continue;
            cluster.voxels.push_back(voxel);
            cluster.center += grid[voxel].centroid;
            box.extend(grid[voxel].centroid);
        }
        cluster.center /= static_cast<float>(cluster.voxels.size());
        cluster.length = box.sizes().maxCoeff();
    }
    return clusters;
}

/// True if the cluster may be the object of the track: its size is similar, and its center is near
/// the last or the expected center of the track. Without this test, the track of an object would
/// continue with another object that it touches.
bool Objects::fits(const Track& track, const Cluster& cluster, double stamp) const {
    const auto elapsed = static_cast<float>(stamp - track.seen.stamp);
    const Point expected = track.seen.center + elapsed * track.velocity;
    const float jump =
        std::min((cluster.center - expected).norm(), (cluster.center - track.seen.center).norm());
    const auto now = static_cast<double>(cluster.voxels.size());
    const auto before = static_cast<double>(track.seen.voxels);
    const double least = config_.fewest;  // tolerance for small clusters, whose size varies
    const float length = std::min(cluster.length, track.seen.length);
    const float most =
        std::max(static_cast<float>(config_.jump), static_cast<float>(config_.jump_share) * length);
    return jump <= most && now <= config_.growth * before + least &&
           before <= config_.growth * now + least;
}

/// Gives each cluster the track that it overlaps most. Each track is given to at most one cluster.
void Objects::match(std::vector<Cluster>& clusters, const EvidenceGrid& grid, double stamp) const {
    std::vector<std::tuple<std::size_t, std::size_t, Id>> matches;  // shared voxels, cluster, track
    for (std::size_t c = 0; c < clusters.size(); ++c) {
        std::map<Id, std::size_t> shared;
        for (const std::uint32_t voxel : clusters[c].voxels) {
            const auto place = last_there_.find(block_of(grid, voxel));
            if (place != last_there_.end()) ++shared[place->second.track];
        }
        const double least = config_.overlap * static_cast<double>(clusters[c].voxels.size());
        for (const auto& [id, count] : shared) {
            if (static_cast<double>(count) < least) continue;
            const auto& since = tracks_.at(id).moving_from;
            if (since) {
                clusters[c].after_moving =
                    std::min(clusters[c].after_moving.value_or(*since), *since);
            }
            if (fits(tracks_.at(id), clusters[c], stamp)) matches.emplace_back(count, c, id);
        }
    }
    std::sort(matches.begin(), matches.end(), [](const auto& a, const auto& b) {
        const auto& [shared_a, cluster_a, id_a] = a;
        const auto& [shared_b, cluster_b, id_b] = b;
        return std::tie(shared_b, cluster_a, id_a) < std::tie(shared_a, cluster_b, id_b);
    });
    std::map<Id, bool> taken;
    for (const auto& [shared, c, id] : matches) {
        if (clusters[c].track || taken[id]) continue;
        clusters[c].track = id;
        taken[id] = true;
    }
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
    const bool is_new = track.seen.voxels == 0;
    if (!is_new || !cluster.after_moving || weight < 1.0) return;
    track.arrived_scans = config_.arrived_scans;
    track.arrival = std::min(track.arrival, *cluster.after_moving);
}

/// Empty: the track is not that of a moving object so far.
std::optional<std::uint32_t> Objects::moving_from(const Track& track) const {
    const float path = (track.seen.center - track.first_center).norm();
    const bool moved =
        track.dynamic_scans >= config_.dynamic_scans && path >= static_cast<float>(config_.gone);
    const bool came = track.arrived_scans >= config_.arrived_scans;
    if (track.is_displaced) return std::min(track.start, track.there_since);
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

/// Continues the track of the cluster, or begins a new one. The cluster stands for `scans` scans.
void Objects::follow(Cluster& cluster, EvidenceGrid& grid, double stamp, std::uint32_t scans) {
    if (cluster.voxels.size() < static_cast<std::size_t>(config_.fewest)) {
        cluster.track.reset();
        return;
    }
    if (!cluster.track) begin(cluster, grid);
    Track& track = tracks_.at(*cluster.track);
    note_arrival(track, cluster);
    if (track.seen.voxels > 0) {
        const Point step = cluster.center - track.seen.center;
        const auto elapsed = static_cast<float>(stamp - track.seen.stamp);
        track.velocity = 0.5F * (track.velocity + step / elapsed);
    }
    track.seen = {stamp, cluster.center, cluster.voxels.size(), cluster.length};
    const double least = config_.dynamic_share * static_cast<double>(cluster.voxels.size());
    if (static_cast<double>(cluster.dynamic) >= least) ++track.dynamic_scans;
    for (const std::uint32_t voxel : cluster.voxels) {
        last_there_[block_of(grid, voxel)] = {*cluster.track, stamp};
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
    std::vector<Id> ids;
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
