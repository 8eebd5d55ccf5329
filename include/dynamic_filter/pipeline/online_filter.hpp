// SPDX-License-Identifier: MIT
/// @file
/// The pipeline beside a running sensor: scans in at any time, verdicts out, never more behind than
/// a short queue.
///
/// - Units: [m], [s], [bytes].
/// - Frames: points in the sensor's, poses T_world_sensor, maps in the world's.
/// - Shapes: verdicts are parallel to the points of their scan.
/// - Ownership: scans are moved in, and kept while they wait, and until they are settled; callbacks
///   are copied, and what they are given is valid for the call.
/// - Threads: any may call, see OnlineFilter.
/// - Errors: ConfigError from the constructor (std::system_error if no thread can be started); what
///   a stage or a callback throws comes out of every later push(), ask(), flush() and finish(); the
///   filter judges no more then. Error from push() and ask() after finish().
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "dynamic_filter/pipeline/dynamic_filter.hpp"

namespace dynamic_filter {

/// What happens to a scan that comes while `OnlineOptions::queue` others wait.
enum class Overload {
    drop_oldest,  ///< the scan with the oldest stamp is dropped: what comes out is never old
    wait          ///< the caller waits: nothing is lost
};

/// How an OnlineFilter keeps up, and how much it keeps.
struct OnlineOptions {
    std::size_t queue = 2;  ///< scans that may wait, besides the one being judged; at least 1
    Overload overload = Overload::drop_oldest;  ///< what a full queue does
    double horizon = 200.0;                     ///< [m] the map is forgotten beyond it; 0: no bound
    /// [bytes] Where the map's voxels (submaps: their points) need more, at 160 bytes each, the
    /// farthest are forgotten until they need three quarters of it. To forget, the map is copied,
    /// so for a moment there is more. 0: no bound.
    std::size_t max_bytes = std::size_t{2} << 30;
    /// A scan is settled when so many came after it, or at a break of the trajectory or finish(),
    /// where scans observe. It is kept until then. 0: never.
    std::size_t settle_after = 0;
    int threads = 0;  ///< for the work inside; 0: all cores
};

/// Something that a robot's log should hold. All but `jump` and `restart` cost the scan.
enum class NoticeKind {
    dropped,    ///< overload
    late,       ///< its stamp is before that of a scan already judged
    duplicate,  ///< stamp and pose of the scan before, or of one that waits
    invalid,    ///< stamp or pose is not finite, the pose is not rigid (to 1e-3), it is missing
              ///< though other scans have one (or the other way round), or times do not fit points
    jump,    ///< the pose jumped, or the odometry lost its way: a new map begins, which knows
             ///< nothing of the one before
    restart  ///< stamps went back by more than a second: a new map begins
};

/// What the log should say of a scan.
struct Notice {
    NoticeKind kind = NoticeKind::dropped;  ///< what happened
    std::size_t index = 0;                  ///< Scan::index
    std::string text;                       ///< one sentence
};

/// Verdicts come from the filter's threads (the last ones from the caller of finish()), notices
/// also from the caller of push(); one call of each kind at a time. They should be quick, because
/// the next scan waits for them, and must call nothing of the filter but counters();
/// what would wait for the filter (flush(), ask(), finish()) throws Error. What they
/// throw stops the filter; but what `notice` throws on a scan that is dropped or refused comes out
/// of the push() that told it, and the filter goes on.
struct OnlineCallbacks {
    std::function<void(const Verdict&)> instant;  ///< of every scan judged, in order
    std::function<void(const Verdict&)> settled;  ///< corrections, see `settle_after`
    std::function<void(const Notice&)> notice;    ///< for the robot's log
};

/// in = processed + dropped + rejected + queued, whenever asked. Until its verdict is delivered, a
/// scan is queued. One that could not be judged because a stage failed counts as rejected.
struct Counters {
    std::uint64_t in = 0;         ///< pushed
    std::uint64_t processed = 0;  ///< judged; its integration may still be under way, see flush()
    std::uint64_t dropped = 0;    ///< by overload
    std::uint64_t rejected = 0;   ///< late, duplicate or invalid
    std::uint64_t queued = 0;     ///< waiting, or being judged
};

/// Two threads of its own, and those of the work inside: the first judges scan after scan, the
/// second integrates beside the caller, and beside the first where submaps observe. Scans
/// that wait are put in the order of their stamps. One filter serves one vehicle; indices of scans
/// must grow. push(), ask(), flush(), finish(), counters(), settled() and local_static_map() may
/// be called from any thread at any time; the others while nothing is pushed, after flush() or, if
/// they say so, after finish(). The destructor drops what waits, lets what was judged be
/// integrated, and does not finish().
///
/// A break of the trajectory (jump, restart) begins a new map. With a horizon, the maps before it
/// are forgotten as a whole: of their scans all is unknown, also after finish(). With a horizon of
/// 0 they are kept.
///
/// Where stamps are in order, the trajectory has no break, and nothing is dropped or forgotten,
/// verdicts are those of DynamicFilter on the same scans, to the byte. Points more than 105 km (at
/// voxels of 0.2 m) from where a map began end as unknown: make another filter in time.
class OnlineFilter {
public:
    /// Throws ConfigError.
    explicit OnlineFilter(const Config& config, OnlineOptions options = {},
                          OnlineCallbacks callbacks = {});
    ~OnlineFilter();
    OnlineFilter(const OnlineFilter&) = delete;
    OnlineFilter& operator=(const OnlineFilter&) = delete;

