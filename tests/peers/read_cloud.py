# SPDX-License-Identifier: MIT
"""Prints what Open3D (.pcd, .ply) and numpy (.npy, .bin) find in a cloud, as read_cloud.mjs does."""
import sys

from fnv1a import fnv1a


def of_open3d(path):
    try:
        import open3d
    except ImportError:
        print("SKIPPED: no Open3D for", sys.executable, "- install python3-open3d", file=sys.stderr)
        sys.exit(77)
    # It says that it passes over fields of 16 bits.
    open3d.utility.set_verbosity_level(open3d.utility.VerbosityLevel.Error)
    found = open3d.t.io.read_point_cloud(path).point
    at = found["positions"].numpy()
    own = {name: found[name].numpy()[:, 0] for name in ("intensity", "dynamic")}
    return {"x": at[:, 0], "y": at[:, 1], "z": at[:, 2], **own}


def of_numpy(path):
    try:
        import numpy
    except ImportError:
        print("SKIPPED: no numpy for", sys.executable, file=sys.stderr)
        sys.exit(77)
    if path.endswith(".npy"):
        rows = numpy.load(path)
    else:
        rows = numpy.fromfile(path, "<f4").reshape(-1, 4)
    columns = {name: rows[:, i] for i, name in enumerate(("x", "y", "z", "intensity"))}
    return columns if rows.shape[1] == 4 else {**columns, "dynamic": rows[:, -1]}


read = of_numpy if sys.argv[1].endswith((".npy", ".bin")) else of_open3d
for name, values in read(sys.argv[1]).items():
    print(name, len(values), fnv1a(values))
