#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""How far poses are from true ones, both in KITTI's rows.   usage: pose_errors.py TRUE FOUND"""
import sys

import numpy

true, found = (numpy.loadtxt(file).reshape(-1, 3, 4) for file in sys.argv[1:3])
away = numpy.linalg.norm(true[:, :, 3] - found[:, :, 3], axis=1)
cosines = (numpy.einsum("nij,nij->n", true[:, :, :3], found[:, :, :3]) - 1) / 2
turned = numpy.degrees(numpy.arccos(numpy.clip(cosines, -1, 1)))
print(f"    error: mean {away.mean():.3f} m, largest {away.max():.3f} m; {turned.max():.2f} deg at most")
