// SPDX-License-Identifier: MIT
/// A queue of scans and a thread that takes them out: it judges a scan, delivers the verdict, and
/// catches up with the map.
#pragma once

#include <atomic>
#include <condition_variable>
#include <exception>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>

#include "dynamic_filter/online.hpp"
#include "online/maps.hpp"
#include "online/scan_queue.hpp"

namespace dynamic_filter {

/// There are two locks: `map_lock_` guards the maps, and `lock_` guards the queue and the counters.
/// A thread that holds `lock_` takes no other lock. Callbacks are called without a lock. All
/// members may be called from any thread, except from a callback where they wait.
class ScanWorker {
public:
    /// `maps` must outlive the object. Nobody else may change them before finish(). Throws
    /// std::system_error if no thread can be started.
    ScanWorker(Maps& maps, OnlineOptions options, OnlineCallbacks callbacks);
    ScanWorker(const ScanWorker&) = delete;
    ScanWorker& operator=(const ScanWorker&) = delete;
    ~ScanWorker() { stop(); }

    // See OnlineFilter.
    void push(Scan scan) { push(QueuedScan{.scan = std::move(scan), .reply = nullptr}); }
    std::optional<Verdict> ask(Scan scan);
    void begin_anew();
    void flush();
    void finish();
    [[nodiscard]] Counters counters() const;
    /// [s] from push() to the end of judging; after flush().
    [[nodiscard]] const Durations& latency() const { return latency_; }

    /// Calls use() with the options' number of threads while the worker leaves the maps alone.
    void with_maps(const std::function<void(Maps&)>& use) const;

private:
    void push(QueuedScan scan);
    void stop();

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
    void refuse_in_callback() const;

    const OnlineOptions options_;
    const OnlineCallbacks callbacks_;

    mutable std::mutex lock_;
    std::condition_variable changed_;  // notified when a member below changed
    ScanQueue queue_;
    Counters counters_;  // without `queued`
    bool finished_ = false, busy_ = false, stopping_ = false;
    std::exception_ptr failure_;

    mutable std::mutex map_lock_;
    Maps& maps_;

    std::mutex notice_lock_, finish_lock_;      // so that calls of the same kind never overlap
    std::atomic<std::thread::id> finishing_{};  // the thread that delivers the last verdicts

    // Data of the worker.
    std::uint64_t stretch_ = 0;
    Durations latency_;

    std::thread worker_;  // must be the last but its number, because it uses all others
    const std::thread::id worker_id_{worker_.get_id()};
};

}  // namespace dynamic_filter
