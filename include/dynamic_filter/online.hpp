// SPDX-License-Identifier: MIT
/// @file
/// The pipeline for use beside a running sensor. Scans can come at any time; verdicts are never
/// delayed by more than a short queue of scans.
///
/// - Units: [m], [s], [bytes].
/// - Frames: points in the sensor frame, poses T_world_sensor, maps in the world frame.
/// - Shapes: verdicts are parallel to the points of their scan.
/// - Ownership: scans are moved in. The filter keeps them while they wait, and until they are
///   settled. Callbacks are copied; their arguments are valid only during the call.
/// - Threads: any thread may call; OnlineFilter says which functions may run at the same time.
/// - Errors: ConfigError from the constructor (std::system_error if no thread can be started);
///   Error from push() and ask() after finish(). If a stage or a callback throws, the filter stops
///   judging, and every later push(), ask(), flush() and finish() rethrows that exception.
#pragma once

#include <concepts>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

#include "dynamic_filter/filter.hpp"
#include "dynamic_filter/parallel.hpp"
#include "dynamic_filter/settings.hpp"

namespace dynamic_filter {

/// What the filter does with a new scan while `OnlineOptions::queue` scans already wait.
enum class Overload {
    drop_oldest,  ///< drops the waiting scan with the oldest stamp, so that verdicts are recent
    wait          ///< makes the caller of push() wait, so that no scan is lost
};

/// Limits on the delay and on the memory of an OnlineFilter.
struct OnlineOptions {
    /// Number of scans that may wait besides the one being judged; at least 1.
    std::size_t queue = 2;
    Overload overload = Overload::drop_oldest;  ///< what happens when the queue is full
    double horizon = 200.0;  ///< [m] the map farther away than this is removed; 0: no limit
    /// [bytes] Limit on the memory of the map, counted as 172 bytes per voxel (method "submaps":
    /// per point of the submaps). Above it, the farthest parts are removed until three quarters of
    /// the limit are used. The map is copied to do so, which needs more memory for a moment. 0: no
    /// limit.
    std::size_t max_bytes = std::size_t{2} << 30;
    /// Method "scans": a scan is settled after this number of later scans, or earlier at a break of
    /// the trajectory or at finish(). The filter keeps the scan until then. 0: scans are not
    /// settled.
    std::size_t settle_after = 0;
    int threads = 0;  ///< threads for the computations; 0: all cores
};

/// @cond For settings/table.hpp, as visit(Config).
/// Calls f(setting, member) for every number of the options.
template <class C, class F>
requires std::same_as<std::remove_const_t<C>, OnlineOptions>
void visit(C& options, F&& f) {
    constexpr double kAny = std::numeric_limits<double>::infinity();
    f(Setting{"queue", "1", "", "number of scans that may wait", 1, kAny}, options.queue);
    f(Setting{"horizon", "m", "", "the map farther away than this is removed; 0: no limit", 0,
              kAny},
      options.horizon);
    f(Setting{"max_bytes", "B", "", "limit on the memory of the map; 0: no limit", 0, kAny},
      options.max_bytes);
    f(Setting{"settle_after", "1", "",
              "a scan is settled after this number of later scans; 0: none", 0, kAny},
      options.settle_after);
    f(Setting{"threads", "1", "", "threads for the computations; 0: all cores", 0, kMostThreads},
      options.threads);
}
/// @endcond

/// Returns one sentence for each number that is out of bounds.
std::vector<std::string> violations(const OnlineOptions& options);

/// Kind of an event that the log of a robot should record. With every kind except `jump` and
/// `restart`, the scan gets no verdict.
enum class NoticeKind {
    dropped,    ///< the queue was full
    late,       ///< the stamp is older than that of a scan already judged
    duplicate,  ///< stamp and pose are those of the previous scan, or of a waiting one
    /// The stamp or the pose is not finite, the pose is not rigid (to 1e-3), only some of the scans
    /// have a pose, or the number of times is not that of the points.
    invalid,
    /// The pose jumped, or the odometry lost its way. A new map begins, which does not use the
    /// evidence of the previous one.
    jump,
    restart  ///< the stamps went back by more than 1 s: a new map begins
};

/// A message about a scan for the log.
struct Notice {
    NoticeKind kind = NoticeKind::dropped;  ///< what happened
    std::size_t index = 0;                  ///< Scan::index
    std::string text;                       ///< one sentence
};

/// Callbacks of an OnlineFilter. Verdicts come from threads of the filter (the last ones from the
/// caller of finish()); notices may also come from the caller of push(). Calls of the same callback
/// never overlap.
///
/// Callbacks should return quickly, because the next scan waits for them. A callback may call
/// counters(), but no other member of the filter: members that would wait for the filter (flush(),
/// ask(), finish()) throw Error. If a callback throws, the filter stops. There is one exception: if
/// `notice` throws because of a scan that is dropped or refused, the exception comes out of the
/// push() that reported it, and the filter goes on.
struct OnlineCallbacks {
    /// Instant verdict on every judged scan, in order.
    std::function<void(const Verdict&)> instant;
    /// Settled verdicts, see OnlineOptions::settle_after.
    std::function<void(const Verdict&)> settled;
    std::function<void(const Notice&)> notice;  ///< messages for the log
};

/// Numbers of scans. At any time, in = processed + dropped + rejected + queued. A scan counts as
/// queued until its verdict is delivered. A scan that could not be judged because a stage failed
/// counts as rejected.
struct Counters {
    std::uint64_t in = 0;  ///< pushed
    /// Judged; the integration into the map may still run, see flush().
    std::uint64_t processed = 0;
    std::uint64_t dropped = 0;   ///< because the queue was full
    std::uint64_t rejected = 0;  ///< late, duplicate or invalid
    std::uint64_t queued = 0;    ///< waiting, or being judged
};

/// Runs the filter in a thread of its own, in addition to the threads of parallel_for: it judges
/// scan after scan, and integrates each one into the map after its verdict is delivered. With the
/// preset `paper` a second thread runs the back-end beside the front-end (Fig. 2). Waiting scans
/// are ordered by their stamps. One filter serves one sensor trajectory; indices of scans must
/// increase.
///
/// Threads: push(), ask(), flush(), finish(), counters(), settled() and local_static_map() may be
/// called from any thread at any time. All other members may be called after flush() (or after
/// finish(), where they say so) while no scan is pushed. The destructor drops waiting scans and
/// integrates the judged ones, but it does not call finish().
///
/// A break of the trajectory (NoticeKind::jump or restart) begins a new map. With a horizon, the
/// previous maps are then removed: all points of their scans are unknown, also after finish(). With
/// a horizon of 0, the previous maps are kept.
///
/// The verdicts are byte-identical to those of DynamicFilter on the same scans if stamps are in
/// order, the trajectory has no break, and nothing is dropped or removed. Points farther than 105
/// km from the start of a map (with voxels of 0.2 m) are unknown: create a new filter before that
/// distance.
class OnlineFilter {
public:
    /// Throws ConfigError if a setting or an option is wrong.
    explicit OnlineFilter(const Config& config, OnlineOptions options = {},
                          OnlineCallbacks callbacks = {});
    ~OnlineFilter();
    OnlineFilter(const OnlineFilter&) = delete;
    OnlineFilter& operator=(const OnlineFilter&) = delete;

