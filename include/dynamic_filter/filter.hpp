// SPDX-License-Identifier: MIT
/// @file
/// The filter of the default preset, scan by scan, and its results: verdicts on scans, static
/// voxels, the evidence behind them, and what a filter holds, for reports.
///
/// - Units: [m], [s], counts, probabilities 0..1.
/// - Frames: points in the sensor frame, poses T_world_sensor, maps in the world frame.
/// - Shapes: verdicts are parallel to the points of their scan; one Throughput per main stage.
/// - Ownership: scans are moved in and not kept; results belong to the caller.
/// - Threads: single caller; const members may run in several threads while no other member runs.
///   Results are plain data.
/// - Errors: ConfigError from the constructor; Error from push() after finish(), and for a scan
///   without a pose; std::bad_alloc, after which the filter can only be destroyed or assigned to.
///   Whether poses make sense is not checked here; OnlineFilter checks it. Before finish(),
///   verdict() returns all unknown and static_map() is empty.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "dynamic_filter/motion.hpp"
#include "dynamic_filter/range_image.hpp"
#include "dynamic_filter/settings.hpp"
#include "dynamic_filter/stage_times.hpp"
#include "dynamic_filter/types.hpp"

namespace dynamic_filter {

/// How many items a stage has processed.
struct Throughput {
    std::string stage;      ///< name of the stage, as in StageTimes
    std::string item;       ///< what the stage processes: "scans" or "submaps"
    std::size_t count = 0;  ///< number of items
};

/// Contents of a filter.
struct MapContents {
    std::string observer;       ///< kind of the observers: "keyframes" or "submaps"
    std::size_t observers = 0;  ///< how many have observed, or are in the buffer
    std::size_t voxels = 0;     ///< number of voxels of the map
    /// Angles between the beams of the sensor; empty: not measured yet.
    std::optional<BeamPattern> beams;
    /// Scan::index of the keyframes that VoxelHistory::free_keyframes can name.
    std::vector<std::size_t> keyframes;
    std::vector<Throughput> throughput;  ///< one entry per main stage, in processing order

    /// Adds the contents of another map of the same method.
    void add(const MapContents& other);
};

/// The verdict on one scan. An *instant* verdict uses the evidence up to this scan; a *settled* one
/// also uses a given number of later scans; the *final* one uses the whole recording.
struct Verdict {
    std::size_t index = 0;  ///< Scan::index
    Labels labels;          ///< one per point
    /// One per point: probability 0..1 that its voxel is occupied, or 0 where the label is unknown.
    /// A point that stands on a static surface may be dynamic although its voxel is probably
    /// occupied. In instant verdicts: in steps of 1/255, as of the moment when the label of the
    /// voxel was decided; empty with the methods "submaps" and "removert".
    std::vector<float> probability;
    /// Only in final verdicts with `map.time` = latest, otherwise empty: true for dynamic points
    /// that were still in their place when the place was last seen.
    std::vector<bool> stays{};
    /// Only in instant verdicts, and only if the filter estimated or refined the pose: the pose and
    /// the motion of the sensor. The world frame is then the sensor frame of the first scan, or the
    /// frame of the given poses.
    std::optional<Tracked> tracked{};
};

/// A verdict with all points unknown and all probabilities 0.
inline Verdict unknown_verdict(const Scan& scan) {
    return {scan.index, Labels(scan.points.size(), Label::unknown),
            std::vector<float>(scan.points.size(), 0.0F)};
}

/// A voxel of a static map.
struct StaticVoxel {
    Eigen::Vector3d center = Eigen::Vector3d::Zero();  ///< [m] world frame
    float probability = 0.0F;                          ///< occupancy 0..1
    std::uint32_t voxel = 0;  ///< its number, as DynamicFilter::voxels_of() gives it
};

/// The observations of a voxel, to explain the verdict on a point in it. With the method "submaps",
/// only the probability is known; all other values are zero.
struct VoxelHistory {
    std::optional<float> probability;  ///< 0..1 of being occupied; empty: unknown
    std::uint32_t n_own = 0;           ///< scans with a point in it
    /// Keyframes that saw the voxel occupied. After 16 in a row that saw the same, every fourth is
    /// asked and stands for four.
    std::uint32_t n_occ = 0;
    std::uint32_t n_free = 0;    ///< keyframes that saw through the voxel, likewise
    std::uint32_t n_switch = 0;  ///< changes between occupied and free, in order of time
    /// The count n_free in units of sure observations; a weak observation counts an eighth.
    float free = 0.0F;
    /// Value of `free` expected of a static voxel with these counts, in units of sure observations.
    float expected_free = 0.0F;
    float score = 0.0F;     ///< in units of DynamicScore; above 0 something came or went
    std::size_t first = 0;  ///< Scan::index of the first scan with a point in the voxel
    std::size_t last = 0;   ///< Scan::index of the last scan with a point in the voxel
    /// Of a dynamic voxel: Scan::index of keyframes that saw through it, ascending. At most 64
    /// keyframes are checked for this list.
    std::vector<std::size_t> free_keyframes;
};

/// A part of the world to which a filter is limited, so that a large area can be filtered piece by
/// piece. Points outside of it stay unknown, but their beams still show what is free inside.
struct Region {
    /// Origin of the map frame [m, world frame], a multiple of the voxel size along each axis.
    Eigen::Vector3d origin = Eigen::Vector3d::Zero();
    /// [m] x and y relative to the origin, multiples of 4 voxels; any height.
    Eigen::AlignedBox2d bounds;
};

/// Removes moving objects from the scans of one trajectory with known poses. Usage: push() every
/// scan, call finish(), then call verdict() for any scan. OnlineFilter does more: it finds poses,
/// notices where poses or stamps do not go on, runs beside a sensor, and knows the other presets.
///
/// Single caller; const members may run in several threads while no other member runs. The same
/// scans and settings give bit-identical results for any number of threads. Scans are not kept.
/// Memory: about 92 bytes per voxel, 28 more after finish(), and six bytes per pixel of each of the
/// newest `scans.max_keyframes` keyframes.
class DynamicFilter {
public:
    /// Throws ConfigError if a setting is wrong, or if the preset is not `default`.
    explicit DynamicFilter(const Config& config);
    /// The same for a part of the world.
    DynamicFilter(const Config& config, const Region& region);
    /// The moved-from filter can only be destroyed or assigned to.
    DynamicFilter(DynamicFilter&&) noexcept;
    DynamicFilter& operator=(DynamicFilter&&) noexcept;  ///< see the move constructor
    ~DynamicFilter();

