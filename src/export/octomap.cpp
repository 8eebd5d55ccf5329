// SPDX-License-Identifier: MIT
/// `convert rec map.bt` and `map.ot`: a map as OctoMap reads it, made without its rays.
#include <fmt/format.h>

#include <algorithm>
#include <bit>

#include "dynamic_filter/error.hpp"
#include "dynamic_filter/file.hpp"
#include "export/octomap/octree_file.hpp"
#include "export/outputs.hpp"
#include "navigation/look_chooser.hpp"

namespace dynamic_filter::app {

namespace {

constexpr double kUsualVoxel = 0.1;  // [m]

class OctomapSink final : public Sink {
public:
    explicit OctomapSink(const ConvertOptions& o)
        : file_(o.output), voxel_(o.cell > 0.0 ? o.cell : kUsualVoxel), space_(voxel_) {
        refuse_existing(o.output, o.overwrite);
    }

    void append(const io::FullScan& scan, const Labels& labels, const std::string&) override {
        require_labels(labels, "OctoMap");
        const Pose& T = scan.T_world_sensor;
        check_reach(scan);
        for (std::size_t i = 0; i < labels.size(); ++i) {
            if (labels[i] != Label::static_ || !is_measured(scan.points[i])) continue;
            space_.occupy(T * scan.points[i].cast<double>());
        }
        if (chooser_.chooses(T.translation(), scan.stamp)) {
            space_.pass(scan.points, T, kFarthestLook);
        }
    }

    std::string commit() override {
        const std::vector<SeenBlock> blocks = space_.blocks();
        const auto kind = file_.extension() == ".bt" ? OctreeKind::binary : OctreeKind::full;
        io::write_file(file_, octree_file(blocks, voxel_, kind));
        std::size_t occupied = 0, free = 0;
        for (const SeenBlock& block : blocks) {
            occupied += static_cast<std::size_t>(std::popcount(block.occupied));
            free += static_cast<std::size_t>(std::popcount(block.free));
        }
        return fmt::format("{} voxels of {} m are occupied and {} free", occupied, voxel_, free);
    }

private:
    /// OctoMap's files have no origin of their own.
    void check_reach(const io::FullScan& scan) const {
        const double reach = kOctreeReach * voxel_;
        float farthest = 0.0F;
        for (const Point& point : scan.points) {
            if (is_measured(point)) farthest = std::max(farthest, point.norm());
        }
        const double away = scan.T_world_sensor.translation().cwiseAbs().maxCoeff() + farthest;
        if (away < reach) return;
        throw ConfigError(
            fmt::format("a point lies {:.1f} km from the origin of the poses, and OctoMap reaches "
                        "{:.1f} km with voxels of {} m: give poses that begin closer to their "
                        "origin, or a larger --cell",
                        away / 1000.0, reach / 1000.0, voxel_));
    }

    std::filesystem::path file_;
    double voxel_;
    SeenSpace space_;
    LookChooser chooser_;
};

}  // namespace

std::unique_ptr<Sink> make_octomap_sink(const ConvertOptions& o) {
    return std::make_unique<OctomapSink>(o);
}

}  // namespace dynamic_filter::app
