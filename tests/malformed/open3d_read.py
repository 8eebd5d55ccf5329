# SPDX-License-Identifier: MIT
"""open3d_read.py FILE OUT.bin: what Open3D finds in a .pcd or .ply, as float32 x y z 0."""
import sys

import numpy
import open3d

points = numpy.asarray(open3d.io.read_point_cloud(sys.argv[1]).points)
numpy.pad(points, ((0, 0), (0, 1))).astype("<f4").tofile(sys.argv[2])
