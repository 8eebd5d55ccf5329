// SPDX-License-Identifier: MIT
/// The paper's method (Fig. 2): the front-end cleans the scans of each window and makes a submap of
/// them; the submaps are then the observers of the back-end. Removert is run as a variant of it,
/// with one window over the whole sequence and without back-end.
#pragma once

#include "dynamic_filter/settings.hpp"
#include "filter/method.hpp"
#include "paper/back_end.hpp"
#include "paper/front_end.hpp"
#include "paper/merge.hpp"
#include "paper/window.hpp"

namespace dynamic_filter {

/// Memory: one window of scans, and the thinned submaps.
class SubmapsMethod final : public FilterMethod {
public:
    explicit SubmapsMethod(const Config& config);

    Judged judge(Scan scan) override;
    [[nodiscard]] bool judges_each_scan() const override { return false; }
    std::vector<Verdict> finish() override;
    void decide(const LocatedScan& scan, Verdict& verdict) const override;
    void settle(const LocatedScan&, Verdict&) const override {}
    void keep_within(const Eigen::Vector3d& center, double radius, std::size_t most) override;
    [[nodiscard]] std::size_t size() const override { return back_end_.points(); }
    std::vector<VoxelOccupancy> local_map(const Pose& T_map_query,
                                          std::optional<double> radius) override;
    [[nodiscard]] std::vector<VoxelOccupancy> static_map() const override;
    [[nodiscard]] const VoxelIndex& voxels() const override { return back_end_.voxels(); }
    [[nodiscard]] std::vector<VoxelHistory> histories(
        std::span<const std::uint32_t> voxels) const override;
    [[nodiscard]] MapContents contents() const override;
    [[nodiscard]] StageTimes times() const override;

private:
    Judged process(const Window& window);
    void merge_local_maps();
    [[nodiscard]] std::optional<float> decision_on(std::uint32_t voxel, const Point& at) const;
    [[nodiscard]] bool is_forgotten(const Point& at) const;

    Config config_;
    WindowCutter cutter_;
    FrontEnd front_end_;
    BackEnd back_end_;
    MergedMap merged_;
    struct Kept {
        Point center;
        float radius;  // [m]
    };
    std::optional<Kept> kept_;  // where submaps are kept, once some were removed
    // Times of judge() and of the rest, which may run at the same time.
    StageTimes front_times_, back_times_;
};

}  // namespace dynamic_filter
