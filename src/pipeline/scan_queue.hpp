// SPDX-License-Identifier: MIT
/// Scans that wait to be judged, in the order of their stamps. No locks: its owner holds one.
#pragma once

#include <chrono>
#include <cstdint>
#include <deque>
#include <future>
#include <memory>
#include <optional>
#include <string>

#include "dynamic_filter/pipeline/online_filter.hpp"

namespace dynamic_filter {

struct QueuedScan {
    Scan scan;
    std::uint64_t run = 0;  ///< of growing stamps; a restart begins the next
    std::chrono::steady_clock::time_point since = std::chrono::steady_clock::now();
    std::shared_ptr<std::promise<std::optional<Verdict>>> reply;  ///< may be null
};

class ScanQueue {
public:
    /// Why the scan cannot be taken; empty: it can.
    [[nodiscard]] std::optional<Notice> refusal(const Scan& scan) const;

    /// Puts a scan that is not refused into its place. Stamps that went back by more than a second
    /// begin a new run; a little, and the scan goes before those that still wait.
    void add(QueuedScan waiting);

    /// The oldest.
    QueuedScan take();  ///< to judge it: what is older is late from now on
    QueuedScan drop();  ///< to make room

    [[nodiscard]] std::size_t size() const { return waiting_.size(); }

private:
    [[nodiscard]] bool restarts(double stamp) const;
    QueuedScan pop();

    std::deque<QueuedScan> waiting_;
    std::uint64_t run_ = 0;
    std::optional<bool> with_poses_;
    std::optional<double> newest_;  // stamp within the run
    struct Taken {
        std::uint64_t run;
        double stamp;
        Pose T_world_sensor;
    };
    std::optional<Taken> taken_;  // last
};

}  // namespace dynamic_filter
