// SPDX-License-Identifier: MIT
#include "kept_filter.hpp"

#include <algorithm>
#include <stdexcept>

#include "dynamic_filter/error.hpp"

namespace dynamic_filter::python {

KeptFilter::KeptFilter(const Config& config, OnlineOptions options, std::size_t keep)
    : most_kept_(keep), filter_(config, options, callbacks()) {}

OnlineCallbacks KeptFilter::callbacks() {
    OnlineCallbacks callbacks;
    callbacks.notice = [this](const Notice& notice) { take(notice); };
    // Where each scan is judged at once, push() has the verdict before the scan is kept.
    callbacks.instant = [this](const Verdict& verdict) {
        const std::lock_guard hold(lock_);
        if (Kept* const kept = find(verdict.index)) kept->judged = verdict.labels;
    };
    return callbacks;
}

/// Nothing is dropped here, so all but breaks of the trajectory are refusals, and those come while
/// push() waits.
void KeptFilter::take(const Notice& notice) {
    if (notice.kind != NoticeKind::jump && notice.kind != NoticeKind::restart) {
        refused_ = notice.text;
        return;
    }
    const std::lock_guard hold(lock_);
    notices_.emplace_back(notice.index, notice.text);
}

Labels KeptFilter::push(Points points, const Pose& T_world_sensor, double stamp) {
    const std::lock_guard one_at_a_time(push_lock_);
    Scan scan{std::move(points), T_world_sensor, stamp, size()};
    Labels labels(scan.points.size(), Label::unknown);
    Scan copy = most_kept_ > 0 ? scan : Scan{};
    refused_.reset();
    std::optional<Verdict> verdict = filter_.ask(std::move(scan));
    if (refused_) throw Error("the scan was refused: " + *refused_);
    if (verdict) labels = std::move(verdict->labels);
    const std::lock_guard hold(lock_);
    ++size_;
    last_pose_ = T_world_sensor;
    if (most_kept_ > 0) keep(std::move(copy), labels);
    return labels;
}

void KeptFilter::keep(Scan scan, const Labels& told) {
    kept_.push_back({std::move(scan), told, filter_.judges_each_scan() ? Labels() : told});
    if (kept_.size() > most_kept_) kept_.pop_front();
}

KeptFilter::Kept* KeptFilter::find(std::size_t scan) {
    if (kept_.empty() || scan < kept_.front().scan.index || scan > kept_.back().scan.index) {
        return nullptr;
    }
    return &kept_[scan - kept_.front().scan.index];
}

Labels KeptFilter::current(const Kept& kept) const {
    if (finished_) return filter_.verdict(kept.scan).labels;
    return filter_.judges_each_scan() ? filter_.settled(kept.scan).labels : kept.judged;
}

std::vector<KeptFilter::Correction> KeptFilter::corrections(std::size_t newest) {
    filter_.flush();  // here and below: what is said depends on no timing
    const std::lock_guard hold(lock_);
    std::vector<Correction> corrections;
    for (std::size_t i = kept_.size() - std::min(newest, kept_.size()); i < kept_.size(); ++i) {
        Labels now = current(kept_[i]);
        if (now == kept_[i].told) continue;
        kept_[i].told = now;
        corrections.emplace_back(kept_[i].scan.index, std::move(now));
    }
    return corrections;
}

Labels KeptFilter::labels(std::size_t scan) {
    filter_.flush();
    const std::lock_guard hold(lock_);
    Kept* const kept = find(scan);
    if (!kept) {
        throw std::out_of_range("scan " + std::to_string(scan) + " of " + std::to_string(size_) +
                                " is not kept (see `keep`)");
    }
    return kept->told = current(*kept);
}

std::vector<StaticVoxel> KeptFilter::static_map() {
    constexpr double kAll = 1e9;  // [m]
    {
        const std::lock_guard hold(lock_);
        if (finished_) return filter_.static_map();
    }
    return local_map(std::nullopt, kAll);
}

std::vector<StaticVoxel> KeptFilter::local_map(const std::optional<Pose>& T_world_query,
                                               std::optional<double> radius) {
    filter_.flush();
    std::optional<Pose> pose = T_world_query;
    if (!pose) {
        const std::lock_guard hold(lock_);
        pose = last_pose_;
    }
    if (!pose) return {};
    return filter_.local_static_map(*pose, radius);
}

void KeptFilter::finish() {
    filter_.finish();
    const std::lock_guard hold(lock_);
    finished_ = true;
}

std::vector<std::pair<std::size_t, std::string>> KeptFilter::notices() {
    const std::lock_guard hold(lock_);
    return std::exchange(notices_, {});
}

std::size_t KeptFilter::size() {
    const std::lock_guard hold(lock_);
    return size_;
}

}  // namespace dynamic_filter::python
