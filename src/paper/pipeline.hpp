// SPDX-License-Identifier: MIT
/// The paper's pipeline (Fig. 2): the front-end cleans the scans of each window and makes a submap
/// of them; the submaps are then the observers of the back-end, which works in a thread of its own
/// beside the front-end. Removert is run as a variant of it, with one window over the whole
/// recording and without back-end.
///
/// - Units: [m], [s], probabilities 0..1.
/// - Frames: points in the sensor frame, poses T_world_sensor, maps in the world frame.
/// - Ownership: scans are kept until their window is processed, thinned submaps until they are
///   forgotten.
/// - Threads: single caller; const members may run in several threads while no other member runs.
/// - Errors: ConfigError from the constructor; Error from push() after finish(). An exception of
///   the back-end is rethrown by the next call that waits for it.
#pragma once

#include <optional>
#include <vector>

#include "dynamic_filter/filter.hpp"
#include "dynamic_filter/settings.hpp"
#include "filter/label.hpp"
#include "geometry/horizon.hpp"
#include "geometry/map_frame.hpp"
#include "paper/back_end.hpp"
#include "paper/back_thread.hpp"
#include "paper/front_end.hpp"
#include "paper/merge.hpp"
#include "paper/window.hpp"

namespace dynamic_filter {

class PaperPipeline {
public:
    /// The size of `horizon` is the number of points of the submaps; it is applied after each
    /// window, and one submap always remains.
    explicit PaperPipeline(const Config& config, Horizon horizon = {});

    /// Takes a scan. If it opens a new window, the front-end processes the previous window, and the
    /// instant verdicts on its scans are returned; the back-end adds the submap meanwhile.
    /// Otherwise nothing is returned.
    std::vector<Verdict> push(Scan scan);
    /// Waits for the back-end.
    void flush() { back_thread_.wait(); }
    /// Processes the last window, returns its verdicts, and merges the local maps of all submap
    /// poses (Sec. III-D). A second call does nothing.
    std::vector<Verdict> finish();

    /// The static voxels of the submaps within `map.search_radius` of a pose (Sec. III-C). Waits
    /// for the back-end.
    std::vector<StaticVoxel> local_static_map(const Pose& T_world_query);

    // After finish().
    [[nodiscard]] Verdict verdict(const Scan& scan) const;  ///< all unknown before finish()
    [[nodiscard]] std::vector<StaticVoxel> static_map() const;
    /// The voxel of each point of a scan; kNoVoxel: no voxel.
    [[nodiscard]] PointVoxels voxels_of(const Scan& scan) const;
    /// Only the probabilities are known; all other values are zero.
    [[nodiscard]] std::vector<VoxelHistory> histories(std::span<const std::uint32_t> voxels) const;

    // After flush().
    [[nodiscard]] std::size_t size() const { return back_end_.points(); }  ///< points of submaps
    [[nodiscard]] MapContents contents() const;
    [[nodiscard]] StageTimes times() const;

private:
    std::vector<Verdict> process(const Window& window);
    void forget_far_from(const Eigen::Vector3d& here);
    void merge_local_maps();
    [[nodiscard]] std::optional<float> decision_on(std::uint32_t voxel, const Point& at) const;
    [[nodiscard]] bool is_forgotten(const Point& at) const;
    [[nodiscard]] std::vector<StaticVoxel> static_among(
        std::span<const VoxelOccupancy> voxels) const;

    Config config_;
    MapFrame frame_;
    WindowCutter cutter_;
    FrontEnd front_end_;
    bool finished_ = false;
    MergedMap merged_;
    StageTimes front_times_;

    // Used by the second thread until flush() returns.
    BackEnd back_end_;
    Horizon horizon_;
    struct Kept {
        Point center;
        float radius;  // [m]
    };
    std::optional<Kept> kept_;  // where submaps are kept, once some were removed
    StageTimes back_times_;

    BackThread back_thread_;  // must be the last member, because its jobs use all others
};

}  // namespace dynamic_filter
