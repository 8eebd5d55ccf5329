// SPDX-License-Identifier: MIT
#include "online/maps.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "filter/voxel_bytes.hpp"
#include "geometry/voxel.hpp"

namespace dynamic_filter {

namespace {

Horizon horizon_of(const OnlineOptions& options) {
    const std::size_t most =
        options.max_bytes > 0 ? options.max_bytes / kOnlineVoxelBytes : SIZE_MAX;
    return {options.horizon, most};
}

template <class... Functions>
struct Either : Functions... {
    using Functions::operator()...;
};
template <class... Functions>
Either(Functions...) -> Either<Functions...>;  // which Clang 14 does not deduce by itself

}  // namespace

Maps::Maps(const Config& config, const OnlineOptions& options)
    : config_(config), options_(options), tracker_(config.odometry), horizon_(horizon_of(options)) {
    stretches_.push_back(new_stretch(0));
}

Maps::Stretch Maps::new_stretch(std::size_t first_index) const {
    if (judges_each_scan()) return {first_index, std::make_unique<DynamicFilter>(config_)};
    return {first_index, std::make_unique<PaperPipeline>(config_, horizon_of(options_))};
}

Maps::Judged Maps::judge(Scan scan, Follows follows) {
    if (follows == Follows::restarts || follows == Follows::anew) tracker_.restart();
    const std::optional<Tracked> tracked = tracker_.place(scan);
    if (tracked) untold_[scan.index] = *tracked;
    if (tracked && tracked->begins_anew && follows == Follows::on) follows = Follows::lost;
    Judged judged;
    if (auto notice = break_before(scan, follows)) {
        // A map that is removed right after this is not decided, because nobody would see it.
        judged = end_stretch(options_.horizon == 0.0 || !judges_each_scan());
        judged.notice = std::move(notice);
        Stretch next = new_stretch(scan.index);
        if (options_.horizon > 0.0) stretches_.clear();
        stretches_.push_back(std::move(next));
        horizon_ = horizon_of(options_);
    }
    const std::size_t index = scan.index;
    here_ = scan.T_world_sensor;
    auto& [before_last, last] = followed_[scan.sensor];
    before_last = std::exchange(last, StampedPose{scan.T_world_sensor, scan.stamp});
    if (options_.settle_after > 0 && judges_each_scan()) unsettled_.push_back(scan);
    std::visit(Either{[&](const std::unique_ptr<DynamicFilter>& filter) {
                          judged.instant.push_back(filter->judge(std::move(scan)));
                      },
                      [&](const std::unique_ptr<PaperPipeline>& pipeline) {
                          for (Verdict& verdict : pipeline->push(std::move(scan))) {
                              judged.instant.push_back(std::move(verdict));
                          }
                      }},
               stretches_.back().filter);
    attach_poses(judged.instant);
    learned_.clear();
    for (const Verdict& verdict : judged.instant) {
        if (tracked && verdict.index == index) learned_ = verdict.labels;
    }
    return judged;
}

/// After a break, poses do not fit those before it, so the old evidence would be compared with the
/// wrong places.
std::optional<Notice> Maps::break_before(const Scan& scan, Follows follows) {
    const auto& [before_last, last] = followed_[scan.sensor];
    const auto jump = follows == Follows::on
                          ? pose_jump(before_last, last, {scan.T_world_sensor, scan.stamp})
                          : std::nullopt;
    if (follows == Follows::on && !jump) return std::nullopt;
    followed_.clear();
    const bool restarts = follows == Follows::restarts || follows == Follows::anew;
    Notice notice{restarts ? NoticeKind::restart : NoticeKind::jump, scan.index,
                  "stamps went back by more than a second; a new map begins"};
    if (follows == Follows::anew) notice.text = "a new map begins, as was asked for";
    if (follows == Follows::lost) {
        notice.text = "the odometry has been lost for some scans; a new map begins";
    }
    if (jump) {
        notice.text = "the pose is " + std::to_string(std::lround(*jump)) +
                      " m from where the previous poses lead; a new map begins";
    }
    return notice;
}

std::vector<Verdict> Maps::catch_up() {
    tracker_.learn(learned_);
    auto* const filter = std::get_if<std::unique_ptr<DynamicFilter>>(&stretches_.back().filter);
    if (!filter) return {};  // the second thread of the pipeline does it
    (*filter)->catch_up();
    std::vector<Verdict> settled = settle_until(options_.settle_after);
    forget_far(**filter);
    return settled;
}

void Maps::forget_far(DynamicFilter& filter) {
    const auto cut = horizon_.due(here_.translation(), filter.size());
    if (cut) filter.keep_within(here_, cut->radius, cut->most);
}

/// Settles the oldest scans until so many are left.
std::vector<Verdict> Maps::settle_until(std::size_t left) {
    std::vector<Verdict> settled_ones;
    for (; unsettled_.size() > left; unsettled_.pop_front()) {
        settled_ones.push_back(settled(unsettled_.front()));
    }
    return settled_ones;
}

Maps::Judged Maps::end_stretch(bool decide) {
    Judged judged{.settled = settle_until(0), .notice = {}, .instant = {}};
    if (!decide) return judged;
    std::visit(Either{[](const std::unique_ptr<DynamicFilter>& filter) { filter->finish(); },
                      [&](const std::unique_ptr<PaperPipeline>& pipeline) {
                          judged.instant = pipeline->finish();
                      }},
               stretches_.back().filter);
    attach_poses(judged.instant);
    return judged;
}

Maps::Judged Maps::finish() { return end_stretch(true); }

void Maps::attach_poses(std::vector<Verdict>& verdicts) {
    for (Verdict& verdict : verdicts) {
        const auto tracked = untold_.extract(verdict.index);
        if (!tracked.empty()) verdict.tracked = tracked.mapped();
    }
}

/// Null: the map of this scan was removed.
const Maps::Stretch* Maps::stretch_of(const Scan& scan) const {
    const auto next =
        std::upper_bound(stretches_.begin(), stretches_.end(), scan.index,
                         [](std::size_t index, const Stretch& s) { return index < s.first_index; });
    return next == stretches_.begin() ? nullptr : &*std::prev(next);
}

Verdict Maps::verdict(const Scan& scan) const {
    const Stretch* const stretch = stretch_of(scan);
    if (!stretch) return unknown_verdict(scan);
    return std::visit([&](const auto& filter) { return filter->verdict(scan); }, stretch->filter);
}

Verdict Maps::settled(const Scan& scan) const {
    const Stretch* const stretch = stretch_of(scan);
    const auto* const filter =
        stretch ? std::get_if<std::unique_ptr<DynamicFilter>>(&stretch->filter) : nullptr;
    return filter ? (*filter)->settled(scan) : unknown_verdict(scan);
}

std::vector<StaticVoxel> Maps::local_static_map(const Pose& T_world_query,
                                                std::optional<double> radius) {
    return std::visit(Either{[&](const std::unique_ptr<DynamicFilter>& filter) {
                                 return filter->local_static_map(T_world_query, radius);
                             },
                             [&](const std::unique_ptr<PaperPipeline>& pipeline) {
                                 return pipeline->local_static_map(T_world_query);
                             }},
                      stretches_.back().filter);
}

std::vector<std::uint64_t> Maps::places_of(const Scan& scan) const {
    std::vector<std::uint64_t> places(scan.points.size(), OnlineFilter::kNoPlace);
    const Stretch* const stretch = stretch_of(scan);
    if (!stretch) return places;
    const auto number = static_cast<std::uint64_t>(stretch - stretches_.data());
    const std::vector<std::uint32_t> voxels =
        std::visit([&](const auto& filter) { return filter->voxels_of(scan); }, stretch->filter);
    for (std::size_t i = 0; i < places.size(); ++i) {
        if (voxels[i] != kNoVoxel) places[i] = number << 32 | voxels[i];
    }
    return places;
}

std::vector<VoxelHistory> Maps::histories(std::span<const std::uint64_t> places) const {
    std::vector<VoxelHistory> histories(places.size());
    for (std::size_t number = 0; number < stretches_.size(); ++number) {
        std::vector<std::uint32_t> voxels;
        std::vector<std::size_t> at;
        for (std::size_t i = 0; i < places.size(); ++i) {
            if (places[i] >> 32 != number) continue;
            voxels.push_back(static_cast<std::uint32_t>(places[i]));
            at.push_back(i);
        }
        auto of_stretch = std::visit([&](const auto& filter) { return filter->histories(voxels); },
                                     stretches_[number].filter);
        for (std::size_t i = 0; i < at.size(); ++i) histories[at[i]] = std::move(of_stretch[i]);
    }
    return histories;
}

void Maps::flush() {
    auto* const pipeline = std::get_if<std::unique_ptr<PaperPipeline>>(&stretches_.back().filter);
    if (pipeline) (*pipeline)->flush();
}

std::vector<StaticVoxel> Maps::static_map() const {
    std::vector<StaticVoxel> all;
    for (const Stretch& stretch : stretches_) {
        const std::vector<StaticVoxel> some =
            std::visit([](const auto& filter) { return filter->static_map(); }, stretch.filter);
        all.insert(all.end(), some.begin(), some.end());
    }
    return all;
}

StageTimes Maps::times() const {
    StageTimes times;
    for (const Stretch& stretch : stretches_) {
        const StageTimes some =
            std::visit([](const auto& filter) { return filter->times(); }, stretch.filter);
        for (const auto& [stage, calls] : some) times[stage].add(calls);
    }
    if (tracker_.times().count() > 0) times["odometry"] = tracker_.times();
    return times;
}

MapContents Maps::contents() const {
    MapContents contents;
    for (const Stretch& stretch : stretches_) {
        contents.add(
            std::visit([](const auto& filter) { return filter->contents(); }, stretch.filter));
    }
    return contents;
}

}  // namespace dynamic_filter
