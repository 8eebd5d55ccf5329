// SPDX-License-Identifier: MIT
#include "dynamic_filter/online.hpp"

#include <cmath>
#include <mutex>
#include <string>
#include <utility>

#include "dynamic_filter/error.hpp"
#include "dynamic_filter/parallel.hpp"
#include "online/map_segments.hpp"
#include "online/scan_queue.hpp"
#include "online/two_stages.hpp"
#include "settings/table.hpp"
#include "tracking/pose_jump.hpp"
#include "tracking/pose_tracker.hpp"

namespace dynamic_filter {

namespace {

OnlineOptions checked(OnlineOptions options) {
    for (const std::string& fault : violations(options)) {
        throw ConfigError("OnlineOptions: " + fault);
    }
    return options;
}

/// Settings of the maps. Their scans already have poses, which must not be refined again.
Config with_given_poses(Config config) {
    config.odometry.refine = false;
    return config;
}

void answer(QueuedScan& scan, std::optional<Verdict> verdict) {
    if (scan.reply) std::exchange(scan.reply, nullptr)->set_value(std::move(verdict));
}

}  // namespace

std::vector<std::string> violations(const OnlineOptions& options) {
    std::vector<std::string> found;
    for (const settings::Row& row : settings::rows_of(options)) {
        if (auto fault = settings::out_of_bounds(row)) found.push_back(std::move(*fault));
    }
    return found;
}

/// There are two locks: `map_lock` guards the maps, and the lock of `stages` guards the queue and
/// the counters. A thread that holds the lock of `stages` takes no other lock. With the method
/// "submaps", the front-end judges without `map_lock`, because it then uses no data of other
/// threads.
struct OnlineFilter::Engine {
    Engine(const Config& config, OnlineOptions options_of_all, OnlineCallbacks call);

    // Functions for users.
    void push(QueuedScan scan);
    void finish();
    [[nodiscard]] Counters count() const;

    // The first thread: it judges scans.
    TwoStages::Job next_job();
    TwoStages::Rest judge_or_tell(QueuedScan& next);
    TwoStages::Rest judge(QueuedScan& next);
    void begin_map_if_broken(const QueuedScan& next);
    void deliver(std::vector<Verdict>& verdicts, std::size_t index, QueuedScan& asked);

    // The second thread: it does the work that judging left to do.
    void integrate(const std::function<void()>& rest, std::optional<Scan>& unsettled,
                   const Pose& T_world_sensor);

    void end_map(const std::function<std::vector<Verdict>()>& end);
    void settle_until(std::size_t left);
    void drop_waiting();
    void tell(const Notice& notice);

    const OnlineOptions options;
    const OnlineCallbacks callbacks;

    // Guarded by the lock of `stages`.
    ScanQueue queue;
    Counters counters;  // without `queued`
    bool finished = false;

    mutable std::mutex map_lock;
    MapSegments maps;
    const bool judges_each_scan;

    std::mutex notice_lock, finish_lock;  // so that calls of the same kind never overlap

    // Data of the first thread.
    PoseTracker tracker;
    std::uint64_t run = 0;
    std::optional<StampedPose> before_last, last;
    Durations latency;

