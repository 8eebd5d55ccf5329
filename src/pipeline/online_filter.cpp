// SPDX-License-Identifier: MIT
#include "dynamic_filter/pipeline/online_filter.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <condition_variable>
#include <deque>
#include <exception>
#include <mutex>
#include <string>
#include <thread>
#include <utility>

#include "dynamic_filter/error.hpp"
#include "dynamic_filter/geometry/voxel.hpp"
#include "dynamic_filter/parallel.hpp"
#include "dynamic_filter/pipeline/pose_jump.hpp"
#include "scan_queue.hpp"

namespace dynamic_filter {

namespace {

/// Of the map, with what its containers hold in reserve.
constexpr std::size_t kBytesPerVoxel = 160;

OnlineOptions checked(OnlineOptions options) {
    if (options.queue == 0) throw ConfigError("OnlineOptions::queue is 0; expected 1 or more");
    if (!(options.horizon >= 0.0)) {
        throw ConfigError("OnlineOptions::horizon is not a length; expected 0 (none) or more");
    }
    constexpr int kMost = 1024;  // oneTBB counts in 16 bits
    if (options.threads < 0 || options.threads > kMost) {
        throw ConfigError("OnlineOptions::threads is " + std::to_string(options.threads) +
                          "; expected 0 (all cores) to " + std::to_string(kMost));
    }
    return options;
}

Verdict all_unknown(const Scan& scan) {
    return {scan.index, Labels(scan.points.size(), Label::unknown),
            std::vector<float>(scan.points.size(), 0.0F)};
}

/// Between two breaks of the trajectory.
struct Map {
    std::size_t first_index = 0;  ///< of the first scan in it
    std::unique_ptr<DynamicFilter> filter;
};

/// What the back-end still has to do about a scan.
struct Task {
    std::shared_ptr<BackEndWork> work;
    std::optional<Scan> scan;  ///< to settle
    Pose T_world_sensor;
};

}  // namespace

/// Two locks: `map_lock` for the maps, `lock` for all else; who holds `lock` takes no other. The
/// front-end judges without `map_lock` where submaps observe: it touches nothing then that others
/// do.
struct OnlineFilter::Engine {
    Engine(const Config& config_of_all, OnlineOptions options_of_all, OnlineCallbacks call)
        : config(config_of_all), options(checked(options_of_all)), callbacks(std::move(call)) {
        maps.push_back({0, std::make_unique<DynamicFilter>(config)});
        front = std::thread([this] {
            guarded([this] { judge_scans(); },
                    [this] {
                        judging = false;
                        ++counters.rejected;
                    });
        });
        try {
            back = std::thread([this] {
                guarded([this] { integrate_tasks(); },
                        [this] {
                            integrating = false;
                            tasks.clear();
                        });
            });
        } catch (...) {  // the first must not outlive what it uses
            stop();
            throw;
        }
        own_threads = {front.get_id(), back.get_id()};
    }

    /// A callback that waits for the filter would wait for itself.
    void refuse_own_threads() const {
        const auto self = std::this_thread::get_id();
        if (self != own_threads[0] && self != own_threads[1]) return;
        throw Error("a callback must not wait for the filter that calls it");
    }

    // Called by users.
    void push(Waiting waiting);
    std::unique_lock<std::mutex> idle();
    void finish();
    void stop();

    // The front-end's thread.
    void judge_scans();
    std::optional<Waiting> next_scan();
    void judge(Waiting& next);
    void begin_map_if_broken(const Waiting& next);
    void wait_for_back_end(std::size_t tasks_ahead);
    void deliver(std::vector<Verdict>& verdicts, std::size_t index, Waiting& asked);

    // The back-end's thread.
    void integrate_tasks();
    void integrate(Task task);
    void settle_until(std::size_t left);
    void forget_far(const Pose& T_world_sensor);

    [[nodiscard]] std::optional<std::size_t> map_of(const Scan& scan) const;
    void end_map();
    void guarded(const std::function<void()>& loop, const std::function<void()>& give_up);
    void drop_waiting();
    void tell(const Notice& notice);
    DynamicFilter& newest() { return *maps.back().filter; }
    void rethrow() const {
        if (failure) std::rethrow_exception(failure);
    }

    const Config config;
    const OnlineOptions options;
    const OnlineCallbacks callbacks;

    mutable std::mutex lock;
    std::condition_variable changed;  // anything below
    ScanQueue queue;
    std::deque<Task> tasks;
    bool judging = false, integrating = false, stopping = false, finished = false;
    Counters counters;
    std::exception_ptr failure;

    mutable std::mutex map_lock;
    std::vector<Map> maps;
    std::deque<Scan> unsettled;
    std::optional<Eigen::Vector3d> forgot_at;  // where the map was cut to the horizon

