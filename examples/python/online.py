# SPDX-License-Identifier: MIT
"""online.py RECORDING: scan by scan, with a verdict at once and a better one later."""
import sys

import dynamicfilter as df

filter = df.DynamicFilter(horizon=200.0, keep=20)  # [m], scans
corrected = 0
for frame in df.open_recording(sys.argv[1]):  # on a robot: points N x 3 [m], T_world_sensor 4 x 4, stamp [s]
    labels = filter.push(frame.points, frame.pose, frame.stamp)  # N: 0 unknown, 9 static, 251 dynamic
    if len(filter) % 10 == 0:
        for scan, better in filter.corrections():  # of the scans kept, those that later ones changed
            corrected += 1
filter.finish()
centers, probability = filter.local_map(radius=20.0)  # M x 3 [m] in the world's frame
print(f"{len(filter)} scans, {corrected} corrected, {len(centers)} static voxels around")
for scan, sentence in filter.notices():  # a jump of the poses, say
    print(f"scan {scan}: {sentence}")
