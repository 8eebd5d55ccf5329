# SPDX-License-Identifier: MIT
"""without_poses.py RECORDING: no poses: from scans to a clean map."""
import sys

import dynamicfilter as df

filter = df.DynamicFilter()
for frame in df.open_recording(sys.argv[1], poses="none"):
    filter.push(frame.points, stamp=frame.stamp, times=frame.times)  # N x 3 [m], [s], N [s] or None
filter.finish()
poses = filter.poses()  # of each scan 4 x 4, T_world_sensor; the world is the first scan's sensor frame
lost = sum(filter.status(scan) == "lost" for scan in range(len(filter)))
centers, probability = filter.static_map()  # M x 3 [m] in the world's frame
print(f"{len(poses)} scans, {lost} lost, {len(centers)} static voxels")
