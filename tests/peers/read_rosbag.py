# SPDX-License-Identifier: MIT
"""Prints what ROS 1's own rosbag finds in a bag, as read_bag.cjs does."""
import sys

from fnv1a import fnv1a

try:
    import rosbag
    from sensor_msgs.point_cloud2 import read_points
except ImportError as error:
    print(f"SKIPPED: {error}; install python3-rosbag and python3-sensor-msgs", file=sys.stderr)
    sys.exit(77)


def pose_values(at, turn):
    return [at.x, at.y, at.z, turn.x, turn.y, turn.z, turn.w]


def values_of(kind, message):
    if kind == "sensor_msgs/PointCloud2":
        names = ("x", "y", "z", "intensity")
        return [value for point in read_points(message, names) for value in point]
    if kind == "nav_msgs/Odometry":
        return pose_values(message.pose.pose.position, message.pose.pose.orientation)
    if kind == "geometry_msgs/PoseStamped":
        return pose_values(message.pose.position, message.pose.orientation)
    if kind == "nav_msgs/OccupancyGrid":
        info, at = message.info, message.info.origin.position
        return [info.resolution, info.width, info.height, at.x, at.y, at.z, *message.data]
    transform = message.transforms[0].transform
    return pose_values(transform.translation, transform.rotation)


with rosbag.Bag(sys.argv[1]) as bag:
    for topic, message, recorded in bag.read_messages():
        kind = message._type
        header = message.transforms[0].header if kind == "tf2_msgs/TFMessage" else message.header
        values = values_of(kind, message)
        print(topic, kind, recorded.to_nsec(), header.stamp.to_nsec(), header.frame_id,
              len(values), fnv1a(values))
