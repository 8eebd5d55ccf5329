// SPDX-License-Identifier: MIT
/// What the live filter publishes.
#pragma once

#include <atomic>
#include <cstdint>
#include <deque>
#include <string>
#include <vector>

#include "dynamic_filter/bag.hpp"
#include "dynamic_filter/filter.hpp"
#include "live/intake.hpp"

namespace dynamic_filter::live {

/// A topic that is published, for `--dry-run` and the guide.
struct Output {
    io::Topic topic;
    Quality quality;
};

/// The topics, by what they are for.
struct OutputTopics {
    Output still, dynamic, labels, corrections, map, grid, removed, path, diagnostics, transform;
    explicit OutputTopics(const LiveConfig& config, io::MessageEncoding encoding);
    [[nodiscard]] std::vector<Output> all() const;
};

/// What is kept of a judged scan until it is settled.
struct JudgedScan {
    std::string frame;
    std::int64_t stamp_ns = 0;
    Points points;  ///< as in the cloud
    Labels labels;
};

/// Makes the messages that somebody wants, and gives them to all publishers. Its functions may run
/// in different threads at the same time, but each function has a single caller.
class Outputs {
public:
    /// Announces the topics. `display` (may be null) also gets the pose of the sensor, because it
    /// hears of nothing else. Both publishers must outlive this object.
    Outputs(const LiveConfig& config, io::MessageEncoding encoding, Publisher& bus,
            Publisher* display = nullptr);

    /// Static and dynamic points with their fields, labels, boxes around dynamic points, the path
    /// so far, and the transform of the world frame if the poses are the filter's own. Returns what
    /// is needed to publish corrections.
    JudgedScan judged(const LiveScan& scan, const Verdict& verdict);
    /// The points of an earlier scan whose labels have changed.
    void settled(const JudgedScan& scan, const Verdict& verdict);
    void map(const std::vector<StaticVoxel>& voxels, const std::string& world, double stamp);
    void grid(const io::OccupancyCells& cells, const std::string& world, double stamp);
    void diagnostics(const std::vector<io::DiagnosticStatus>& statuses, double stamp);

    [[nodiscard]] bool wants_map() const { return is_wanted(topics_.map); }
    [[nodiscard]] bool wants_grid() const { return is_wanted(topics_.grid); }
    [[nodiscard]] bool wants_corrections() const { return is_wanted(topics_.corrections); }
    /// Number of messages that were not taken, because a receiver is too slow.
    [[nodiscard]] std::uint64_t not_taken() const { return not_taken_; }

private:
    [[nodiscard]] bool is_wanted(const Output& output) const;
    void publish(const Output& output, double stamp, std::vector<std::byte> message);
    void publish_part(const Output& output, const LiveScan& scan, const Labels& labels,
                      bool dynamic);
    void publish_removed(double stamp, const Points& points, const Labels& labels,
                         const Pose& T_world_points, const std::string& world);
    void publish_path(double stamp, const Pose& T_world_sensor, const std::string& world);
    void publish_transform(const LiveScan& scan, const Pose& T_map_sensor);
    void display_pose(const LiveScan& scan, const Pose& T_world_sensor, const std::string& world);

    const LiveConfig& config_;
    io::MessageEncoding encoding_;
    OutputTopics topics_;
    Publisher& bus_;
    Publisher* display_;
    std::deque<double> path_stamps_;
    std::deque<Pose> path_;
    std::string path_world_;
    double path_told_ = 0.0;  // [s]
    std::atomic<std::uint64_t> not_taken_{0};
};

/// Boxes in the world frame around the dynamic points: points in cells of 0.5 m that touch are one
/// box, and fewer than 5 points are none. At most 200 boxes, those with most points.
std::vector<io::BoxMarker> boxes_around(const Points& points, const Labels& labels,
                                        const Pose& T_world_sensor);

}  // namespace dynamic_filter::live