    std::mutex notice_lock, finish_lock;  // one at a time

    // Of the front-end's thread.
    std::uint64_t run = 0;
    std::optional<StampedPose> before_last, last;
    Durations latency;

    std::array<std::thread::id, 2> own_threads;  // no scan comes before the constructor has set it
    std::thread front, back;                     // the last members: they use all others
};

void OnlineFilter::Engine::push(Waiting waiting) {
    std::optional<Notice> refused;
    std::vector<Waiting> dropped;
    {
        std::unique_lock hold(lock);
        if (options.overload == Overload::wait) {
            changed.wait(hold, [&] { return failure || queue.size() < options.queue; });
        }
        rethrow();
        if (finished) throw Error("push() after finish(): make another filter");
        ++counters.in;
        refused = queue.refusal(waiting.scan);
        if (refused) {
            ++counters.rejected;
        } else {
            queue.add(std::move(waiting));
            while (queue.size() > options.queue) dropped.push_back(queue.drop());
            counters.dropped += dropped.size();
            changed.notify_all();
        }
    }
    for (Waiting& d : dropped) {
        if (d.reply) d.reply->set_value(std::nullopt);
        tell({NoticeKind::dropped, d.scan.index, "newer scans came while it waited"});
    }
    if (!refused) return;
    if (waiting.reply) waiting.reply->set_value(std::nullopt);
    tell(*refused);
}

/// Returns holding `lock`, with nothing in work.
std::unique_lock<std::mutex> OnlineFilter::Engine::idle() {
    refuse_own_threads();
    std::unique_lock hold(lock);
    changed.wait(hold, [&] {
        const bool busy = queue.size() > 0 || judging || !tasks.empty() || integrating;
        return failure || !busy;
    });
    rethrow();
    return hold;
}

void OnlineFilter::Engine::finish() {
    const std::lock_guard one_at_a_time(finish_lock);
    {
        const auto hold = idle();
        if (std::exchange(finished, true)) return;
    }
    stop();
    try {
        with_threads(options.threads, [&] { end_map(); });
    } catch (...) {
        const std::lock_guard hold(lock);
        failure = std::current_exception();
        throw;
    }
}

/// What is about to be forgotten is not decided, where that is all that would be done.
void OnlineFilter::Engine::end_map() {
    settle_until(0);
    const bool needed = finished || options.horizon <= 0.0 || !newest().front_end_waits();
    std::vector<Verdict> rest;  // of the last window, where submaps observe
    if (needed) {
        const std::lock_guard hold(map_lock);
        rest = newest().finish();
    }
    for (const Verdict& verdict : rest) {
        if (callbacks.instant) callbacks.instant(verdict);
    }
}

void OnlineFilter::Engine::stop() {
    {
        const std::lock_guard hold(lock);
        stopping = true;
        drop_waiting();
        changed.notify_all();
    }
    if (front.joinable()) front.join();
    if (back.joinable()) back.join();
}

/// A stage that fails stops both threads and leaves nothing half done; the next caller gets the
/// exception.
void OnlineFilter::Engine::guarded(const std::function<void()>& loop,
                                   const std::function<void()>& give_up) {
    try {
        with_threads(options.threads, loop);
    } catch (...) {
        const std::lock_guard hold(lock);
        if (!failure) failure = std::current_exception();
        give_up();
        stopping = true;
        drop_waiting();
        changed.notify_all();
    }
}

void OnlineFilter::Engine::drop_waiting() {
    while (queue.size() > 0) {
        const Waiting waiting = queue.drop();
        ++counters.dropped;
        if (waiting.reply) waiting.reply->set_value(std::nullopt);
    }
}

void OnlineFilter::Engine::tell(const Notice& notice) {
    const std::lock_guard hold(notice_lock);
    if (callbacks.notice) callbacks.notice(notice);
}

void OnlineFilter::Engine::judge_scans() {
    while (auto next = next_scan()) {
        try {
            judge(*next);
        } catch (...) {
            if (next->reply) next->reply->set_exception(std::current_exception());
            throw;
        }
    }
}

std::optional<Waiting> OnlineFilter::Engine::next_scan() {
    std::unique_lock hold(lock);
    changed.wait(hold, [&] { return stopping || queue.size() > 0; });
    if (stopping) return std::nullopt;
    judging = true;
    Waiting next = queue.take();
    changed.notify_all();
    return next;
}

void OnlineFilter::Engine::judge(Waiting& next) {
    begin_map_if_broken(next);
    wait_for_back_end(newest().front_end_waits() ? 0 : 1);
    const StampedPose now{next.scan.T_world_sensor, next.scan.stamp};
    const std::size_t index = next.scan.index;
    Task task{{}, std::nullopt, now.T_world_sensor};
    if (options.settle_after > 0 && newest().front_end_waits()) task.scan = next.scan;
    Judged judged;
    {
        std::unique_lock hold(map_lock, std::defer_lock);
        if (newest().front_end_waits() || !last) hold.lock();
        judged = newest().judge(std::move(next.scan));
    }
    before_last = std::exchange(last, now);
    latency.add(seconds_since(next.since));
    deliver(judged.verdicts, index, next);
    task.work = std::move(judged.work);
    const std::lock_guard hold(lock);
    judging = false;
    ++counters.processed;
    // Where submaps observe, most scans leave nothing to do.
    if (task.work || newest().front_end_waits()) tasks.push_back(std::move(task));
    changed.notify_all();
}

/// Evidence from before a break would be held against places that are not the same.
void OnlineFilter::Engine::begin_map_if_broken(const Waiting& next) {
    const StampedPose now{next.scan.T_world_sensor, next.scan.stamp};
    const bool restarts = next.run != run;
    const auto jump = restarts ? std::nullopt : pose_jump(before_last, last, now);
    run = next.run;
    if (!restarts && !jump) return;
    wait_for_back_end(0);
    end_map();
    before_last = last = std::nullopt;
    {
        const std::lock_guard hold(map_lock);
        if (options.horizon > 0.0) maps.clear();
        maps.push_back({next.scan.index, std::make_unique<DynamicFilter>(config)});
        forgot_at.reset();
    }
    tell(restarts ? Notice{NoticeKind::restart, next.scan.index,
                           "stamps went back by more than a second; a new map begins"}
                  : Notice{NoticeKind::jump, next.scan.index,
                           "the pose is " + std::to_string(std::lround(*jump)) +
                               " m from where the poses before led; a new map begins"});
}

void OnlineFilter::Engine::wait_for_back_end(std::size_t tasks_ahead) {
    std::unique_lock hold(lock);
    changed.wait(hold, [&] { return tasks.size() + (integrating ? 1 : 0) <= tasks_ahead; });
}

void OnlineFilter::Engine::deliver(std::vector<Verdict>& verdicts, std::size_t index,
                                   Waiting& asked) {
    std::optional<Verdict> answer;
    for (Verdict& verdict : verdicts) {
        if (callbacks.instant) callbacks.instant(verdict);
        if (verdict.index == index) answer = std::move(verdict);
    }
    if (asked.reply) std::exchange(asked.reply, nullptr)->set_value(std::move(answer));
}

void OnlineFilter::Engine::integrate_tasks() {
    while (true) {
        Task task;
        {
            std::unique_lock hold(lock);
            changed.wait(hold, [&] { return stopping || !tasks.empty(); });
            if (tasks.empty()) return;  // what was judged is integrated all the same
            integrating = true;
            task = std::move(tasks.front());
            tasks.pop_front();
        }
        integrate(std::move(task));
        const std::lock_guard hold(lock);
        integrating = false;
        changed.notify_all();
    }
}

void OnlineFilter::Engine::integrate(Task task) {
    {
        const std::lock_guard hold(map_lock);
        newest().integrate(task.work);
    }
    if (task.scan) {
        unsettled.push_back(std::move(*task.scan));
        settle_until(options.settle_after);
    }
    const std::lock_guard hold(map_lock);
    forget_far(task.T_world_sensor);
}

void OnlineFilter::Engine::settle_until(std::size_t left) {
    while (unsettled.size() > left) {
        Verdict verdict;
        {
            const std::lock_guard hold(map_lock);
            verdict = newest().settled(unsettled.front());
        }
        unsettled.pop_front();
        if (callbacks.settled) callbacks.settled(verdict);
    }
}

/// Not with every scan: to cut the map costs as much as to copy it.
void OnlineFilter::Engine::forget_far(const Pose& T_world_sensor) {
    constexpr double kShareBetween = 0.25;  // of the horizon
    const Eigen::Vector3d& here = T_world_sensor.translation();
    if (!forgot_at) forgot_at = here;
    const double horizon = options.horizon > 0.0 ? options.horizon : 1e9;
    const std::size_t most = options.max_bytes > 0 ? options.max_bytes / kBytesPerVoxel : SIZE_MAX;
    const bool far = (here - *forgot_at).norm() > kShareBetween * horizon;
    if (!far && newest().size() <= most) return;
    forgot_at = here;
    newest().keep_within(T_world_sensor, horizon, most - most / 4);
}

OnlineFilter::OnlineFilter(const Config& config, OnlineOptions options, OnlineCallbacks callbacks)
    : engine_(std::make_unique<Engine>(config, options, std::move(callbacks))) {}

OnlineFilter::~OnlineFilter() { engine_->stop(); }

void OnlineFilter::push(Scan scan) { engine_->push({.scan = std::move(scan), .reply = nullptr}); }

std::optional<Verdict> OnlineFilter::ask(Scan scan) {
    engine_->refuse_own_threads();
    auto reply = std::make_shared<std::promise<std::optional<Verdict>>>();
    auto answer = reply->get_future();
    engine_->push({.scan = std::move(scan), .reply = std::move(reply)});
    return answer.get();
}

void OnlineFilter::flush() { engine_->idle(); }
void OnlineFilter::finish() { engine_->finish(); }

std::optional<std::size_t> OnlineFilter::Engine::map_of(const Scan& scan) const {
    const auto next =
        std::upper_bound(maps.begin(), maps.end(), scan.index,
                         [](std::size_t index, const Map& m) { return index < m.first_index; });
    if (next == maps.begin()) return std::nullopt;  // it is forgotten
    return static_cast<std::size_t>(next - maps.begin()) - 1;
}

Verdict OnlineFilter::verdict(const Scan& scan) const {
    if (const auto map = engine_->map_of(scan)) return engine_->maps[*map].filter->verdict(scan);
    return all_unknown(scan);
}

Verdict OnlineFilter::settled(const Scan& scan) const {
    Verdict verdict = all_unknown(scan);
    with_threads(engine_->options.threads, [&] {
        const std::lock_guard hold(engine_->map_lock);
        const auto map = engine_->map_of(scan);
        if (map) verdict = engine_->maps[*map].filter->settled(scan);
    });
    return verdict;
}

std::vector<std::uint64_t> OnlineFilter::places_of(const Scan& scan) const {
    std::vector<std::uint64_t> places(scan.points.size(), kNoPlace);
    const auto map = engine_->map_of(scan);
    if (!map) return places;
    const std::vector<std::uint32_t> voxels = engine_->maps[*map].filter->voxels_of(scan);
    for (std::size_t i = 0; i < places.size(); ++i) {
        if (voxels[i] != kNoVoxel) places[i] = std::uint64_t{*map} << 32 | voxels[i];
    }
    return places;
}

std::vector<VoxelHistory> OnlineFilter::histories(std::span<const std::uint64_t> places) const {
    std::vector<VoxelHistory> histories(places.size());
    for (std::size_t map = 0; map < engine_->maps.size(); ++map) {
        std::vector<std::uint32_t> voxels;
        std::vector<std::size_t> at;
        for (std::size_t i = 0; i < places.size(); ++i) {
            if (places[i] >> 32 != map) continue;
            voxels.push_back(static_cast<std::uint32_t>(places[i]));
            at.push_back(i);
        }
        auto of_map = engine_->maps[map].filter->histories(voxels);
        for (std::size_t i = 0; i < at.size(); ++i) histories[at[i]] = std::move(of_map[i]);
    }
    return histories;
}

Counters OnlineFilter::counters() const {
    const std::lock_guard hold(engine_->lock);
    Counters counters = engine_->counters;
    counters.queued = engine_->queue.size() + (engine_->judging ? 1 : 0);
    return counters;
}

std::vector<StaticVoxel> OnlineFilter::local_static_map(const Pose& T_world_query,
                                                        std::optional<double> radius) {
    std::vector<StaticVoxel> voxels;
    with_threads(engine_->options.threads, [&] {
        const std::lock_guard hold(engine_->map_lock);
        voxels = engine_->newest().local_static_map(T_world_query, radius);
    });
    return voxels;
}

std::vector<StaticVoxel> OnlineFilter::static_map() const {
    std::vector<StaticVoxel> all;
    for (const Map& map : engine_->maps) {
        const std::vector<StaticVoxel> some = map.filter->static_map();
        all.insert(all.end(), some.begin(), some.end());
    }
    return all;
}

StageTimes OnlineFilter::times() const {
    StageTimes times;
    for (const Map& map : engine_->maps) {
        for (const auto& [stage, calls] : map.filter->times()) times[stage].add(calls);
    }
    times["latency"] = engine_->latency;
    return times;
}

OnlineFilter::Extent OnlineFilter::extent() const {
    Extent extent;
    for (const Map& map : engine_->maps) {
        ++extent.maps;
        extent.submaps += map.filter->submaps();
        extent.voxels += map.filter->voxels();
        if (map.filter->beams()) extent.beams = map.filter->beams();
        const std::vector<std::size_t> keyframes = map.filter->keyframes();
        extent.keyframes_total += map.filter->keyframes_total();
        extent.keyframes.insert(extent.keyframes.end(), keyframes.begin(), keyframes.end());
    }
    return extent;
}

}  // namespace dynamic_filter
