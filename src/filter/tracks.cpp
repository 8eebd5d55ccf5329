// SPDX-License-Identifier: MIT
#include "filter/tracks.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <tuple>

namespace dynamic_filter {

namespace {

/// Share of the voxels of a cluster in places of objects at rest, from which on it is one of these.
constexpr double kAtRest = 0.6;

struct Match {
    double cost;  // the lowest is the best
    std::size_t cluster;
    TrackId track;
};

/// The best matches first.
void give(std::vector<Match> matches, std::vector<Cluster>& clusters) {
    std::sort(matches.begin(), matches.end(), [](const Match& a, const Match& b) {
        return std::tie(a.cost, a.cluster, a.track) < std::tie(b.cost, b.cluster, b.track);
    });
    std::set<TrackId> given;
    for (const Cluster& cluster : clusters) {
        if (cluster.track) given.insert(*cluster.track);
    }
    for (const auto& [cost, c, id] : matches) {
        if (!clusters[c].track && given.insert(id).second) clusters[c].track = id;
    }
}

/// Largest change of a length or a place that may be due to another view of the same object.
float tolerance(float length, const ScansConfig::Instances& config) {
    return std::max(static_cast<float>(config.jump),
                    static_cast<float>(config.jump_share) * length);
}

bool is_similar_in_size(const Track& track, const Cluster& cluster,
                        const ScansConfig::Instances& config) {
    const auto now = static_cast<double>(cluster.voxels.size());
    const auto before = static_cast<double>(track.seen.places.size());
    const double least = config.fewest;  // tolerance for small clusters, whose size varies
    return now <= config.growth * before + least && before <= config.growth * now + least;
}

bool is_known_at_rest(const Cluster& cluster, const std::map<TrackId, Track>& tracks) {
    std::size_t known = 0;
    for (const auto& [id, count] : cluster.shared) {
        if (!tracks.at(id).seems_to_move()) known += count;
    }
    return static_cast<double>(known) >= kAtRest * static_cast<double>(cluster.voxels.size());
}

/// Matches of one track with clusters near to where it should be.
void match_by_motion(const std::vector<Cluster>& clusters, TrackId id, const Track& track,
                     const Point& expected, const ScansConfig::Instances& config,
                     std::vector<Match>& matches) {
    const float length = track.seen.box.sizes().maxCoeff();
    for (std::size_t c = 0; c < clusters.size(); ++c) {
        const float off = (clusters[c].center - expected).norm();
        if (off > static_cast<float>(config.jump) || clusters[c].track) continue;
        if (clusters[c].voxels.size() < static_cast<std::size_t>(config.fewest)) continue;
        if (std::abs(clusters[c].length() - length) > tolerance(length, config)) continue;
        if (is_similar_in_size(track, clusters[c], config)) matches.push_back({off, c, id});
    }
}

void match_by_place(const std::vector<Cluster>& clusters, const std::map<TrackId, Track>& tracks,
                    double stamp, const Point& sensor_velocity,
                    const ScansConfig::Instances& config, std::vector<Match>& matches) {
    for (std::size_t c = 0; c < clusters.size(); ++c) {
        const Cluster& cluster = clusters[c];
        const double least = config.overlap * static_cast<double>(cluster.voxels.size());
        for (const auto& [id, count] : cluster.shared) {
            if (static_cast<double>(count) < least) continue;
            const Track& track = tracks.at(id);
            const Point moved = cluster.center - track.seen.center;
            const Point off = moved - expected_step(track, stamp, sensor_velocity);
            const float length = std::min(cluster.length(), track.seen.box.sizes().maxCoeff());
            const float most = tolerance(length, config);
            if (std::min(moved.norm(), off.norm()) > most) continue;
            if (!is_similar_in_size(track, cluster, config)) continue;
            matches.push_back({-static_cast<double>(count), c, id});
        }
    }
}

}  // namespace

Point expected_step(const Track& track, double stamp, const Point& sensor_velocity) {
    const auto elapsed = static_cast<float>(stamp - track.seen.stamp);
    return elapsed * (track.views < 2 ? sensor_velocity : track.velocity);
}

void match(std::vector<Cluster>& clusters, const std::map<TrackId, Track>& tracks, double stamp,
           const Point& sensor_velocity, const ScansConfig::Instances& config) {
    std::vector<Match> moving, staying, starting;
    const auto expected = [&](const Track& track) {
        return Point(track.seen.center + expected_step(track, stamp, sensor_velocity));
    };
    for (const auto& [id, track] : tracks) {
        if (track.seems_to_move()) {
            match_by_motion(clusters, id, track, expected(track), config, moving);
        }
    }
    std::erase_if(moving,
                  [&](const Match& m) { return is_known_at_rest(clusters[m.cluster], tracks); });
    give(std::move(moving), clusters);
    match_by_place(clusters, tracks, stamp, sensor_velocity, config, staying);
    give(std::move(staying), clusters);
    for (const auto& [id, track] : tracks) {
        if (track.views == 1) {
            match_by_motion(clusters, id, track, expected(track), config, starting);
        }
    }
    give(std::move(starting), clusters);
}

}  // namespace dynamic_filter
