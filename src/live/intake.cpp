// SPDX-License-Identifier: MIT
#include "live/intake.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "dynamic_filter/poses.hpp"
#include "formats/byte_reader.hpp"
#include "formats/messages/messages.hpp"
#include "geometry/no_returns.hpp"
#include "recording/recording_parts.hpp"
#include "tracking/pose_jump.hpp"

namespace dynamic_filter::live {

namespace {

constexpr std::size_t kMostClouds = 20, kMostPoses = 4096;  // that wait to be read
constexpr std::size_t kMostFrames = 1000;                   // of /tf; more are ignored
constexpr double kKept = 10.0;               // [s] poses are kept behind the newest scan
constexpr double kEndOfTime = 2147483647.0;  // [s] what the stamps of all messages can hold

double seconds_between(SteadyTime from, SteadyTime to) {
    return std::chrono::duration<double>(to - from).count();
}

float latest(const std::vector<float>& times) {
    float last = 0.0F;
    for (const float time : times) {
        if (std::isfinite(time)) last = std::max(last, time);
    }
    return last;
}

template <class Map>
std::vector<std::string> keys_of(const Map& map) {
    std::vector<std::string> keys;
    for (const auto& [key, value] : map) keys.push_back(key);
    return keys;
}

}  // namespace

Intake::Intake(const LiveConfig& config) : config_(config), cloud_topics_(cloud_topics(config)) {
    const std::string& pose = config.input.pose;
    if (pose == "none") origin_ = PoseOrigin::odometry;
    if (pose == "/tf") origin_ = PoseOrigin::frames;
    if (pose.empty() || origin_ != PoseOrigin::undecided) return;
    origin_ = PoseOrigin::topic;
    pose_topic_ = pose;
}

void Intake::put(const io::Topic& topic, bool is_static, const Bytes& message) {
    const bool is_cloud = io::holds_scan(io::kind_of(topic.type));
    const auto now = std::chrono::steady_clock::now();
    {
        const std::lock_guard hold(lock_);
        auto& queue = is_cloud ? clouds_ : poses_;
        queue.push_back({topic, is_static, message, now});
        if (is_cloud) {
            ++counters_.received;
            last_cloud_ = now;
            drop_clouds(now);
        } else if (queue.size() > kMostPoses) {
            queue.pop_front();
            ++counters_.other_overrun;
        }
    }
    came_.notify_one();
}

/// Old ones, so that verdicts are recent; but those that may wait for their pose stay.
void Intake::drop_clouds(SteadyTime now) {
    const auto may_go = [&] {
        const bool is_old = seconds_between(clouds_.front().at, now) > config_.input.wait;
        return clouds_.size() > kMostClouds ||
               (is_old && clouds_.size() > static_cast<std::size_t>(config_.input.queue));
    };
    while (may_go()) {
        clouds_.pop_front();
        ++counters_.overrun;
    }
}

std::optional<LiveScan> Intake::pop(double wait) {
    const auto until = std::chrono::steady_clock::now() + std::chrono::duration<double>(wait);
    while (true) {
        read_poses();
        if (!waiting_) waiting_ = read_cloud();
        if (waiting_) decide(*waiting_);
        const auto now = std::chrono::steady_clock::now();
        if (waiting_ && !must_wait_for_pose(*waiting_, now)) {
            std::optional<LiveScan> scan = std::exchange(waiting_, std::nullopt);
            if (give_pose(*scan)) {
                forget_old_poses();
                const std::lock_guard hold(lock_);
                ++counters_.taken;
                return scan;
            }
            continue;
        }
        std::unique_lock hold(lock_);
        if (!poses_.empty() || (!waiting_ && !clouds_.empty())) continue;
        if (now >= until) return std::nullopt;
        auto next = std::chrono::time_point_cast<SteadyTime::duration>(until);
        if (waiting_) {
            const auto overdue =
                waiting_->arrived + std::chrono::duration_cast<SteadyTime::duration>(
                                        std::chrono::duration<double>(config_.input.wait));
            next = std::min(next, std::max(overdue, now + std::chrono::milliseconds(1)));
        }
        came_.wait_until(hold, next);
    }
}

void Intake::read_poses() {
    std::deque<Arrived> arrived;
    {
        const std::lock_guard hold(lock_);
        arrived.swap(poses_);
    }
    if (arrived.empty()) return;
    std::uint64_t malformed = 0;
    for (const Arrived& a : arrived) {
        try {
            read_pose_message(a);
        } catch (const io::Malformed& error) {
            if (malformed++ == 0) {
                tell(fmt::format("a message of {} {}; it is left out", a.topic.name, error.what()));
            }
        }
    }
    frames_.put_in_order();
    for (auto& [name, topic] : topics_) io::put_in_order(topic.trajectory);
    const std::lock_guard hold(lock_);
    counters_.other_malformed += malformed;
}

void Intake::read_pose_message(const Arrived& arrived) {
    const io::Message message{arrived.topic, 0, {}, *arrived.message};
    if (io::kind_of(arrived.topic.type) == io::MessageKind::transforms) {
        return add_transforms(io::read_transforms(message), arrived.is_static);
    }
    io::PoseMessage pose = io::read_pose_message(message);
    if (!pose.T_parent_child.matrix().allFinite() || !std::isfinite(pose.stamp)) return;
    note_clock(pose.stamp, newest_stamps_[arrived.topic.name], arrived.topic.name);
    io::PoseTopic& topic = topics_[arrived.topic.name];
    topic.parent = std::move(pose.parent);
    topic.child = std::move(pose.child);
    topic.trajectory.stamps.push_back(pose.stamp);
    topic.trajectory.poses.push_back(pose.T_parent_child);
}

void Intake::add_transforms(const std::vector<io::PoseMessage>& transforms, bool is_static) {
    for (const io::PoseMessage& transform : transforms) {
        if (!transform.T_parent_child.matrix().allFinite()) continue;
        if (!frames_.knows(transform.child) && frames_.size() >= kMostFrames) continue;
        if (!is_static) {
            note_clock(transform.stamp, newest_stamps_["/tf " + transform.child],
                       "/tf of '" + transform.child + "'");
        }
        frames_.add(transform, is_static);
    }
}

/// Poses of later times do not belong to the scans that follow.
void Intake::note_clock(double stamp, double& newest, const std::string& of) {
    const bool back = stamp < newest - kRestart;
    newest = back ? stamp : std::max(newest, stamp);
    if (!back) return;
    tell(fmt::format("the stamps of {} went back to {:.3f} s, so earlier poses are forgotten", of,
                     stamp));
    frames_.forget_moving();
    for (auto& [name, topic] : topics_) topic.trajectory = {};
    newest_stamps_.clear();  // all others follow
}

void Intake::forget_old_poses() {
    frames_.forget_before(last_stamp_ - kKept);
    for (auto& [name, topic] : topics_) {
        auto& [stamps, poses] = topic.trajectory;
        const auto old =
            std::lower_bound(stamps.begin(), stamps.end(), last_stamp_ - kKept) - stamps.begin();
        stamps.erase(stamps.begin(), stamps.begin() + old);
        poses.erase(poses.begin(), poses.begin() + old);
    }
}

/// Reads the next cloud; one that cannot be used is counted.
std::optional<LiveScan> Intake::read_cloud() {
    Arrived arrived;
    {
        const std::lock_guard hold(lock_);
        if (clouds_.empty()) return std::nullopt;
        arrived = std::move(clouds_.front());
        clouds_.pop_front();
    }
    std::string fault;
    try {
        io::CloudMessage message = io::read_cloud_message(*arrived.message, arrived.topic);
        LiveScan scan;
        scan.cloud = std::move(message.cloud);
        scan.points = io::positions(scan.cloud);
        drop_no_returns(scan.points);
        scan.frame = std::move(message.header.frame);
        scan.stamp = message.header.stamp;
        scan.stamp_ns = message.header.stamp_ns;
        scan.arrived = arrived.at;
        const auto of = std::find(cloud_topics_.begin(), cloud_topics_.end(), arrived.topic.name);
        if (of != cloud_topics_.end()) {
            scan.sensor = static_cast<std::size_t>(of - cloud_topics_.begin());
        }
        if (config_.input.deskew) scan.times = io::point_times(scan.cloud, scan.stamp);
        if (scan.stamp < 0.0 || scan.stamp >= kEndOfTime) {
            throw io::Malformed(
                fmt::format("has the stamp {:.0f} s; expected 0 to 2^31 s", scan.stamp));
        }
        if (std::any_of(scan.points.begin(), scan.points.end(), is_measured)) {
            note_clock(scan.stamp, newest_stamps_["scans"], "the scans");
            if (!first_cloud_) first_cloud_ = arrived.at;
            last_frame_ = scan.frame;
            last_stamp_ = scan.stamp;
            return scan;
        }
        fault = "has no finite point away from the sensor";
    } catch (const io::Malformed& error) {
        fault = error.what();
    }
    tell(fmt::format("a scan of {} {}; it is left out", arrived.topic.name, fault));
    const std::lock_guard hold(lock_);
    ++counters_.malformed;
    return std::nullopt;
}

std::optional<io::PoseSource> Intake::source_for(const std::string& frame) const {
    if (origin_ == PoseOrigin::frames && frames_.moves(frame)) {
        return io::from_frames(frames_, frame, config_.input.world);
    }
    const auto topic = topics_.find(pose_topic_);
    if (origin_ != PoseOrigin::topic || topic == topics_.end()) return std::nullopt;
    if (topic->second.trajectory.stamps.empty()) return std::nullopt;
    return io::from_topic(topic->first, topic->second, frames_, frame);
}

std::optional<double> Intake::newest_pose(const std::string& frame) const {
    if (origin_ == PoseOrigin::frames) return frames_.newest(frame);
    const auto topic = topics_.find(pose_topic_);
    if (topic == topics_.end() || topic->second.trajectory.stamps.empty()) return std::nullopt;
    return topic->second.trajectory.stamps.back();
}

/// Poses are interpolated as in a recording, so the first one after the scan must be there.
bool Intake::must_wait_for_pose(const LiveScan& scan, SteadyTime now) const {
    if (origin_ == PoseOrigin::odometry) return false;
    if (seconds_between(scan.arrived, now) >= config_.input.wait) return false;
    if (origin_ == PoseOrigin::undecided) return true;
    // A single transform does not tell whether it will change.
    if (origin_ == PoseOrigin::frames && !frames_.moves(scan.frame)) return true;
    const auto newest = newest_pose(scan.frame);
    return !newest || *newest < scan.stamp + static_cast<double>(latest(scan.times));
}

/// With an empty `input.pose`: the same choice as that of `run` for a bag.
void Intake::decide(const LiveScan& scan) {
    if (origin_ != PoseOrigin::undecided) return;
    if (frames_.moves(scan.frame)) {
        origin_ = PoseOrigin::frames;
    } else if (!topics_.empty()) {
        origin_ = PoseOrigin::topic;
        pose_topic_ = topics_.begin()->first;
        if (topics_.size() > 1) {
            tell(
                fmt::format("poses are on several topics ({}); {} is used, and input.pose chooses "
                            "another",
                            fmt::join(keys_of(topics_), ", "), pose_topic_));
        }
    } else if (cloud_topics_.size() < 2 &&
               seconds_between(*first_cloud_, std::chrono::steady_clock::now()) >=
                   config_.input.decide) {
        origin_ = PoseOrigin::odometry;
        tell(fmt::format("no poses came for {:.0f} s, so they are found by odometry from now on",
                         config_.input.decide));
    }
}

/// False if the scan has no pose and needs one.
bool Intake::give_pose(LiveScan& scan) {
    if (origin_ == PoseOrigin::odometry) {
        scan.root = frames_.above(scan.frame).back();
        scan.T_root_sensor = frames_.pose(scan.frame, scan.root, scan.stamp);
        return true;
    }
    const auto source = source_for(scan.frame);
    const auto pose = source ? source->T_world_sensor(scan.stamp) : std::nullopt;
    if (!pose || !pose->matrix().allFinite() || io::is_absurdly_far(*pose)) {
        missing_ = last_missing_ = why_no_pose(scan.frame, scan.stamp);
        const std::lock_guard hold(lock_);
        ++counters_.without_pose;
        return false;
    }
    missing_.clear();
    note_world(source->world, source->note);
    scan.has_pose = true;
    scan.world = source->world;
    scan.T_world_sensor = *pose;
    if (source->points_in_world) scan.points = io::into_sensor(scan.cloud, 1.0, *pose);
    if (config_.filter.odometry.refine || scan.times.empty()) return true;
    const io::Trajectory trajectory = io::trajectory_of(*source);
    const double end = scan.stamp + static_cast<double>(latest(scan.times));
    for (std::size_t i = 0; i < trajectory.stamps.size(); ++i) {
        if (trajectory.stamps[i] <= scan.stamp) continue;
        scan.trajectory.stamps.push_back(trajectory.stamps[i]);
        scan.trajectory.poses.push_back(trajectory.poses[i]);
        if (trajectory.stamps[i] >= end) break;
    }
    io::undo_motion(scan.points, scan.times, scan.stamp, trajectory);
    scan.times.clear();
    return true;
}

void Intake::note_world(const std::string& world, const std::string& why) {
    if (world == world_) return;
    tell(world_.empty() ? why
                        : fmt::format("the world frame was '{}' and is '{}' now; set input.world "
                                      "to keep one ({})",
                                      world_, world, why));
    world_ = world;
}

/// Names the likely mistake.
std::string Intake::why_no_pose(const std::string& frame, double stamp) const {
    if (origin_ == PoseOrigin::topic && !topics_.contains(pose_topic_)) {
        return fmt::format("nothing was received on {}", pose_topic_);
    }
    if (origin_ == PoseOrigin::undecided && cloud_topics_.size() > 1) {
        return fmt::format(
            "no poses of '{}', and several sensors need them: /tf must lead to the frame of each",
            frame);
    }
    if (origin_ == PoseOrigin::undecided) {
        return frames_.size() == 0
                   ? std::string("no poses: neither /tf nor a topic of Odometry or PoseStamped")
                   : fmt::format("no moving transform of /tf leads to the frame '{}' of the scans",
                                 frame);
    }
    if (origin_ == PoseOrigin::frames && !frames_.moves(frame)) {
        return frames_.knows(frame)
                   ? fmt::format(
                         "/tf links the frame '{}' of the scans only to '{}', and nothing "
                         "between them moves; is the odometry running?",
                         frame, frames_.above(frame).back())
                   : fmt::format(
                         "/tf does not know the frame '{}' of the scans; is "
                         "/tf_static missing the mounting of the sensor?",
                         frame);
    }
    const auto newest = newest_pose(frame);
    if (!newest) return fmt::format("no pose of the frame '{}'", frame);
    const double ahead = stamp - *newest;
    constexpr double kOtherClock = 10.0;  // [s]
    if (std::abs(ahead) > kOtherClock) {
        return fmt::format(
            "the newest pose is {:.1f} s {} than the scan: their clocks differ (a driver with the "
            "sensor's own time, or use_sim_time for only one of them?)",
            std::abs(ahead), ahead > 0 ? "older" : "newer");
    }
    if (!config_.input.world.empty() && origin_ == PoseOrigin::frames) {
        return fmt::format("/tf does not link '{}' to the frame '{}' of input.world at {:.3f} s",
                           frame, config_.input.world, stamp);
    }
    return fmt::format("the newest pose is {:.2f} s {} than the scan; input.wait is {} s",
                       std::abs(ahead), ahead > 0 ? "older" : "newer", config_.input.wait);
}

std::string Intake::poses_text() const {
    if (!missing_.empty()) return missing_;
    switch (origin_) {
        case PoseOrigin::undecided:
            return "no poses yet";
        case PoseOrigin::odometry:
            return "poses by own odometry";
        case PoseOrigin::frames:
            return fmt::format("poses of '{}' in '{}' from /tf", last_frame_, world_);
        case PoseOrigin::topic:
            return fmt::format("poses in '{}' from {}", world_, pose_topic_);
    }
    return "";
}

void Intake::tell(std::string text) {
    constexpr std::size_t kMost = 20;  // between two calls of pop_notices()
    // A fault that every scan has is said once.
    if (text == last_told_ || notices_.size() >= kMost) return;
    last_told_ = text;
    notices_.push_back(std::move(text));
}

std::vector<std::string> Intake::pop_notices() { return std::exchange(notices_, {}); }

IntakeCounters Intake::counters() const {
    const std::lock_guard hold(lock_);
    return counters_;
}

std::optional<double> Intake::silence() const {
    const std::lock_guard hold(lock_);
    if (!last_cloud_) return std::nullopt;
    return seconds_between(*last_cloud_, std::chrono::steady_clock::now());
}

}  // namespace dynamic_filter::live
