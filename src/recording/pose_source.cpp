// SPDX-License-Identifier: MIT
#include "recording/pose_source.hpp"

#include <fmt/format.h>

namespace dynamic_filter::io {

Trajectory trajectory_of(const PoseSource& source) {
    Trajectory trajectory;
    for (const double stamp : source.stamps) {
        const auto pose = source.T_world_sensor(stamp);
        if (!pose) continue;
        trajectory.stamps.push_back(stamp);
        trajectory.poses.push_back(*pose);
    }
    put_in_order(trajectory);
    return trajectory;
}

PoseSource from_frames(const FrameTree& frames, const std::string& sensor, const std::string& world,
                       const LinkLookup& lookup) {
    const std::string root = world.empty() ? frames.above(sensor).back() : world;
    return {[&frames, sensor, root, lookup](double stamp) {
                return frames.pose(sensor, root, stamp, lookup);
            },
            frames.stamps_above(sensor), false, root,
            fmt::format("poses from /tf: frame '{}' in '{}'", sensor, root)};
}

PoseSource from_topic(const std::string& name, const PoseTopic& topic, const FrameTree& frames,
                      const std::string& sensor, const LinkLookup& lookup) {
    const Trajectory& trajectory = topic.trajectory;
    const auto body_pose = [&trajectory, lookup](double stamp) {
        return pose_at(trajectory, stamp, lookup.gap, 0.2);
    };
    if (sensor == topic.parent) {
        return {body_pose, trajectory.stamps, true, topic.parent,
                fmt::format("poses from {}; its frame '{}' is also the frame of the points, so the "
                            "points are transformed into the sensor frame",
                            name, sensor)};
    }
    const bool linked = !topic.child.empty() && sensor != topic.child &&
                        frames.above(topic.child).back() == frames.above(sensor).back();
    if (linked) {
        return {[=, &frames, child = topic.child](double stamp) -> std::optional<Pose> {
                    const auto T_world_body = body_pose(stamp);
                    const auto T_body_sensor = frames.pose(sensor, child, stamp, lookup);
                    if (!T_world_body || !T_body_sensor) return std::nullopt;
                    return *T_world_body * *T_body_sensor;
                },
                trajectory.stamps, false, topic.parent,
                fmt::format("poses from {}, from its frame '{}' to '{}' by /tf", name, topic.child,
                            sensor)};
    }
    const bool same = topic.child.empty() || sensor == topic.child;
    return {body_pose,
            trajectory.stamps,
            false,
            topic.parent,
            same ? fmt::format("poses from {}", name)
                 : fmt::format("poses from {}; no transform links its frame '{}' to the frame '{}' "
                               "of the scans, so both are assumed to be the same",
                               name, topic.child, sensor),
            sensor == topic.child};
}

}  // namespace dynamic_filter::io
