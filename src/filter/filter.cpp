// SPDX-License-Identifier: MIT
#include "dynamic_filter/filter.hpp"

#include <cmath>
#include <utility>

#include "dynamic_filter/error.hpp"
#include "filter/method.hpp"
#include "filter/scans_method.hpp"
#include "geometry/pose.hpp"
#include "paper/submaps_method.hpp"
#include "tracking/pose_tracker.hpp"

namespace dynamic_filter {

namespace {

/// The only function that depends on which method is configured.
std::unique_ptr<FilterMethod> make_method(const Config& config) {
    validate(config);
    if (config.method == Method::scans) return std::make_unique<ScansMethod>(config);
    return std::make_unique<SubmapsMethod>(config);
}

std::unique_ptr<FilterMethod> make_method(const Config& config, const Region& region) {
    validate(config);
    if (config.method != Method::scans) {
        throw ConfigError(
            "only the method \"scans\" (preset default) can filter a part of the world");
    }
    const auto cell = [&](double metres) {
        return static_cast<int>(std::lround(metres / config.map.voxel_size));
    };
    const Eigen::AlignedBox2d& area = region.bounds;
    const CellBounds bounds{.low = {cell(area.min().x()), cell(area.min().y())},
                            .high = {cell(area.max().x()), cell(area.max().y())}};
    return std::make_unique<ScansMethod>(config, bounds);
}

}  // namespace

/// The method, and the position of its map in the world.
struct DynamicFilter::Impl {
    Impl(const Config& config, std::unique_ptr<FilterMethod> chosen)
        : voxel_size(config.map.voxel_size), method(std::move(chosen)), tracker(config.odometry) {}

    [[nodiscard]] Pose to_map_frame(const Pose& T_world_sensor) const {
        Pose shifted = T_world_sensor;
        shifted.translation() -= *origin;
        return shifted;
    }
    [[nodiscard]] LocatedScan locate(const Scan& scan) const;
    [[nodiscard]] std::vector<StaticVoxel> in_world(std::span<const VoxelOccupancy> voxels) const;

    double voxel_size;
    std::unique_ptr<FilterMethod> method;
    PoseTracker tracker;
    std::optional<Eigen::Vector3d> origin;  // origin of the map frame, in the world frame
    bool finished = false;
};

LocatedScan DynamicFilter::Impl::locate(const Scan& scan) const {
    LocatedScan located;
    located.voxels.assign(scan.points.size(), kNoVoxel);
    located.in_map.keys.assign(scan.points.size(), kNoKey);
    if (!origin) return located;  // before the first scan
    to_voxels(scan.points, to_map_frame(scan.T_world_sensor), static_cast<float>(voxel_size),
              located.in_map);
    method->voxels().find(located.in_map.keys, located.voxels);
    return located;
}

std::vector<StaticVoxel> DynamicFilter::Impl::in_world(
    std::span<const VoxelOccupancy> voxels) const {
    std::vector<StaticVoxel> result;
    result.reserve(voxels.size());
    for (const auto& [voxel, probability] : voxels) {
        const Point at = center(method->voxels().key(voxel), static_cast<float>(voxel_size));
        result.push_back({*origin + at.cast<double>(), probability, voxel});
    }
    return result;
}

DynamicFilter::DynamicFilter(const Config& config)
    : impl_(std::make_unique<Impl>(config, make_method(config))) {}
DynamicFilter::DynamicFilter(const Config& config, const Region& region)
    : impl_(std::make_unique<Impl>(config, make_method(config, region))) {
    impl_->origin = region.origin;
}
DynamicFilter::DynamicFilter(DynamicFilter&&) noexcept = default;
DynamicFilter& DynamicFilter::operator=(DynamicFilter&&) noexcept = default;
DynamicFilter::~DynamicFilter() = default;

std::vector<Verdict> DynamicFilter::push(Scan scan) {
    Judged judged = judge(std::move(scan));
    if (judged.integrate) judged.integrate();
    return std::move(judged.verdicts);
}

void DynamicFilter::begin_drive() {
    impl_->tracker.restart();
    impl_->method->begin_drive();
}

void DynamicFilter::look_again(std::size_t drive, Scan scan) {
    if (!impl_->origin) return;
    scan.T_world_sensor = impl_->to_map_frame(scan.T_world_sensor);
    impl_->method->look_again(drive, scan);
}

Judged DynamicFilter::judge(Scan scan) {
    if (impl_->finished) throw Error("push() after finish(): make another filter");
    const bool tracked = impl_->tracker.track(scan);
    if (!impl_->origin) impl_->origin = nearby_origin(scan.T_world_sensor, impl_->voxel_size);
    scan.T_world_sensor = impl_->to_map_frame(scan.T_world_sensor);
    Judged judged = impl_->method->judge(std::move(scan));
    const Labels labels = impl_->tracker.attach(judged.verdicts);
    if (tracked) impl_->tracker.learn(labels);
    return judged;
}

bool DynamicFilter::judges_each_scan() const { return impl_->method->judges_each_scan(); }

std::vector<Verdict> DynamicFilter::finish() {
    if (std::exchange(impl_->finished, true)) return {};
    std::vector<Verdict> due = impl_->method->finish();
    impl_->tracker.attach(due);
    return due;
}

Verdict DynamicFilter::verdict(const Scan& scan) const {
    std::vector<std::uint32_t> voxels;
    return verdict(scan, voxels);
}

Verdict DynamicFilter::verdict(const Scan& scan, std::vector<std::uint32_t>& voxels) const {
    Verdict verdict = unknown_verdict(scan);
    if (!impl_->finished) {
        voxels.assign(scan.points.size(), kNoVoxel);
        return verdict;
    }
    LocatedScan located = impl_->locate(scan);
    impl_->method->decide(located, verdict);
    voxels = std::move(located.voxels);
    return verdict;
}

Verdict DynamicFilter::settled(const Scan& scan) const {
    Verdict verdict = unknown_verdict(scan);
    impl_->method->settle(impl_->locate(scan), verdict);
    return verdict;
}

std::vector<std::uint32_t> DynamicFilter::voxels_of(const Scan& scan) const {
    return impl_->locate(scan).voxels;
}

std::vector<VoxelHistory> DynamicFilter::histories(std::span<const std::uint32_t> voxels) const {
    return impl_->method->histories(voxels);
}

void DynamicFilter::keep_within(const Pose& T_world_center, double radius, std::size_t most) {
    if (!impl_->origin) return;
    impl_->method->keep_within(impl_->to_map_frame(T_world_center).translation(), radius, most);
}

std::size_t DynamicFilter::size() const { return impl_->method->size(); }

std::vector<StaticVoxel> DynamicFilter::local_static_map(const Pose& T_world_query,
                                                         std::optional<double> radius) {
    if (!impl_->origin) return {};
    return impl_->in_world(impl_->method->local_map(impl_->to_map_frame(T_world_query), radius));
}

std::vector<StaticVoxel> DynamicFilter::static_map() const {
    if (!impl_->finished) return {};
    return impl_->in_world(impl_->method->static_map());
}

StageTimes DynamicFilter::times() const {
    StageTimes times = impl_->method->times();
    if (impl_->tracker.times().count() > 0) times["odometry"] = impl_->tracker.times();
    return times;
}

MapContents DynamicFilter::contents() const {
    MapContents contents = impl_->method->contents();
    contents.voxels = impl_->method->voxels().size();
    return contents;
}

}  // namespace dynamic_filter
