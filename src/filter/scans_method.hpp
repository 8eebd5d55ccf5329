// SPDX-License-Identifier: MIT
/// The method "scans" (default): every keyframe observes the voxels in its view as occupied or
/// free, and the counters of each voxel decide.
#pragma once

#include "filter/evidence_map.hpp"
#include "filter/final_map.hpp"
#include "filter/instances.hpp"
#include "filter/instant.hpp"
#include "filter/method.hpp"

namespace dynamic_filter {

/// Memory: voxel_bytes.hpp says what a voxel needs. Each of the newest `scans.max_keyframes`
/// keyframes needs six bytes per pixel.
class ScansMethod final : public FilterMethod {
public:
    /// With `bounds`, only points within them have voxels and verdicts.
    explicit ScansMethod(const Config& config, const std::optional<CellBounds>& bounds = {})
        : config_(config),
          evidence_(config, bounds),
          instant_(config),
          instances_(config.scans.instances) {}

    Judged judge(Scan scan) override;
    [[nodiscard]] bool judges_each_scan() const override { return true; }
    void begin_drive() override;
    void look_again(std::size_t drive, const Scan& scan) override;
    std::vector<Verdict> finish() override;
    void decide(const LocatedScan& scan, Verdict& verdict) const override;
    void settle(const LocatedScan& scan, Verdict& verdict) const override;
    void keep_within(const Eigen::Vector3d& center, double radius, std::size_t most) override;
    [[nodiscard]] std::size_t size() const override { return evidence_.grid().size(); }
    std::vector<VoxelOccupancy> local_map(const Pose& T_map_query,
                                          std::optional<double> radius) override;
    [[nodiscard]] std::vector<VoxelOccupancy> static_map() const override;
    [[nodiscard]] const VoxelIndex& voxels() const override { return evidence_.grid().voxels(); }
    [[nodiscard]] std::vector<VoxelHistory> histories(
        std::span<const std::uint32_t> voxels) const override;
    [[nodiscard]] MapContents contents() const override;
    [[nodiscard]] StageTimes times() const override { return times_; }

private:
    [[nodiscard]] bool stays(std::uint32_t voxel, std::size_t index) const;

    Config config_;
    EvidenceMap evidence_;
    InstantVerdicts instant_;
    Instances instances_;
    std::vector<VoxelDecision> decided_;  // per voxel, after finish()
    /// Per voxel, only with `map.time` = latest: see occupied_since().
    std::vector<std::optional<std::uint32_t>> occupied_since_;
    StageTimes times_;
};

}  // namespace dynamic_filter
