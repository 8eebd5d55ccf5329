// SPDX-License-Identifier: MIT
/// The filter, and the threads that publish what it says.
#pragma once

#include <atomic>
#include <condition_variable>
#include <deque>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "check/watch.hpp"
#include "dynamic_filter/online.hpp"
#include "live/outputs.hpp"
#include "live/recorder.hpp"
#include "navigation/local_grid.hpp"

namespace dynamic_filter::live {

/// [ms] from the arrival of a cloud until its labels are published, of the newest scans.
struct Latencies {
    double p50 = 0.0, p99 = 0.0, most = 0.0;
    std::size_t scans = 0;
};

/// How reliable the own odometry, or the refined poses, are.
struct OdometryState {
    std::uint64_t good = 0, weak = 0, lost = 0;  ///< scans
    TrackStatus last = TrackStatus::good;
};

/// push(), the getters and pop_notices() have one caller; threads of its own do the rest.
class Session {
public:
    /// `recorder` may be null. All must outlive this object.
    Session(const LiveConfig& config, Outputs& outputs, Recorder* recorder);
    /// Waits until what was pushed is judged, published and recorded: a few scans at most.
    ~Session();
    Session(const Session&) = delete;
    Session& operator=(const Session&) = delete;

    void push(LiveScan scan);  ///< rethrows what stopped the filter
    /// True if the filter has enough to do; a scan that waits outside can still be replaced.
    [[nodiscard]] bool is_busy() const { return filter_->counters().queued > 1; }
    /// The next scan begins a new map, and what was seen so far is forgotten.
    void begin_anew() { filter_->begin_anew(); }
    void stop();  ///< as the destructor; the getters may be called after it
    /// How often the local map is published, and its radius [m].
    void set_map(double rate_hz, double radius);

    /// All static voxels of the newest map that the filter holds (preset `paper`: those around the
    /// sensor), from any thread, also after stop(). Empty before the first verdict. Verdicts wait
    /// for it.
    [[nodiscard]] std::vector<StaticVoxel> static_map() const;

    [[nodiscard]] Counters counters() const { return filter_->counters(); }
    [[nodiscard]] Latencies latencies() const;
    [[nodiscard]] OdometryState odometry() const;
    /// What is wrong with the results of the newest scans, in a sentence; "" if nothing is.
    [[nodiscard]] std::string alarm() const;
    [[nodiscard]] std::uint64_t published() const { return published_; }
    /// Judged scans that were neither published nor recorded, because publishing is too slow.
    [[nodiscard]] std::uint64_t unpublished() const { return unpublished_; }
    std::vector<std::string> pop_notices();

private:
    struct Work {
        std::shared_ptr<LiveScan> scan;
        Verdict verdict;
    };
    struct Place {
        Pose T_world_sensor = Pose::Identity();
        std::string world;
        double stamp = 0.0;
    };
    struct Unsettled {
        JudgedScan judged;
        Scan scan;
        std::vector<std::uint8_t> own;  // see LiveScan::own
    };
    OnlineCallbacks callbacks();
    void add_instant(const Verdict& verdict);
    void add_notice(const Notice& notice);
    void put(Work work);
    void publish_work();
    void publish(Work& work);
    template <class Publish>
    void repeat(const double& rate, const Publish& publish);
    void publish_maps();
    [[nodiscard]] bool has_grid() const;
    void publish_grids();
    void record(const LiveScan& scan);
    void watch(const LiveScan& scan, const Verdict& verdict);
    void note_latency(const LiveScan& scan);
    void fail(std::exception_ptr error);

    const LiveConfig& config_;
    io::Boxes own_body_;
    Outputs& outputs_;
    Recorder* recorder_;  // of the publishing thread; may be null

    mutable std::mutex lock_;  // guards the members below
    std::condition_variable changed_;
    std::map<std::size_t, std::shared_ptr<LiveScan>> pending_;  // keys: Scan::index
    std::deque<Work> work_;
    std::deque<float> latencies_;  // [ms]
    OdometryState odometry_;
    std::deque<io::ScanWatch> watch_;  // of the newest scans
    std::vector<std::string> notices_;
    std::optional<Place> newest_;
    double map_rate_, map_radius_;
    bool stopping_ = false;
    std::exception_ptr failure_;  // of publishing

    std::deque<Unsettled> unsettled_;  // of the publishing thread
    std::atomic<std::uint64_t> published_{0}, unpublished_{0};
    std::size_t next_index_ = 0;
    app::LocalGrid grid_;
    std::unique_ptr<OnlineFilter> filter_;
    std::thread publisher_, mapper_, gridder_;
};

}  // namespace dynamic_filter::live
