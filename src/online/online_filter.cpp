// SPDX-License-Identifier: MIT
#include "dynamic_filter/online.hpp"

#include <algorithm>
#include <condition_variable>
#include <mutex>
#include <string>
#include <thread>
#include <utility>

#include "dynamic_filter/error.hpp"
#include "dynamic_filter/parallel.hpp"
#include "online/maps.hpp"
#include "online/scan_queue.hpp"
#include "settings/table.hpp"

namespace dynamic_filter {

namespace {

OnlineOptions checked(OnlineOptions options) {
    for (const std::string& fault : violations(options)) {
        throw ConfigError("OnlineOptions: " + fault);
    }
    return options;
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

/// There are two locks: `map_lock` guards the maps, and `lock` guards the queue and the counters. A
/// thread that holds `lock` takes no other lock. Callbacks are called without a lock.
struct OnlineFilter::Engine {
    Engine(const Config& config, OnlineOptions options_of_all, OnlineCallbacks call);

    // Functions for users.
    void push(QueuedScan scan);
    void flush();
    void finish();
    void stop();
    [[nodiscard]] Counters count() const;
    void refuse_own_thread() const;

    // The worker.
    void work();
    std::optional<QueuedScan> next();
    void judge(QueuedScan& next);

    std::unique_lock<std::mutex> idle();
    void deliver(Maps::Judged judged, QueuedScan* asked, std::size_t index);
    void settle(const std::vector<Verdict>& verdicts) const;
    void drop_waiting();
    void tell(const Notice& notice);
    void fail(std::exception_ptr error);

    const OnlineOptions options;
    const OnlineCallbacks callbacks;

    mutable std::mutex lock;
    std::condition_variable changed;  // notified when a member below changed
    ScanQueue queue;
    Counters counters;  // without `queued`
    bool finished = false, busy = false, stopping = false;
    std::exception_ptr failure;

    mutable std::mutex map_lock;
    Maps maps;

    std::mutex notice_lock, finish_lock;  // so that calls of the same kind never overlap

    // Data of the worker.
    std::uint64_t run = 0;
    Durations latency;

    std::thread worker;  // must be the last member, because it uses all others
};

OnlineFilter::Engine::Engine(const Config& config, OnlineOptions options_of_all,
                             OnlineCallbacks call)
    : options(checked(options_of_all)),
      callbacks(std::move(call)),
      maps(config, options),
      worker([this] { work(); }) {}

void OnlineFilter::Engine::push(QueuedScan scan) {
    std::optional<Notice> refused;
    std::vector<QueuedScan> dropped;
    {
        std::unique_lock hold(lock);
        if (options.overload == Overload::wait) {
            changed.wait(hold, [&] { return failure || queue.size() < options.queue; });
        }
        if (failure) std::rethrow_exception(failure);
        if (finished) throw Error("push() after finish(): make another filter");
        ++counters.in;
        refused = queue.refusal(scan.scan);
        if (refused) {
            ++counters.rejected;
        } else {
            queue.add(std::move(scan));
            while (queue.size() > options.queue) dropped.push_back(queue.drop());
            counters.dropped += dropped.size();
            changed.notify_all();
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

/// One scan after the other: judge, deliver, catch up. If a step fails, the worker ends, and the
/// next caller gets the exception.
void OnlineFilter::Engine::work() {
    try {
        with_threads(options.threads, [&] {
            while (auto scan = next()) {
                judge(*scan);
                std::vector<Verdict> settled;
                {
                    const std::lock_guard hold(map_lock);
                    settled = maps.catch_up();
                }
                settle(settled);
                const std::lock_guard hold(lock);
                busy = false;
                changed.notify_all();
            }
        });
    } catch (...) {
        fail(std::current_exception());
    }
}

/// The scan with the oldest stamp; empty: the filter stops.
std::optional<QueuedScan> OnlineFilter::Engine::next() {
    std::unique_lock hold(lock);
    changed.wait(hold, [&] { return stopping || queue.size() > 0; });
    if (stopping) return std::nullopt;
    busy = true;
    changed.notify_all();  // there is room in the queue
    return queue.take();
}

void OnlineFilter::Engine::judge(QueuedScan& next) {
    const std::size_t index = next.scan.index;
    try {
        Maps::Judged judged;
        {
            const std::lock_guard hold(map_lock);
            judged = maps.judge(std::move(next.scan), std::exchange(run, next.run) != next.run);
        }
        latency.add(seconds_since(next.since));
        deliver(std::move(judged), &next, index);
    } catch (...) {
        if (next.reply) next.reply->set_exception(std::current_exception());
        const std::lock_guard hold(lock);
        ++counters.rejected;
        throw;
    }
    const std::lock_guard hold(lock);
    ++counters.processed;
}

/// Gives everything to the callbacks, and the verdict on scan `index` to whoever asked for it.
void OnlineFilter::Engine::deliver(Maps::Judged judged, QueuedScan* asked, std::size_t index) {
    settle(judged.settled);
    if (judged.notice) tell(*judged.notice);
    std::optional<Verdict> own;
    for (Verdict& verdict : judged.instant) {
        if (callbacks.instant) callbacks.instant(verdict);
        if (verdict.index == index) own = std::move(verdict);
    }
    if (asked) answer(*asked, std::move(own));
}

void OnlineFilter::Engine::settle(const std::vector<Verdict>& verdicts) const {
    if (!callbacks.settled) return;
    for (const Verdict& verdict : verdicts) callbacks.settled(verdict);
}

void OnlineFilter::Engine::tell(const Notice& notice) {
    const std::lock_guard hold(notice_lock);
    if (callbacks.notice) callbacks.notice(notice);
}

void OnlineFilter::Engine::refuse_own_thread() const {
    if (worker.get_id() != std::this_thread::get_id()) return;
    throw Error("a callback must not wait for the filter that calls it");
}

/// Waits until the worker has nothing to do. Rethrows its exception.
std::unique_lock<std::mutex> OnlineFilter::Engine::idle() {
    refuse_own_thread();
    std::unique_lock hold(lock);
    changed.wait(hold, [&] { return failure || (queue.size() == 0 && !busy); });
    if (failure) std::rethrow_exception(failure);
    return hold;
}

void OnlineFilter::Engine::flush() {
    idle().unlock();
    try {
        const std::lock_guard hold(map_lock);
        maps.flush();
    } catch (...) {
        fail(std::current_exception());
        throw;
    }
}

void OnlineFilter::Engine::finish() {
    const std::lock_guard one_at_a_time(finish_lock);
    {
        const auto hold = idle();
        if (std::exchange(finished, true)) return;
    }
    stop();
    try {
        with_threads(options.threads, [&] {
            Maps::Judged judged;
            {
                const std::lock_guard hold(map_lock);
                judged = maps.finish();
            }
            deliver(std::move(judged), nullptr, 0);
        });
    } catch (...) {
        fail(std::current_exception());
        throw;
    }
}

/// The worker ends after the scan that it judges. A second call does nothing.
void OnlineFilter::Engine::stop() {
    {
        const std::lock_guard hold(lock);
        stopping = true;
        drop_waiting();
        changed.notify_all();
    }
    if (worker.joinable()) worker.join();
}

void OnlineFilter::Engine::fail(std::exception_ptr error) {
    const std::lock_guard hold(lock);
    if (!failure) failure = std::move(error);
    busy = false;
    stopping = true;
    drop_waiting();
    changed.notify_all();
}

/// Call it with the lock held.
void OnlineFilter::Engine::drop_waiting() {
    while (queue.size() > 0) {
        QueuedScan waiting = queue.drop();
        ++counters.dropped;
        answer(waiting, std::nullopt);
    }
}

/// A scan counts as queued until its verdict is delivered.
Counters OnlineFilter::Engine::count() const {
    const std::lock_guard hold(lock);
    Counters now = counters;
    now.queued = now.in - now.processed - now.dropped - now.rejected;
    return now;
}

OnlineFilter::OnlineFilter(const Config& config, OnlineOptions options, OnlineCallbacks callbacks)
    : engine_(std::make_unique<Engine>(config, options, std::move(callbacks))) {}

OnlineFilter::~OnlineFilter() { engine_->stop(); }

void OnlineFilter::push(Scan scan) { engine_->push({.scan = std::move(scan), .reply = nullptr}); }

std::optional<Verdict> OnlineFilter::ask(Scan scan) {
    engine_->refuse_own_thread();
    auto reply = std::make_shared<std::promise<std::optional<Verdict>>>();
    auto verdict = reply->get_future();
    engine_->push({.scan = std::move(scan), .reply = std::move(reply)});
    return verdict.get();
}

void OnlineFilter::flush() { engine_->flush(); }
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

bool OnlineFilter::judges_each_scan() const { return engine_->maps.judges_each_scan(); }

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
        voxels = engine_->maps.local_static_map(T_world_query, radius);
    });
    return voxels;
}

std::vector<StaticVoxel> OnlineFilter::static_map() const { return engine_->maps.static_map(); }

StageTimes OnlineFilter::times() const {
    StageTimes times = engine_->maps.times();
    times["latency"] = engine_->latency;
    return times;
}

std::size_t OnlineFilter::maps() const { return engine_->maps.size(); }
MapContents OnlineFilter::contents() const { return engine_->maps.contents(); }

}  // namespace dynamic_filter
