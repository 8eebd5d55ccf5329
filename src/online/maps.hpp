// SPDX-License-Identifier: MIT
/// The maps of one trajectory, scan by scan: the pose of each scan, where the trajectory breaks,
/// and a filter for each stretch between two breaks. It has no threads of its own and takes no
/// locks; the owner holds one.
#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <variant>
#include <vector>

#include "dynamic_filter/filter.hpp"
#include "dynamic_filter/online.hpp"
#include "geometry/horizon.hpp"
#include "paper/pipeline.hpp"
#include "tracking/pose_jump.hpp"
#include "tracking/tracker.hpp"

namespace dynamic_filter {

class Maps {
public:
    /// Uses the limits of `options` and `settle_after`. Throws ConfigError.
    Maps(const Config& config, const OnlineOptions& options);

    /// What a scan, or the end, gave.
    struct Judged {
        std::vector<Verdict> settled;  ///< at a break and in the end: on the scans that were left
        std::optional<Notice> notice;  ///< a new map began with the scan
        /// On the scan; with the preset `paper`, on the scans of the window that was closed.
        std::vector<Verdict> instant;
    };
    /// How a scan follows those before.
    enum class Follows {
        on,        ///< as usual
        restarts,  ///< the stamps went back, so that nothing before fits
        anew,      ///< somebody wants a new map
        lost       ///< its pose relative to those before is not known
    };
    /// Finds the pose of a scan, begins a new map where the trajectory breaks, and judges the scan.
    Judged judge(Scan scan, Follows follows);
    /// Does the work that can wait until the verdict is delivered. Returns the settled verdicts
    /// that are due. Call it after each judge().
    std::vector<Verdict> catch_up();
    /// Decides the voxels of the newest map, and returns the verdicts that were left.
    Judged finish();

    /// False for the presets `paper` and `removert`, which judge scans window by window. May be
    /// called from any thread at any time.
    [[nodiscard]] bool judges_each_scan() const { return config_.method == Method::scans; }
    /// The static voxels of the newest map around a pose.
    std::vector<StaticVoxel> local_static_map(const Pose& T_world_query,
                                              std::optional<double> radius);

    // Verdict from the map into which the scan went. All points are unknown if that map was
    // removed.
    [[nodiscard]] Verdict verdict(const Scan& scan) const;
    [[nodiscard]] Verdict settled(const Scan& scan) const;
    /// See OnlineFilter.
    [[nodiscard]] std::vector<std::uint64_t> places_of(const Scan& scan) const;
    [[nodiscard]] std::vector<VoxelHistory> histories(std::span<const std::uint64_t> places) const;

    /// Waits until the second thread of the preset `paper` has nothing left to do.
    void flush();
    // From all maps that are kept, after flush().
    [[nodiscard]] std::vector<StaticVoxel> static_map() const;
    [[nodiscard]] StageTimes times() const;
    [[nodiscard]] MapContents contents() const;
    [[nodiscard]] std::size_t size() const { return stretches_.size(); }

private:
    using Filter = std::variant<std::unique_ptr<DynamicFilter>, std::unique_ptr<PaperPipeline>>;
    /// The scans between two breaks.
    struct Stretch {
        std::size_t first_index;  ///< Scan::index of its first scan
        Filter filter;
    };
    [[nodiscard]] Stretch new_stretch(std::size_t first_index) const;
    std::optional<Notice> break_before(const Scan& scan, Follows follows);
    Judged end_stretch(bool decide);
    std::vector<Verdict> settle_until(std::size_t left);
    void forget_far(DynamicFilter& filter);
    void attach_poses(std::vector<Verdict>& verdicts);
    [[nodiscard]] const Stretch* stretch_of(const Scan& scan) const;

    const Config config_;
    const OnlineOptions options_;
    Tracker tracker_;
    struct Followed {
        std::optional<StampedPose> before_last, last;
    };
    std::map<std::size_t, Followed> followed_;  // keys: sensors
    Pose here_ = Pose::Identity();              // T_world_sensor of the newest scan
    std::map<std::size_t, Tracked> untold_;     // by Scan::index, until the verdict comes
    Labels learned_;                            // of the newest scan, for the tracker
    std::vector<Stretch> stretches_;
    std::deque<Scan> unsettled_;  // of the newest map
    Horizon horizon_;             // of the newest map
};

}  // namespace dynamic_filter
