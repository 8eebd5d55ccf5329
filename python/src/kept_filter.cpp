// SPDX-License-Identifier: MIT
#include "python/src/kept_filter.hpp"

#include <algorithm>
#include <stdexcept>

#include "dynamic_filter/error.hpp"

namespace dynamic_filter::python {

namespace {

/// Throws Error if this scan differs from all previous ones in this respect.
void refuse_mixture(const std::optional<bool>& before, bool now, const char* what,
                    std::size_t scan) {
    if (before.value_or(now) == now) return;
    throw Error("scan " + std::to_string(scan) +
                (now ? std::string(" has a ") + what + ", but those before had none"
                     : std::string(" has no ") + what + ", but those before had one") +
                "; it was not taken");
}

/// Gives the scan the pose that the filter used.
void place(Scan& scan, const std::optional<Tracked>& tracked) {
    if (tracked) {
        scan.T_world_sensor = tracked->T_world_sensor;
        scan.has_pose = true;
        if (!scan.times.empty()) {
            scan.points = undo_motion(scan.points, scan.times, tracked->velocity);
        }
    }
    scan.times = std::vector<float>();
}

Located located_by(const Tracked& tracked) { return {tracked.T_world_sensor, tracked.status}; }

}  // namespace

KeptFilter::KeptFilter(const Config& config, OnlineOptions options, std::size_t keep)
    : most_kept_(keep), filter_(config, options, callbacks()) {}

OnlineCallbacks KeptFilter::callbacks() {
    OnlineCallbacks callbacks;
    callbacks.notice = [this](const Notice& notice) { add(notice); };
    // With the method "scans", push() has the verdict before the scan is kept.
    callbacks.instant = [this](const Verdict& verdict) { add(verdict); };
    return callbacks;
}

/// No scan is dropped here. So each notice except a break of the trajectory is a refusal, and comes
/// while push() waits.
void KeptFilter::add(const Notice& notice) {
    if (notice.kind != NoticeKind::jump && notice.kind != NoticeKind::restart) {
        refused_ = notice.text;
        return;
    }
    const std::lock_guard hold(lock_);
    notices_.emplace_back(notice.index, notice.text);
}

void KeptFilter::add(const Verdict& verdict) {
    const std::lock_guard hold(lock_);
    if (verdict.index >= size_) return;  // push() waits for this verdict itself
    if (Kept* const kept = find(verdict.index)) {
        kept->judged = verdict.labels;
        place(kept->scan, verdict.tracked);
    }
    if (!verdict.tracked) return;
    last_pose_ = verdict.tracked->T_world_sensor;
    const std::size_t age = size_ - verdict.index;
    if (age <= located_.size()) located_[located_.size() - age] = located_by(*verdict.tracked);
}

/// Scans without stamps get assumed stamps, like those of the readers of recordings.
Scan KeptFilter::numbered(Pushed pushed) const {
    constexpr double kPeriod = 0.1;  // [s]
    refuse_mixture(with_poses_, pushed.T_world_sensor.has_value(), "pose", size_);
    refuse_mixture(with_stamps_, pushed.stamp.has_value(), "stamp", size_);
    return {std::move(pushed.points),
            pushed.T_world_sensor.value_or(Pose::Identity()),
            pushed.stamp.value_or(kPeriod * static_cast<double>(size_)),
            size_,
            pushed.T_world_sensor.has_value(),
            std::move(pushed.times),
            pushed.sensor};
}

Labels KeptFilter::push(Pushed pushed) {
    const std::lock_guard one_at_a_time(push_lock_);
    const bool with_stamp = pushed.stamp.has_value();
    std::optional<Located> located;
    if (pushed.T_world_sensor) located = Located{*pushed.T_world_sensor, {}};
    const bool with_pose = located.has_value();
    Scan scan = numbered(std::move(pushed));
    Labels labels(scan.points.size(), Label::unknown);
    Scan copy = most_kept_ > 0 ? scan : Scan{};
    refused_.reset();
    std::optional<Verdict> verdict = filter_.ask(std::move(scan));
    if (refused_) throw Error("the scan was refused: " + *refused_);
    with_poses_ = with_pose;
    with_stamps_ = with_stamp;
    if (verdict) {
        labels = std::move(verdict->labels);
        if (verdict->tracked) located = located_by(*verdict->tracked);
        place(copy, verdict->tracked);
    }
    const std::lock_guard hold(lock_);
    ++size_;
    keep(located);
    if (most_kept_ > 0) keep(std::move(copy), labels);
    return labels;
}

void KeptFilter::keep(const std::optional<Located>& located) {
    if (located) last_pose_ = located->T_world_sensor;
    located_.push_back(located);
    if (located_.size() > std::max<std::size_t>(most_kept_, 1)) located_.pop_front();
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
    filter_.flush();  // here and below, so that results do not depend on timing
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
    if (!kept) throw not_kept(scan);
    return kept->told = current(*kept);
}

std::out_of_range KeptFilter::not_kept(std::size_t scan) const {
    return std::out_of_range("scan " + std::to_string(scan) + " of " + std::to_string(size_) +
                             " is not kept (see `keep`)");
}

Located KeptFilter::located(std::size_t scan) {
    const std::lock_guard hold(lock_);
    const std::size_t first = size_ - located_.size();
    if (scan < first || scan >= size_) throw not_kept(scan);
    if (!located_[scan - first]) {
        throw Error("the pose of scan " + std::to_string(scan) +
                    " is not found yet: it comes when its window of scans is full, or with "
                    "finish()");
    }
    return *located_[scan - first];
}

std::vector<std::optional<Located>> KeptFilter::all_located() {
    const std::lock_guard hold(lock_);
    return {located_.begin(), located_.end()};
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