    TwoStages stages;  // must be the last member, because its threads use all others
};

OnlineFilter::Engine::Engine(const Config& config, OnlineOptions options_of_all,
                             OnlineCallbacks call)
    : options(checked(options_of_all)),
      callbacks(std::move(call)),
      maps(with_given_poses(config), options),
      judges_each_scan(maps.newest().judges_each_scan()),
      tracker(config.odometry),
      stages({.take = [this] { return next_job(); },
              .has_job = [this] { return queue.size() > 0; },
              .give_up = [this] { drop_waiting(); },
              .around = [this](const auto& work) { with_threads(options.threads, work); }}) {}

void OnlineFilter::Engine::push(QueuedScan scan) {
    std::optional<Notice> refused;
    std::vector<QueuedScan> dropped;
    {
        TwoStages::Lock hold = stages.lock();
        if (options.overload == Overload::wait) {
            stages.wait(hold, [&] { return queue.size() < options.queue; });
        }
        stages.rethrow();
        if (finished) throw Error("push() after finish(): make another filter");
        ++counters.in;
        refused = queue.refusal(scan.scan);
        if (refused) {
            ++counters.rejected;
        } else {
            queue.add(std::move(scan));
            while (queue.size() > options.queue) dropped.push_back(queue.drop());
            counters.dropped += dropped.size();
            stages.changed();
        }
    }
    for (QueuedScan& d : dropped) {
        answer(d, std::nullopt);
        tell({NoticeKind::dropped, d.scan.index,
              "the queue was full: newer scans came while this one waited"});
    }
    if (!refused) return;
    answer(scan, std::nullopt);
    tell(*refused);
}

void OnlineFilter::Engine::finish() {
    const std::lock_guard one_at_a_time(finish_lock);
    {
        const auto hold = stages.idle();
        if (std::exchange(finished, true)) return;
    }
    stages.stop();
    try {
        with_threads(options.threads, [&] { end_map([&] { return maps.finish(); }); });
    } catch (...) {
        stages.fail(std::current_exception());
        throw;
    }
}

/// A scan counts as queued until its verdict is delivered.
Counters OnlineFilter::Engine::count() const {
    const auto hold = stages.lock();
    Counters now = counters;
    now.queued = now.in - now.processed - now.dropped - now.rejected;
    return now;
}

void OnlineFilter::Engine::drop_waiting() {
    while (queue.size() > 0) {
        QueuedScan waiting = queue.drop();
        ++counters.dropped;
        answer(waiting, std::nullopt);
    }
}

void OnlineFilter::Engine::tell(const Notice& notice) {
    const std::lock_guard hold(notice_lock);
    if (callbacks.notice) callbacks.notice(notice);
}

TwoStages::Job OnlineFilter::Engine::next_job() {
    const auto next = std::make_shared<QueuedScan>(queue.take());
    return [this, next] { return judge_or_tell(*next); };
}

TwoStages::Rest OnlineFilter::Engine::judge_or_tell(QueuedScan& next) {
    try {
        return judge(next);
    } catch (...) {
        if (next.reply) next.reply->set_exception(std::current_exception());
        const auto hold = stages.lock();
        ++counters.rejected;
        throw;
    }
}

TwoStages::Rest OnlineFilter::Engine::judge(QueuedScan& next) {
    stages.wait_for_second(judges_each_scan ? 0 : 1);
    if (next.run != run) tracker.restart();
    const bool tracked = tracker.track(next.scan);
    begin_map_if_broken(next);
    const StampedPose now{next.scan.T_world_sensor, next.scan.stamp};
    const std::size_t index = next.scan.index;
    std::optional<Scan> unsettled;
    if (options.settle_after > 0 && judges_each_scan) unsettled = next.scan;
    Judged judged;
    {
        std::unique_lock hold(map_lock, std::defer_lock);
        if (judges_each_scan || !last) hold.lock();
        judged = maps.newest().judge(std::move(next.scan));
    }
    before_last = std::exchange(last, now);
    const Labels labels = tracker.attach(judged.verdicts);
    latency.add(seconds_since(next.since));
    deliver(judged.verdicts, index, next);
    if (tracked) tracker.learn(labels);
    TwoStages::Rest rest;
    if (judged.integrate) {
        rest = [this, integrating = std::move(judged.integrate), unsettled = std::move(unsettled),
                pose = now.T_world_sensor]() mutable { integrate(integrating, unsettled, pose); };
    }
    const auto hold = stages.lock();
    ++counters.processed;
    return rest;
}

/// After a break, poses do not fit those before it, so the old evidence would be compared with the
/// wrong places.
void OnlineFilter::Engine::begin_map_if_broken(const QueuedScan& next) {
    const StampedPose now{next.scan.T_world_sensor, next.scan.stamp};
    const bool restarts = next.run != run;
    const bool lost = tracker.begins_anew();
    const auto jump = restarts || lost ? std::nullopt : pose_jump(before_last, last, now);
    run = next.run;
    if (!restarts && !jump && !lost) return;
    stages.wait_for_second(0);
    end_map([&] { return maps.begin(next.scan.index); });
    before_last = last = std::nullopt;
    Notice notice{restarts ? NoticeKind::restart : NoticeKind::jump, next.scan.index,
                  "stamps went back by more than a second; a new map begins"};
    if (lost) notice.text = "the odometry has been lost for some scans; a new map begins";
    if (jump) {
        notice.text = "the pose is " + std::to_string(std::lround(*jump)) +
                      " m from where the previous poses lead; a new map begins";
    }
    tell(notice);
}

void OnlineFilter::Engine::deliver(std::vector<Verdict>& verdicts, std::size_t index,
                                   QueuedScan& asked) {
    std::optional<Verdict> own;
    for (Verdict& verdict : verdicts) {
        if (callbacks.instant) callbacks.instant(verdict);
        if (verdict.index == index) own = std::move(verdict);
    }
    answer(asked, std::move(own));
}

void OnlineFilter::Engine::integrate(const std::function<void()>& rest,
                                     std::optional<Scan>& unsettled, const Pose& T_world_sensor) {
    {
        const std::lock_guard hold(map_lock);
        rest();
        if (unsettled) maps.keep_unsettled(std::move(*unsettled));
    }
    if (unsettled) settle_until(options.settle_after);
    const std::lock_guard hold(map_lock);
    maps.forget_far(T_world_sensor);
}

/// Settles the remaining scans; then `end` decides the newest map, or drops it.
void OnlineFilter::Engine::end_map(const std::function<std::vector<Verdict>()>& end) {
    settle_until(0);
    std::vector<Verdict> due;  // verdicts of the last window, with the method "submaps"
    {
        const std::lock_guard hold(map_lock);
        due = end();
    }
    tracker.attach(due);
    for (const Verdict& verdict : due) {
        if (callbacks.instant) callbacks.instant(verdict);
    }
}

void OnlineFilter::Engine::settle_until(std::size_t left) {
    const auto next = [&] {
        const std::lock_guard hold(map_lock);
        return maps.settle_oldest(left);
    };
    while (const auto verdict = next()) {
        if (callbacks.settled) callbacks.settled(*verdict);
    }
}

OnlineFilter::OnlineFilter(const Config& config, OnlineOptions options, OnlineCallbacks callbacks)
    : engine_(std::make_unique<Engine>(config, options, std::move(callbacks))) {}

OnlineFilter::~OnlineFilter() { engine_->stages.stop(); }

void OnlineFilter::push(Scan scan) { engine_->push({.scan = std::move(scan), .reply = nullptr}); }

std::optional<Verdict> OnlineFilter::ask(Scan scan) {
    engine_->stages.refuse_own_threads();
    auto reply = std::make_shared<std::promise<std::optional<Verdict>>>();
    auto verdict = reply->get_future();
    engine_->push({.scan = std::move(scan), .reply = std::move(reply)});
    return verdict.get();
}

void OnlineFilter::flush() { engine_->stages.idle(); }
void OnlineFilter::finish() { engine_->finish(); }

Verdict OnlineFilter::verdict(const Scan& scan) const { return engine_->maps.verdict(scan); }

Verdict OnlineFilter::settled(const Scan& scan) const {
    Verdict verdict;
    with_threads(engine_->options.threads, [&] {
        const std::lock_guard hold(engine_->map_lock);
        verdict = engine_->maps.settled(scan);
    });
    return verdict;
}

bool OnlineFilter::judges_each_scan() const { return engine_->judges_each_scan; }

std::vector<std::uint64_t> OnlineFilter::places_of(const Scan& scan) const {
    return engine_->maps.places_of(scan);
}

std::vector<VoxelHistory> OnlineFilter::histories(std::span<const std::uint64_t> places) const {
    return engine_->maps.histories(places);
}

Counters OnlineFilter::counters() const { return engine_->count(); }

std::vector<StaticVoxel> OnlineFilter::local_static_map(const Pose& T_world_query,
                                                        std::optional<double> radius) {
    std::vector<StaticVoxel> voxels;
    with_threads(engine_->options.threads, [&] {
        const std::lock_guard hold(engine_->map_lock);
        voxels = engine_->maps.newest().local_static_map(T_world_query, radius);
    });
    return voxels;
}

std::vector<StaticVoxel> OnlineFilter::static_map() const { return engine_->maps.static_map(); }

StageTimes OnlineFilter::times() const {
    StageTimes times = engine_->maps.times();
    times["latency"] = engine_->latency;
    const Durations& odometry = engine_->tracker.times();
    if (odometry.count() > 0) times["odometry"] = odometry;
    return times;
}

std::size_t OnlineFilter::maps() const { return engine_->maps.size(); }
MapContents OnlineFilter::contents() const { return engine_->maps.contents(); }

}  // namespace dynamic_filter