    /// Hands over a scan and returns, at once or, with `Overload::wait`, when there is room.
    void push(Scan scan);

    /// push(), and waits for the scan's instant verdict. Empty: dropped or rejected, or submaps
    /// observe: a window's verdicts come to the callback when it closes.
    std::optional<Verdict> ask(Scan scan);

    /// Waits until all that was pushed is judged and integrated, by this thread or another.
    void flush();

    /// flush(), settles what is not, and decides every voxel. Nothing can be pushed after it.
    void finish();

    /// After finish(): the final verdict on a scan that was pushed, with the index it had. Where
    /// the horizon or a break of the trajectory made forget what it saw: unknown.
    [[nodiscard]] Verdict verdict(const Scan& scan) const;

    /// The verdict on a scan that was pushed from the evidence so far. Only where scans observe.
    /// Waits for the stage in work, and the next one waits for it.
    [[nodiscard]] Verdict settled(const Scan& scan) const;
    /// See DynamicFilter::judges_each_scan().
    [[nodiscard]] bool judges_each_scan() const;

    /// After finish(), to explain verdicts: a number for the voxel of each point of a scan that was
    /// pushed (kNoPlace: none), and what DynamicFilter knows of such voxels.
    [[nodiscard]] std::vector<std::uint64_t> places_of(const Scan& scan) const;
    static constexpr std::uint64_t kNoPlace = UINT64_MAX;  ///< see places_of()
    /// Parallel to `places`; see DynamicFilter::histories().
    [[nodiscard]] std::vector<VoxelHistory> histories(std::span<const std::uint64_t> places) const;

    [[nodiscard]] Counters counters() const;  ///< consistent, whenever asked
    /// The static voxels of the newest map within `radius` [m] of a pose
    /// (DynamicFilter::local_static_map), as of now. Waits for the stage in work, and the next one
    /// waits for it.
    [[nodiscard]] std::vector<StaticVoxel> local_static_map(const Pose& T_world_query,
                                                            std::optional<double> radius = {});

    /// The merged map, after finish() (Sec. III-D): the static voxels of all maps that are kept;
    /// where maps overlap, a place comes once from each.
    [[nodiscard]] std::vector<StaticVoxel> static_map() const;

    /// How the stages did, once flush() has returned; `latency`: from push() to the end of judging.
    [[nodiscard]] StageTimes times() const;
    /// How many maps are kept: one, and one per break of the trajectory. Once flush() has returned.
    [[nodiscard]] std::size_t maps() const;
    /// What there is in all maps, once flush() has returned.
    [[nodiscard]] MapContents contents() const;

private:
    struct Engine;
    std::unique_ptr<Engine> engine_;
};

}  // namespace dynamic_filter