    /// Call it between two drives through the same world. The next scan may be of another sensor,
    /// and its stamp may be of any time. What one drive saw and a later one saw through is dynamic.
    void begin_drive();
    /// Lets a scan of an earlier drive (counted from 0) observe what only later drives found, so
    /// that what came is dynamic, too. Call it after the last push() and before finish(), for the
    /// scans of each drive but the last in their order.
    void look_again(std::size_t drive, Scan scan);
    /// Which of the scans of an earlier drive, in their order, look_again() uses: the others need
    /// not be read. Of these scans, poses, stamps and sensors matter.
    [[nodiscard]] std::vector<bool> are_to_look_again(std::span<const Scan> scans) const;

    /// What is known of the world after the drives so far, as some 75 bytes a voxel. Another filter
    /// with the same settings and region that takes them goes on with begin_drive() as if it had
    /// seen these drives itself: all results are the same. Call it after the last push(), and
    /// before look_again() and finish(). Only a library of the same version can read the bytes.
    [[nodiscard]] std::vector<std::byte> evidence() const;
    /// Takes the evidence of another filter, before the first push(). Throws Error if it is
    /// damaged.
    void go_on_from(std::span<const std::byte> evidence);

    /// Takes a scan with points in the sensor frame, and returns the instant verdict on it. Stamps
    /// must not decrease within a drive.
    Verdict push(Scan scan);
    /// The first half of push(): returns the verdict.
    Verdict judge(Scan scan);
    /// The second half: the work that can wait until the verdict is delivered. Call it before the
    /// next scan is judged.
    void catch_up();

    /// Decides every voxel. A second call does nothing.
    void finish();

    /// The final verdict on a scan that was pushed, after finish(). Points that are not measured,
    /// or that are too far away for a voxel key, are unknown. Here and below, throws Error if the
    /// scan has no pose.
    [[nodiscard]] Verdict verdict(const Scan& scan) const;
    /// The same, and the voxel of each point, as voxels_of() gives it.
    [[nodiscard]] Verdict verdict(const Scan& scan, std::vector<std::uint32_t>& voxels) const;

    /// The verdict on a scan from the evidence so far. Only the final verdict separates points that
    /// stand on a static surface from that surface.
    [[nodiscard]] Verdict settled(const Scan& scan) const;

    /// The voxel of each point of a scan; UINT32_MAX: no voxel.
    [[nodiscard]] std::vector<std::uint32_t> voxels_of(const Scan& scan) const;
    /// The history of each of the voxels, after finish(). Voxels that were seen through at least
    /// once cost as much time as it took to observe them.
    [[nodiscard]] std::vector<VoxelHistory> histories(std::span<const std::uint32_t> voxels) const;

    /// Removes the map beyond `radius` [m] of a pose. Then removes its farthest parts until size()
    /// is about `most`. Voxels are removed in blocks of 4 x 4 x 4. Removed places are unknown.
    void keep_within(const Pose& T_world_center, double radius, std::size_t most);
    /// Number of voxels of the map.
    [[nodiscard]] std::size_t size() const;

    /// The static voxels within `radius` [m] of any pose (Sec. III-C), from the scans so far. The
    /// default radius is `map.search_radius`.
    [[nodiscard]] std::vector<StaticVoxel> local_static_map(
        const Pose& T_world_query, std::optional<double> radius = {}) const;

    /// The merged map, after finish() (Sec. III-D): all static voxels.
    [[nodiscard]] std::vector<StaticVoxel> static_map() const;

    [[nodiscard]] StageTimes times() const;      ///< [s] time of each stage so far
    [[nodiscard]] MapContents contents() const;  ///< sizes and counts so far

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace dynamic_filter