    /// Adds a scan to the queue. Returns at once; with `Overload::wait`, returns as soon as the
    /// queue has room.
    void push(Scan scan);

    /// Does push(), then waits for the instant verdict on the scan. Empty if the scan is dropped or
    /// rejected, and always with the method "submaps", whose verdicts come to the callback when a
    /// window closes.
    std::optional<Verdict> ask(Scan scan);

    /// The next scan that is pushed begins a new map, as after stamps that went back: nothing that
    /// was seen before is held against it, and with a horizon it is forgotten. Own odometry begins
    /// anew as well.
    void begin_anew();

    /// Waits until all pushed scans, of any thread, are judged and integrated.
    void flush();

    /// Does flush(), settles the remaining scans, and decides every voxel. No scan can be pushed
    /// after it.
    void finish();

    /// After finish(): the final verdict on a scan that was pushed; its index must be the same as
    /// then. If the filter found or refined its pose, give the scan the pose of its instant verdict
    /// (Verdict::tracked). Here and below, throws Error if the scan has no pose. All points are
    /// unknown if the part of the map that the scan saw was removed because of the horizon or of a
    /// break of the trajectory.
    [[nodiscard]] Verdict verdict(const Scan& scan) const;

    /// The verdict on a pushed scan from the evidence so far, for the method "scans" only. Waits
    /// until the running stage has ended; the next stage waits for this call.
    [[nodiscard]] Verdict settled(const Scan& scan) const;
    /// True for the preset `default`: every scan is judged at once, and settled() gives verdicts.
    /// `paper` and `removert` judge window by window.
    [[nodiscard]] bool judges_each_scan() const;

    /// After finish(), to explain verdicts: for each point of a pushed scan, an identifier of its
    /// voxel (kNoPlace: no voxel). histories() takes these identifiers.
    [[nodiscard]] std::vector<std::uint64_t> places_of(const Scan& scan) const;
    static constexpr std::uint64_t kNoPlace = UINT64_MAX;  ///< see places_of()
    /// Histories of voxels, parallel to `places`; see DynamicFilter::histories().
    [[nodiscard]] std::vector<VoxelHistory> histories(std::span<const std::uint64_t> places) const;

    [[nodiscard]] Counters counters() const;  ///< a consistent snapshot, at any time
    /// The static voxels of the newest map within `radius` [m] of a pose, from the evidence so far;
    /// see DynamicFilter::local_static_map(). Waits until the running stage has ended; the next
    /// stage waits for this call.
    [[nodiscard]] std::vector<StaticVoxel> local_static_map(const Pose& T_world_query,
                                                            std::optional<double> radius = {});

    /// After finish(): the merged map (Sec. III-D), that is the static voxels of all maps that are
    /// kept. Where maps overlap, a place appears once per map.
    [[nodiscard]] std::vector<StaticVoxel> static_map() const;

    /// Times of the stages, after flush(). The entry `latency` is the time from push() to the end
    /// of judging.
    [[nodiscard]] StageTimes times() const;
    /// Number of maps that are kept: one, plus one per break of the trajectory. Call it after
    /// flush().
    [[nodiscard]] std::size_t maps() const;
    /// Contents of all maps together. Call it after flush().
    [[nodiscard]] MapContents contents() const;

private:
    struct Engine;
    std::unique_ptr<Engine> engine_;
};

}  // namespace dynamic_filter
