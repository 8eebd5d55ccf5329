// SPDX-License-Identifier: MIT
#include "online/scan_worker.hpp"

#include <utility>

#include "dynamic_filter/error.hpp"
#include "dynamic_filter/parallel.hpp"

namespace dynamic_filter {

namespace {

void answer(QueuedScan& scan, std::optional<Verdict> verdict) {
    if (scan.reply) std::exchange(scan.reply, nullptr)->set_value(std::move(verdict));
}

}  // namespace

ScanWorker::ScanWorker(Maps& maps, OnlineOptions options, OnlineCallbacks callbacks)
    : options_(options),
      callbacks_(std::move(callbacks)),
      maps_(maps),
      worker_([this] { work(); }) {}

std::optional<Verdict> ScanWorker::ask(Scan scan) {
    refuse_in_callback();
    auto reply = std::make_shared<std::promise<std::optional<Verdict>>>();
    auto verdict = reply->get_future();
    push({.scan = std::move(scan), .reply = std::move(reply)});
    return verdict.get();
}

void ScanWorker::with_maps(const std::function<void(Maps&)>& use) const {
    with_threads(options_.threads, [&] {
        const std::lock_guard hold(map_lock_);
        use(maps_);
    });
}

void ScanWorker::push(QueuedScan scan) {
    std::optional<Notice> refused;
    std::vector<QueuedScan> dropped;
    if (options_.overload == Overload::wait) refuse_in_callback();
    {
        std::unique_lock hold(lock_);
        if (options_.overload == Overload::wait) {
            changed_.wait(hold, [&] { return failure_ || queue_.size() < options_.queue; });
        }
        if (failure_) std::rethrow_exception(failure_);
        if (finished_) throw Error("push() after finish(): make another filter");
        ++counters_.in;
        refused = queue_.refusal(scan.scan);
        if (refused) {
            ++counters_.rejected;
        } else {
            queue_.add(std::move(scan));
            while (queue_.size() > options_.queue) dropped.push_back(queue_.drop());
            counters_.dropped += dropped.size();
            changed_.notify_all();
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
void ScanWorker::work() {
    try {
        with_threads(options_.threads, [&] {
            while (auto scan = next()) {
                judge(*scan);
                std::vector<Verdict> settled;
                {
                    const std::lock_guard hold(map_lock_);
                    settled = maps_.catch_up();
                }
                settle(settled);
                const std::lock_guard hold(lock_);
                busy_ = false;
                changed_.notify_all();
            }
        });
    } catch (...) {
        fail(std::current_exception());
    }
}

void ScanWorker::begin_anew() {
    const std::lock_guard hold(lock_);
    queue_.begin_anew();
}

/// The scan with the oldest stamp; empty: the filter stops.
std::optional<QueuedScan> ScanWorker::next() {
    std::unique_lock hold(lock_);
    changed_.wait(hold, [&] { return stopping_ || queue_.size() > 0; });
    if (stopping_) return std::nullopt;
    busy_ = true;
    changed_.notify_all();  // there is room in the queue
    return queue_.pop();
}

void ScanWorker::judge(QueuedScan& next) {
    const std::size_t index = next.scan.index;
    try {
        Maps::Judged judged;
        {
            const std::lock_guard hold(map_lock_);
            const bool restarts = std::exchange(stretch_, next.stretch) != next.stretch;
            judged = maps_.judge(std::move(next.scan), !restarts         ? Maps::Follows::on
                                                       : next.was_wanted ? Maps::Follows::anew
                                                                         : Maps::Follows::restarts);
        }
        latency_.add(seconds_since(next.since));
        deliver(std::move(judged), &next, index);
    } catch (...) {
        if (next.reply) next.reply->set_exception(std::current_exception());
        const std::lock_guard hold(lock_);
        ++counters_.rejected;
        throw;
    }
    const std::lock_guard hold(lock_);
    ++counters_.processed;
}

/// Gives everything to the callbacks, and the verdict on scan `index` to whoever asked for it.
void ScanWorker::deliver(Maps::Judged judged, QueuedScan* asked, std::size_t index) {
    settle(judged.settled);
    if (judged.notice) tell(*judged.notice);
    std::optional<Verdict> own;
    for (Verdict& verdict : judged.instant) {
        if (callbacks_.instant) callbacks_.instant(verdict);
        if (verdict.index == index) own = std::move(verdict);
    }
    if (asked) answer(*asked, std::move(own));
}

void ScanWorker::settle(const std::vector<Verdict>& verdicts) const {
    if (!callbacks_.settled) return;
    for (const Verdict& verdict : verdicts) callbacks_.settled(verdict);
}

void ScanWorker::tell(const Notice& notice) {
    const std::lock_guard hold(notice_lock_);
    if (callbacks_.notice) callbacks_.notice(notice);
}

void ScanWorker::refuse_in_callback() const {
    const std::thread::id here = std::this_thread::get_id();
    if (here != worker_id_ && here != finishing_) return;
    throw Error("a callback must not wait for the filter that calls it");
}

/// Waits until the worker has nothing to do. Rethrows its exception.
std::unique_lock<std::mutex> ScanWorker::idle() {
    refuse_in_callback();
    std::unique_lock hold(lock_);
    changed_.wait(hold, [&] { return failure_ || (queue_.size() == 0 && !busy_); });
    if (failure_) std::rethrow_exception(failure_);
    return hold;
}

void ScanWorker::flush() {
    idle().unlock();
    try {
        const std::lock_guard hold(map_lock_);
        maps_.flush();
    } catch (...) {
        fail(std::current_exception());
        throw;
    }
}

void ScanWorker::finish() {
    refuse_in_callback();
    const std::lock_guard one_at_a_time(finish_lock_);
    {
        const auto hold = idle();
        if (std::exchange(finished_, true)) return;
    }
    stop();
    finishing_ = std::this_thread::get_id();
    try {
        with_threads(options_.threads, [&] {
            Maps::Judged judged;
            {
                const std::lock_guard hold(map_lock_);
                judged = maps_.finish();
            }
            deliver(std::move(judged), nullptr, 0);
        });
    } catch (...) {
        finishing_ = std::thread::id();
        fail(std::current_exception());
        throw;
    }
    finishing_ = std::thread::id();
}

/// The worker ends after the scan that it judges. A second call does nothing.
void ScanWorker::stop() {
    {
        const std::lock_guard hold(lock_);
        stopping_ = true;
        drop_waiting();
        changed_.notify_all();
    }
    if (worker_.joinable()) worker_.join();
}

void ScanWorker::fail(std::exception_ptr error) {
    const std::lock_guard hold(lock_);
    if (!failure_) failure_ = std::move(error);
    busy_ = false;
    stopping_ = true;
    drop_waiting();
    changed_.notify_all();
}

/// Call it with the lock held.
void ScanWorker::drop_waiting() {
    while (queue_.size() > 0) {
        QueuedScan waiting = queue_.drop();
        ++counters_.dropped;
        answer(waiting, std::nullopt);
    }
}

/// A scan counts as queued until its verdict is delivered.
Counters ScanWorker::counters() const {
    const std::lock_guard hold(lock_);
    Counters now = counters_;
    now.queued = now.in - now.processed - now.dropped - now.rejected;
    return now;
}

}  // namespace dynamic_filter
