// SPDX-License-Identifier: MIT
/// Makes scans with poses of the messages that a bus delivers.
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "dynamic_filter/cloud.hpp"
#include "dynamic_filter/types.hpp"
#include "live/bus.hpp"
#include "live/live_config.hpp"
#include "recording/frame_tree.hpp"
#include "recording/pose_source.hpp"

namespace dynamic_filter::live {

using SteadyTime = std::chrono::steady_clock::time_point;

/// A cloud, and all that the filter needs of it.
struct LiveScan {
    io::Cloud cloud;            ///< as it came, without padding
    Points points;              ///< [m] in the sensor frame
    std::vector<float> times;   ///< see Scan::times
    std::string frame;          ///< of the cloud
    std::string world;          ///< frame of the pose; empty without a pose
    double stamp = 0.0;         ///< [s]
    std::int64_t stamp_ns = 0;  ///< [ns] the same, exactly
    bool has_pose = false;
    Pose T_world_sensor = Pose::Identity();
    /// If motion is undone by the given poses: the poses during the scan, as they were published.
    io::Trajectory trajectory;
    /// Without a pose: the root of /tf above the sensor, and the sensor's pose in it, if known.
    std::string root;
    std::optional<Pose> T_root_sensor;
    std::vector<std::uint8_t> own;  ///< see FullScan::own
    SteadyTime arrived;             ///< when the bus delivered the cloud
    std::size_t sensor = 0;         ///< see Scan::sensor
};

/// Numbers of clouds; received = taken + malformed + without_pose + overrun + those that wait.
struct IntakeCounters {
    std::uint64_t received = 0;
    std::uint64_t taken = 0;            ///< given to the filter
    std::uint64_t malformed = 0;        ///< not readable, or without a point
    std::uint64_t without_pose = 0;     ///< no pose for their time came in time
    std::uint64_t overrun = 0;          ///< too many clouds waited
    std::uint64_t other_malformed = 0;  ///< messages with poses that are not readable
    std::uint64_t other_overrun = 0;    ///< messages with poses that were not read in time
};

/// Where poses come from.
enum class PoseOrigin { undecided, frames, topic, odometry };

/// put() may be called from any thread; all other members have a single caller.
class Intake {
public:
    explicit Intake(const LiveConfig& config);

    /// Takes a message: a cloud, poses, or transforms (of /tf_static: `is_static`), by its type.
    void put(const io::Topic& topic, bool is_static, const Bytes& message);

    /// The next scan, in the order of arrival; waits for at most `wait` [s].
    std::optional<LiveScan> pop(double wait);

    [[nodiscard]] IntakeCounters counters() const;
    [[nodiscard]] PoseOrigin origin() const { return origin_; }
    /// What the user should know of, a sentence each, since the last call.
    std::vector<std::string> pop_notices();
    /// Where poses come from, and if they are missing why, as a sentence.
    [[nodiscard]] std::string poses_text() const;
    /// Why the last scan without a pose had none.
    [[nodiscard]] const std::string& last_missing() const { return last_missing_; }
    /// [s] since the last cloud was received; empty before the first.
    [[nodiscard]] std::optional<double> silence() const;

private:
    struct Arrived {
        io::Topic topic;
        bool is_static = false;
        Bytes message;
        SteadyTime at;
    };
    void drop_clouds(SteadyTime now);
    void read_poses();
    void read_pose_message(const Arrived& arrived);
    void add_transforms(const std::vector<io::PoseMessage>& transforms, bool is_static);
    void note_clock(double stamp, double& newest, const std::string& of);
    void forget_old_poses();
    std::optional<LiveScan> read_cloud();
    [[nodiscard]] bool must_wait_for_pose(const LiveScan& scan, SteadyTime now) const;
    bool give_pose(LiveScan& scan);
    void decide(const LiveScan& scan);
    [[nodiscard]] std::optional<io::PoseSource> source_for(const std::string& frame) const;
    [[nodiscard]] std::optional<double> newest_pose(const std::string& frame) const;
    [[nodiscard]] std::string why_no_pose(const std::string& frame, double stamp) const;
    void note_world(const std::string& world, const std::string& why);
    void tell(std::string text);

    const LiveConfig& config_;
    const std::vector<std::string> cloud_topics_;  // several: by sensor

    mutable std::mutex lock_;  // guards the members below
    std::condition_variable came_;
    std::deque<Arrived> clouds_, poses_;
    IntakeCounters counters_;
    std::optional<SteadyTime> last_cloud_;

    // Members of the caller of pop().
    io::FrameTree frames_;
    std::map<std::string, io::PoseTopic> topics_;  // keys: names
    std::map<std::string, double> newest_stamps_;  // [s], of frames, topics and clouds
    std::optional<LiveScan> waiting_;              // read, but without a pose yet
    PoseOrigin origin_ = PoseOrigin::undecided;
    std::string pose_topic_, world_, last_frame_, missing_, last_missing_, last_told_;
    double last_stamp_ = 0.0;
    std::optional<SteadyTime> first_cloud_;
    std::vector<std::string> notices_;
};

}  // namespace dynamic_filter::live
