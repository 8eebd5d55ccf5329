// SPDX-License-Identifier: MIT
/// An OnlineFilter that keeps the scans it was given, so that it can return new labels for them.
#pragma once

#include <deque>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "dynamic_filter/online.hpp"

namespace dynamic_filter::python {

/// A scan as the user gives it.
struct Pushed {
    Points points;                       ///< [m] sensor frame
    std::optional<Pose> T_world_sensor;  ///< empty: the filter estimates it
    std::optional<double> stamp;         ///< [s]; empty: ten scans per second are assumed
    std::vector<float> times;            ///< see Scan::times
    std::size_t sensor = 0;              ///< see Scan::sensor
};

/// The pose of a scan.
struct Located {
    Pose T_world_sensor = Pose::Identity();
    std::optional<TrackStatus> status;  ///< empty: the user gave the pose
};

/// All members may be called from any thread. Scans are numbered from 0 in the order in which they
/// were pushed; refused scans get no number. Memory: that of OnlineFilter, 13 bytes per point of
/// the kept scans, and 4 more per point while times wait for an estimated pose.
class KeptFilter {
public:
    /// `keep` is the number of newest scans that are kept. Throws ConfigError.
    KeptFilter(const Config& config, OnlineOptions options, std::size_t keep);

    /// Returns the instant verdict; with the method "submaps", all points are unknown, because the
    /// verdict comes at the end of the window. Throws Error if the scan is refused: it is late, it
    /// is a duplicate, or only some of the scans have a pose or a stamp.
    Labels push(Pushed pushed);

    /// Returns those of the newest `newest` kept scans whose labels have changed since push(),
    /// labels() or this function returned them last.
    using Correction = std::pair<std::size_t, Labels>;
    std::vector<Correction> corrections(std::size_t newest);

    /// Labels from the evidence so far; final after finish(). Throws std::out_of_range if the scan
    /// is not kept.
    Labels labels(std::size_t scan);

    /// Throws std::out_of_range if the scan is not kept (the newest one always is). Throws Error if
    /// its pose is not estimated yet: with the method "submaps", it comes at the end of the window.
    Located located(std::size_t scan);
    /// Poses of the kept scans, oldest first; empty: not estimated yet.
    std::vector<std::optional<Located>> all_located();

    /// After finish(), the merged map; before, the static voxels since the last break of the
    /// trajectory.
    std::vector<StaticVoxel> static_map();
    /// The static voxels within `radius` [m] (empty: `map.search_radius`) of a pose (empty: that of
    /// the last scan).
    std::vector<StaticVoxel> local_map(const std::optional<Pose>& T_world_query,
                                       std::optional<double> radius);

    void flush() { filter_.flush(); }
    void finish();

    /// The events since the last call: number of the scan, and one sentence.
    std::vector<std::pair<std::size_t, std::string>> notices();
    std::size_t size();

private:
    struct Kept {
        Scan scan;
        Labels told;
        Labels judged;  ///< labels from the window that has closed, with the method "submaps"
    };
    OnlineCallbacks callbacks();
    void add(const Notice& notice);
    void add(const Verdict& verdict);
    Scan numbered(Pushed pushed) const;
    void keep(Scan scan, const Labels& told);
    void keep(const std::optional<Located>& located);
    Kept* find(std::size_t scan);
    Labels current(const Kept& kept) const;
    std::out_of_range not_kept(std::size_t scan) const;

    std::size_t most_kept_;
    std::mutex push_lock_;  // one scan after the other, so that numbers are in order
    std::optional<std::string> refused_;
    // Whether scans have poses and stamps: all of them, or none.
    std::optional<bool> with_poses_, with_stamps_;
    std::mutex lock_;  // guards all members below
    std::deque<Kept> kept_;
    std::deque<std::optional<Located>> located_;  // one per kept scan, and one for the newest
    std::size_t size_ = 0;
    std::optional<Pose> last_pose_;
    bool finished_ = false;
    std::vector<std::pair<std::size_t, std::string>> notices_;
    OnlineFilter filter_;  // must be the last member, because its threads use the others
};

}  // namespace dynamic_filter::python
