// SPDX-License-Identifier: MIT
#include "online/map_segments.hpp"

#include <algorithm>
#include <utility>

#include "filter/voxel_bytes.hpp"
#include "geometry/voxel.hpp"

namespace dynamic_filter {

MapSegments::MapSegments(const Config& config, const OnlineOptions& options)
    : config_(config),
      horizon_(options.horizon),
      most_(options.max_bytes > 0 ? options.max_bytes / kOnlineVoxelBytes : SIZE_MAX) {
    add(0);
}

void MapSegments::add(std::size_t first_index) {
    segments_.push_back({first_index, std::make_unique<DynamicFilter>(config_)});
    forgot_at_.reset();
}

/// A map that is removed right after this is not decided, because nobody would see the result.
std::vector<Verdict> MapSegments::begin(std::size_t first_index) {
    std::vector<Verdict> rest;
    const bool forgets = horizon_ > 0.0;
    if (!forgets || !newest().judges_each_scan()) rest = finish();
    if (forgets) segments_.clear();
    add(first_index);
    return rest;
}

std::optional<Verdict> MapSegments::settle_oldest(std::size_t left) {
    if (unsettled_.size() <= left) return std::nullopt;
    Verdict verdict = newest().settled(unsettled_.front());
    unsettled_.pop_front();
    return verdict;
}

/// The map is not cut after every scan, because cutting it costs as much as copying it.
void MapSegments::forget_far(const Pose& T_world_sensor) {
    constexpr double kShareBetween = 0.25;  // share of the horizon
    const Eigen::Vector3d& here = T_world_sensor.translation();
    if (!forgot_at_) forgot_at_ = here;
    const double horizon = horizon_ > 0.0 ? horizon_ : 1e9;
    const bool far = (here - *forgot_at_).norm() > kShareBetween * horizon;
    if (!far && newest().size() <= most_) return;
    forgot_at_ = here;
    newest().keep_within(T_world_sensor, horizon, most_ - most_ / 4);
}

std::optional<std::size_t> MapSegments::segment_of(const Scan& scan) const {
    const auto next =
        std::upper_bound(segments_.begin(), segments_.end(), scan.index,
                         [](std::size_t index, const Segment& s) { return index < s.first_index; });
    if (next == segments_.begin()) return std::nullopt;  // the map of this scan was removed
    return static_cast<std::size_t>(next - segments_.begin()) - 1;
}

Verdict MapSegments::verdict(const Scan& scan) const {
    const auto segment = segment_of(scan);
    return segment ? segments_[*segment].filter->verdict(scan) : unknown_verdict(scan);
}

Verdict MapSegments::settled(const Scan& scan) const {
    const auto segment = segment_of(scan);
    return segment ? segments_[*segment].filter->settled(scan) : unknown_verdict(scan);
}

std::vector<std::uint64_t> MapSegments::places_of(const Scan& scan) const {
    std::vector<std::uint64_t> places(scan.points.size(), OnlineFilter::kNoPlace);
    const auto segment = segment_of(scan);
    if (!segment) return places;
    const std::vector<std::uint32_t> voxels = segments_[*segment].filter->voxels_of(scan);
    for (std::size_t i = 0; i < places.size(); ++i) {
        if (voxels[i] != kNoVoxel) places[i] = std::uint64_t{*segment} << 32 | voxels[i];
    }
    return places;
}

std::vector<VoxelHistory> MapSegments::histories(std::span<const std::uint64_t> places) const {
    std::vector<VoxelHistory> histories(places.size());
    for (std::size_t segment = 0; segment < segments_.size(); ++segment) {
        std::vector<std::uint32_t> voxels;
        std::vector<std::size_t> at;
        for (std::size_t i = 0; i < places.size(); ++i) {
            if (places[i] >> 32 != segment) continue;
            voxels.push_back(static_cast<std::uint32_t>(places[i]));
            at.push_back(i);
        }
        auto of_segment = segments_[segment].filter->histories(voxels);
        for (std::size_t i = 0; i < at.size(); ++i) histories[at[i]] = std::move(of_segment[i]);
    }
    return histories;
}

std::vector<StaticVoxel> MapSegments::static_map() const {
    std::vector<StaticVoxel> all;
    for (const Segment& segment : segments_) {
        const std::vector<StaticVoxel> some = segment.filter->static_map();
        all.insert(all.end(), some.begin(), some.end());
    }
    return all;
}

StageTimes MapSegments::times() const {
    StageTimes times;
    for (const Segment& segment : segments_) {
        for (const auto& [stage, calls] : segment.filter->times()) times[stage].add(calls);
    }
    return times;
}

MapContents MapSegments::contents() const {
    MapContents contents;
    for (const Segment& segment : segments_) contents.add(segment.filter->contents());
    return contents;
}

}  // namespace dynamic_filter
