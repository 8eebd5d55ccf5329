// SPDX-License-Identifier: MIT
/// An OnlineFilter that remembers the scans it was given, so that it can say again what they are.
#pragma once

#include <deque>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "dynamic_filter/pipeline/online_filter.hpp"

namespace dynamic_filter::python {

/// A scan as it comes.
struct Pushed {
    Points points;                       ///< [m] sensor frame
    std::optional<Pose> T_world_sensor;  ///< empty: the filter finds it
    std::optional<double> stamp;         ///< [s]; empty: ten scans come a second
    std::vector<float> times;            ///< see Scan
};

/// Where a scan was taken.
struct Located {
    Pose T_world_sensor = Pose::Identity();
    std::optional<TrackStatus> status;  ///< empty: the pose is the one that was given
};

/// All functions may be called from any thread. Scans are numbered from 0 in the order in which
/// they were pushed; those that were refused have no number. Memory: that of OnlineFilter, and 13
/// bytes a point of the scans kept, 4 more while times wait for a pose to be found.
class KeptFilter {
public:
    /// `keep`: how many scans are kept, the newest. Throws ConfigError.
    KeptFilter(const Config& config, OnlineOptions options, std::size_t keep);

    /// The instant verdict; all unknown where submaps observe, because it comes with the window's
    /// end. Throws Error if the scan was refused: it is late, or has come before, or it has a pose
    /// or a stamp where those before had none, or the other way round.
    Labels push(Pushed pushed);

    /// Scans of the newest `newest` kept whose labels are not those that were told last, by push(),
    /// labels() or here.
    using Correction = std::pair<std::size_t, Labels>;
    std::vector<Correction> corrections(std::size_t newest);

    /// From the evidence so far; final after finish(). Throws std::out_of_range if it is not kept.
    Labels labels(std::size_t scan);

    /// Throws std::out_of_range if the scan is not kept (the newest always is), Error if its pose
    /// is not found yet: where submaps observe, it comes with the window's end.
    Located located(std::size_t scan);
    /// Of the scans kept, the oldest first; empty: not found yet.
    std::vector<std::optional<Located>> all_located();

    /// The merged map, after finish(); before it, all since the last break of the trajectory.
    std::vector<StaticVoxel> static_map();
    /// Within `radius` [m] (empty: `map.search_radius`) of a pose (empty: the last scan's).
    std::vector<StaticVoxel> local_map(const std::optional<Pose>& T_world_query,
                                       std::optional<double> radius);

    void flush() { filter_.flush(); }
    void finish();

    /// What happened since the last call: number of the scan, and a sentence.
    std::vector<std::pair<std::size_t, std::string>> notices();
    std::size_t size();

private:
    struct Kept {
        Scan scan;
        Labels told;
        Labels judged;  ///< by a window that has closed, where submaps observe
    };
    OnlineCallbacks callbacks();
    void take(const Notice& notice);
    void take(const Verdict& verdict);
    Scan numbered(Pushed pushed) const;
    void keep(Scan scan, const Labels& told);
    void keep(const std::optional<Located>& located);
    Kept* find(std::size_t scan);
    Labels current(const Kept& kept) const;
    std::out_of_range not_kept(std::size_t scan) const;

    std::size_t most_kept_;
    std::mutex push_lock_;  // one scan after the other, as they are numbered
    std::optional<std::string> refused_;
    std::optional<bool> with_poses_, with_stamps_;  // whether scans have them: all, or none
    std::mutex lock_;                               // all below
    std::deque<Kept> kept_;
    std::deque<std::optional<Located>> located_;  // of the scans kept, and of the newest
    std::size_t size_ = 0;
    std::optional<Pose> last_pose_;
    bool finished_ = false;
    std::vector<std::pair<std::size_t, std::string>> notices_;
    OnlineFilter filter_;  // the last: its threads use the others
};

}  // namespace dynamic_filter::python
