# SPDX-License-Identifier: MIT
"""A node of ROS 1 in Python: publishes clouds on /peer/points, and on /peer/wrong as another type;
sends what comes on /filter/raw back on /peer/raw; prints the clouds that come on /filter/cloud."""
import json
import sys
import threading

import rospy
from sensor_msgs import point_cloud2
from sensor_msgs.msg import PointCloud2
from std_msgs.msg import Header


class Raw(rospy.AnyMsg):
    """Bytes in place of a cloud."""
    _type, _md5sum, _full_text = PointCloud2._type, PointCloud2._md5sum, PointCloud2._full_text

    def serialize(self, buff):
        buff.write(self._buff)


class Wrong(PointCloud2):
    """A type of the same name with another definition."""
    _md5sum = "0123456789abcdef0123456789abcdef"


def send_back(message):
    back = Raw()
    back._buff = message._buff
    echo.publish(back)


def show(cloud):
    print(json.dumps({"seq": cloud.header.seq, "stamp": cloud.header.stamp.to_nsec(), "frame": cloud.header.frame_id,
                      "points": [list(p) for p in point_cloud2.read_points(cloud, ("x", "y", "z", "label"))]}),
          flush=True)


rospy.init_node(sys.argv[1], disable_signals=True)
echo = rospy.Publisher("/peer/raw", Raw, queue_size=10)
right = rospy.Publisher("/peer/points", PointCloud2, queue_size=1)
wrong = rospy.Publisher("/peer/wrong", Wrong, queue_size=1)
rospy.Subscriber("/filter/raw", rospy.AnyMsg, send_back)
rospy.Subscriber("/filter/cloud", PointCloud2, show)
pause = threading.Event()
while not rospy.is_shutdown():
    cloud = point_cloud2.create_cloud_xyz32(Header(frame_id="lidar"), [(1, 2, 3), (4, 5, 6)])
    right.publish(cloud)
    wrong.publish(Wrong(*(getattr(cloud, field) for field in cloud.__slots__)))
    pause.wait(0.05)
