// SPDX-License-Identifier: MIT
#include "live/session.hpp"

#include <fmt/format.h>

#include "dynamic_filter/error.hpp"
#include "recording/mask.hpp"

namespace dynamic_filter::live {

namespace {

constexpr std::size_t kMostWork = 16;      // that waits to be published
constexpr std::size_t kMostPending = 200;  // preset paper: verdicts come window by window
constexpr std::size_t kMostLatencies = 1000;
constexpr std::size_t kWatched = 50;  // scans

OnlineOptions options_of(const LiveConfig& config) {
    return {.queue = static_cast<std::size_t>(config.input.queue),
            .overload = Overload::drop_oldest,
            .horizon = config.limits.horizon,
            .max_bytes = static_cast<std::size_t>(config.limits.map_mib) << 20,
            .settle_after = 0,  // scans are settled here, and only if somebody wants corrections
            .threads = config.limits.threads};
}

/// The scan as the filter saw it.
Scan scan_of(const LiveScan& scan, const Verdict& verdict) {
    Scan seen{scan.points, scan.T_world_sensor, scan.stamp, verdict.index, true, {}, scan.sensor};
    if (!verdict.tracked) return seen;
    seen.T_world_sensor = verdict.tracked->T_world_sensor;
    if (!scan.times.empty()) {
        seen.points = undo_motion(seen.points, scan.times, verdict.tracked->velocity);
    }
    return seen;
}

}  // namespace

Session::Session(const LiveConfig& config, Outputs& outputs, Recorder* recorder)
    : config_(config),
      own_body_(config.input.mask.empty() ? io::Boxes{} : io::read_mask(config.input.mask)),
      outputs_(outputs),
      recorder_(recorder),
      map_rate_(config.output.map_rate),
      map_radius_(config.output.map_radius),
      grid_(
          {config.grid.radius,
           config.grid.cell,
           {static_cast<float>(config.grid.robot_height), static_cast<float>(config.grid.step)}}) {
    filter_ = std::make_unique<OnlineFilter>(config.filter, options_of(config), callbacks());
    publisher_ = std::thread([this] { publish_work(); });
    mapper_ = std::thread([this] { publish_maps(); });
    gridder_ = std::thread([this] { publish_grids(); });
}

Session::~Session() { stop(); }

void Session::stop() {
    try {
        filter_->flush();
    } catch (...) {
        fail(std::current_exception());
    }
    {
        const std::lock_guard hold(lock_);
        if (std::exchange(stopping_, true)) return;
    }
    changed_.notify_all();
    publisher_.join();
    mapper_.join();
    gridder_.join();
}

void Session::set_map(double rate_hz, double radius) {
    const std::lock_guard hold(lock_);
    map_rate_ = rate_hz;
    map_radius_ = radius;
}

void Session::fail(std::exception_ptr error) {
    const std::lock_guard hold(lock_);
    failure_ = std::move(error);
}

OnlineCallbacks Session::callbacks() {
    return {.instant = [this](const Verdict& verdict) { add_instant(verdict); },
            .settled = {},
            .notice = [this](const Notice& notice) { add_notice(notice); }};
}

void Session::push(LiveScan scan) {
    scan.own = io::take_out(own_body_, scan.points);
    Scan core{scan.points,   scan.T_world_sensor, scan.stamp, next_index_++,
              scan.has_pose, scan.times,          scan.sensor};
    {
        const std::lock_guard hold(lock_);
        if (failure_) std::rethrow_exception(failure_);
        pending_.emplace(core.index, std::make_shared<LiveScan>(std::move(scan)));
        if (pending_.size() > kMostPending) {
            pending_.erase(pending_.begin());
            ++unpublished_;
        }
    }
    filter_->push(std::move(core));
}

void Session::add_instant(const Verdict& verdict) {
    std::shared_ptr<LiveScan> scan;
    {
        const std::lock_guard hold(lock_);
        const auto found = pending_.find(verdict.index);
        if (found == pending_.end()) return;
        scan = std::move(found->second);
        pending_.erase(found);
        newest_ = Place{scan->T_world_sensor, scan->world, scan->stamp};
        if (verdict.tracked) {
            newest_->T_world_sensor = verdict.tracked->T_world_sensor;
            odometry_.last = verdict.tracked->status;
            ++(odometry_.last == TrackStatus::good   ? odometry_.good
               : odometry_.last == TrackStatus::weak ? odometry_.weak
                                                     : odometry_.lost);
        }
        if (!scan->has_pose) newest_->world = config_.output.map_frame;
    }
    put({std::move(scan), verdict});
}

/// The scan of all notices but those of new maps gets no verdict.
void Session::add_notice(const Notice& notice) {
    const std::lock_guard hold(lock_);
    const bool new_map = notice.kind == NoticeKind::jump || notice.kind == NoticeKind::restart;
    if (new_map) {
        grid_.begin_world(notice.index);
    } else {
        pending_.erase(notice.index);
    }
    constexpr std::size_t kMost = 20;  // between two calls of pop_notices()
    // Dropped scans are counted; a line for each would fill the log when the log helps least.
    if (notice.kind == NoticeKind::dropped || notices_.size() >= kMost) return;
    notices_.push_back(fmt::format("scan {}: {}", notice.index, notice.text));
}

void Session::put(Work work) {
    {
        const std::lock_guard hold(lock_);
        if (stopping_) return;
        work_.push_back(std::move(work));
        if (work_.size() > kMostWork) {
            ++unpublished_;
            work_.pop_front();
        }
    }
    changed_.notify_all();
}

void Session::publish_work() {
    try {
        while (true) {
            std::unique_lock hold(lock_);
            changed_.wait(hold, [&] { return stopping_ || !work_.empty(); });
            if (work_.empty()) return;
            Work work = std::move(work_.front());
            work_.pop_front();
            hold.unlock();
            publish(work);
        }
    } catch (...) {
        fail(std::current_exception());
    }
}

void Session::publish(Work& work) {
    io::label_own_body(work.scan->own, work.verdict.labels);
    JudgedScan judged = outputs_.judged(*work.scan, work.verdict);
    note_latency(*work.scan);
    watch(*work.scan, work.verdict);
    ++published_;
    record(*work.scan);
    const bool for_grid = has_grid() && grid_.is_due(work.scan->stamp);
    const bool for_settling = config_.output.settle_after > 0 && filter_->judges_each_scan();
    if (!for_grid && !for_settling) return;
    Scan scan = scan_of(*work.scan, work.verdict);
    if (for_grid) grid_.add(scan);
    if (!for_settling) return;
    unsettled_.push_back({std::move(judged), std::move(scan), std::move(work.scan->own)});
    if (unsettled_.size() <= static_cast<std::size_t>(config_.output.settle_after)) return;
    const Unsettled due = std::move(unsettled_.front());
    unsettled_.pop_front();
    if (outputs_.wants_corrections()) {
        Verdict verdict = filter_->settled(due.scan);
        io::label_own_body(due.own, verdict.labels);
        outputs_.settled(due.judged, verdict);
    }
}

/// A disk that is full ends the recording, but not the filter: the robot needs it.
void Session::record(const LiveScan& scan) {
    if (recorder_ == nullptr) return;
    try {
        recorder_->add(scan);
    } catch (const OutputError& error) {
        recorder_ = nullptr;
        const std::lock_guard hold(lock_);
        notices_.push_back(fmt::format("the recording has ended: {}", error.what()));
    }
}

void Session::note_latency(const LiveScan& scan) {
    const std::chrono::duration<float, std::milli> passed =
        std::chrono::steady_clock::now() - scan.arrived;
    const std::lock_guard hold(lock_);
    latencies_.push_back(passed.count());
    if (latencies_.size() > kMostLatencies) latencies_.pop_front();
}

/// Calls `publish(newest place)` at a rate [Hz] that may change, until the end; 0: never.
template <class Publish>
void Session::repeat(const double& rate, const Publish& publish) {
    try {
        std::unique_lock hold(lock_);
        auto due = std::chrono::steady_clock::now();
        while (!stopping_) {
            const std::chrono::duration<double> pause(rate > 0.0 ? 1.0 / rate : 1.0);
            due = std::max(due + std::chrono::duration_cast<SteadyTime::duration>(pause),
                           std::chrono::steady_clock::now());
            changed_.wait_until(hold, due, [&] { return stopping_; });
            if (stopping_ || rate <= 0.0 || !newest_) continue;
            const Place at = *newest_;
            hold.unlock();
            publish(at);
            hold.lock();
        }
    } catch (...) {
        fail(std::current_exception());
    }
}

void Session::publish_maps() {
    repeat(map_rate_, [&](const Place& at) {
        if (!outputs_.wants_map()) return;
        double radius = 0.0;
        {
            const std::lock_guard hold(lock_);
            radius = map_radius_;
        }
        outputs_.map(filter_->local_static_map(at.T_world_sensor, radius), at.world, at.stamp);
    });
}

std::vector<StaticVoxel> Session::static_map() const {
    constexpr double kWhole = 1e6;  // [m]
    std::optional<Place> at;
    {
        const std::lock_guard hold(lock_);
        at = newest_;
    }
    if (!at) return {};
    return filter_->local_static_map(at->T_world_sensor, kWhole);
}

/// Presets that judge scans window by window have no verdict by the evidence so far.
bool Session::has_grid() const {
    return config_.grid.rate > 0.0 && filter_->judges_each_scan() && outputs_.wants_grid();
}

void Session::publish_grids() {
    repeat(config_.grid.rate, [&](const Place& at) {
        if (!has_grid()) return;
        const auto cells = grid_.cells([&](const Scan& scan) { return filter_->settled(scan); });
        if (cells) outputs_.grid(*cells, at.world, at.stamp);
    });
}

Latencies Session::latencies() const {
    std::vector<float> sorted;
    {
        const std::lock_guard hold(lock_);
        sorted.assign(latencies_.begin(), latencies_.end());
    }
    if (sorted.empty()) return {};
    std::sort(sorted.begin(), sorted.end());
    const auto at = [&](double share) {
        return sorted[static_cast<std::size_t>(share * static_cast<double>(sorted.size() - 1))];
    };
    return {at(0.5), at(0.99), sorted.back(), sorted.size()};
}

void Session::watch(const LiveScan& scan, const Verdict& verdict) {
    const Pose& T_world_sensor =
        verdict.tracked ? verdict.tracked->T_world_sensor : scan.T_world_sensor;
    const io::ScanWatch seen =
        io::watch_scan(verdict.index, scan.points, T_world_sensor, verdict.labels);
    const std::lock_guard hold(lock_);
    watch_.push_back(seen);
    if (watch_.size() > kWatched) watch_.pop_front();
}

/// Only the ground tells: the places that a scan sees first are unknown for a moment, and a truck
/// beside the sensor may fill many scans.
std::string Session::alarm() const {
    std::vector<io::ScanWatch> newest;
    {
        const std::lock_guard hold(lock_);
        if (watch_.size() < kWatched) return "";
        newest.assign(watch_.begin(), watch_.end());
    }
    const std::optional<io::Alarm> alarm = io::ground_alarm(newest);
    return alarm ? alarm->what : "";
}

OdometryState Session::odometry() const {
    const std::lock_guard hold(lock_);
    return odometry_;
}

std::vector<std::string> Session::pop_notices() {
    const std::lock_guard hold(lock_);
    return std::exchange(notices_, {});
}

}  // namespace dynamic_filter::live
