// SPDX-License-Identifier: MIT
/// Scans that wait to be judged, in the order of their stamps. It takes no locks; the owner holds
/// one.
#pragma once

#include <chrono>
#include <cstdint>
#include <deque>
#include <future>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <variant>

#include "dynamic_filter/online.hpp"

namespace dynamic_filter {

struct QueuedScan {
    Scan scan;
    /// Number of the stretch: within it stamps increase, and a restart begins the next one.
    std::uint64_t stretch = 0;
    bool was_wanted = false;  ///< true: begin_anew() began the stretch with this scan
    std::chrono::steady_clock::time_point since = std::chrono::steady_clock::now();
    std::shared_ptr<std::promise<std::optional<Verdict>>> reply;  ///< may be null
};

class ScanQueue {
public:
    /// The reason why the scan cannot be added; empty if it can.
    [[nodiscard]] std::optional<Notice> refusal(const Scan& scan) const;

    /// Inserts a scan that is not refused. (A scan is late if a later one of its own sensor was
    /// judged.) If its stamp is more than 1 s older than the newest one,
    /// it begins a new stretch. If it is a little older, it goes before the waiting scans with
    /// later stamps.
    void add(QueuedScan waiting);

    /// The next scan that is added begins a new stretch.
    void begin_anew() { begins_anew_ = true; }

    /// Returns the scan with the oldest stamp.
    /// To judge it: scans with older stamps are late from now on.
    QueuedScan pop();
    QueuedScan drop();  ///< to make room

    /// For a caller that judges each scan at once: add() and pop(), or why the scan is refused.
    std::variant<QueuedScan, Notice> pass(Scan scan);

    [[nodiscard]] std::size_t size() const { return waiting_.size(); }

private:
    [[nodiscard]] bool restarts(double stamp) const;
    QueuedScan remove_oldest();

    std::deque<QueuedScan> waiting_;
    std::uint64_t stretch_ = 0;
    bool begins_anew_ = false;
    std::optional<bool> with_poses_;
    std::optional<double> newest_;  // largest stamp within the stretch
    struct Taken {
        std::uint64_t stretch;
        double stamp;
        Pose T_world_sensor;
    };
    std::map<std::size_t, Taken> taken_;  // the scan that was taken last, by sensor
};

}  // namespace dynamic_filter
