# SPDX-License-Identifier: MIT
"""Removes moving objects from LiDAR scans and maps.

    import dynamicfilter as df
    recording = df.open_recording("recording")
    filter = df.DynamicFilter()
    for frame in recording:
        labels = filter.push(frame.points, frame.pose, frame.stamp)

If poses are not known, call filter.push(points, stamp=stamp): the filter estimates them, and
filter.pose(scan) returns them.

Labels are N uint8, one per point: UNKNOWN (0), STATIC (9) or DYNAMIC (251), as in SemanticKITTI.
Lengths are in metres, stamps in seconds, poses 4 x 4 matrices T_world_sensor.
"""
import json as _json
import os as _os
import warnings as _warnings

import numpy as _np

from . import _dynamicfilter
from ._dynamicfilter import (ConfigError, DynamicFilter, Error, Frame, InputError, OutputError,
                             Recording, open_recording, read_cloud, simulate)

__version__ = _dynamicfilter.__version__

UNKNOWN, STATIC, DYNAMIC = 0, 9, 251

__all__ = ["ConfigError", "DYNAMIC", "DynamicFilter", "Error", "Frame", "InputError",
           "OutputError", "Recording", "STATIC", "UNKNOWN", "check", "convert", "diff", "evaluate", "open_recording",
           "read_cloud", "run", "simulate", "write_cloud"]


def write_cloud(file, cloud):
    """Writes a cloud: .pcd, .ply, .las, .npy, .bin, .xyz, .txt or .csv, by the file's extension.

    cloud: a structured array of N records with x, y and z, as read_cloud() returns it, or an array
    N x 3 or more columns: x, y, z, intensity, c4, c5, ... Integers of 8 to 64 bits, float32 and float64
    are kept as they are where the format can hold them; what it cannot hold is said as a UserWarning.
    Masked points become NaN. The file replaces an earlier one when it is whole.
    Raises OutputError, TypeError and ValueError.
    """
    array = _records(cloud)
    kinds = {"i", "u", "f"}
    fields = []
    for name in array.dtype.names:
        kind, shape = array.dtype[name].subdtype or (array.dtype[name], ())
        if kind.kind not in kinds or kind.itemsize > 8 or kind == _np.float16 or len(shape) > 1:
            raise TypeError(f"cloud: field {name!r} is {array.dtype[name]}; expected integers or floats of 32 or 64 bits")
        fields.append((name, kind.newbyteorder("<"), shape))
    missing = [axis for axis in "xyz" if axis not in array.dtype.names]
    if missing:
        raise ValueError(f"cloud: has no field {', '.join(missing)}; its fields are {', '.join(array.dtype.names)}")
    packed = _np.empty(array.shape, _np.dtype(fields))
    for name in array.dtype.names:
        packed[name] = array[name]
    described = [(name, kind.str[1:], int(_np.prod(shape, dtype=int))) for name, kind, shape in fields]
    loss = _dynamicfilter.write_cloud(file, described, packed.tobytes())
    if loss:
        _warnings.warn(loss, stacklevel=2)


def _records(cloud):
    """As a structured array of one dimension, without a mask."""
    array = cloud.filled(_np.nan) if isinstance(cloud, _np.ma.MaskedArray) and cloud.dtype.kind == "f" else _np.asarray(cloud)
    if array.dtype.names is not None:
        if array.ndim != 1:
            raise ValueError(f"cloud: expected one record a point, got shape {array.shape}")
        return array
    if array.ndim != 2 or array.shape[1] < 3:
        raise ValueError(f"cloud: expected N records, or an array N x 3 or more columns, got shape {array.shape}")
    if array.dtype.kind not in "iuf":
        raise TypeError(f"cloud: expected numbers, got {array.dtype}")
    names = ["x", "y", "z", "intensity"][:array.shape[1]] + [f"c{i}" for i in range(4, array.shape[1])]
    kind = array.dtype if array.dtype.kind == "f" else _np.dtype("<f8")
    records = _np.empty(len(array), [(name, kind) for name in names])
    for i, name in enumerate(names):
        records[name] = array[:, i]
    return records


def run(data, output=None, **options):
    """Removes moving objects from a recording and writes the results, as `dynamicfilter run` does.

    data: bag or folder; output: folder, by default results/<UTC stamp>.
    Options: config and threads as in DynamicFilter, overwrite, resume, online (multiple of the
    sensor's rate; 0: full speed), quiet (False prints progress, notes and the closing table on stderr
    and stdout, like the command), refine (poses), and the options of open_recording(). With
    poses="none", the poses are estimated from the scans. refine and deskew are True, False or "auto"
    (the default), which does it if scans overlay better afterwards.
    With update (output folder of an earlier run of the same place), the result is the map of its drives and of this
    recording; keep_evidence=True keeps what an update needs to go on (docs/upkeep.md).
    Returns {"output": folder, "metrics": as in metrics.json, "timing": as in timing.json [s, ms]}.
    The labels are in the folder `labels` of the output, N uint32 per scan. Rejected or dropped scans
    raise nothing; they are in metrics["rejected"], ["dropped"] and ["lost"].
    Raises ConfigError (also if the folder is not empty, without overwrite or resume), InputError,
    OutputError, and KeyboardInterrupt after the results so far are written.
    """
    folder, metrics, timing = _dynamicfilter.run(data, output, options)
    return {"output": str(folder), "metrics": _json.loads(metrics), "timing": _json.loads(timing)}


def evaluate(truth, *, labels=None, map=None, voxel=0.2, min_range=0.0, max_range=float("inf"), box="", **options):
    """Scores labels or a map against a recording's ground truth, as `dynamicfilter eval` does.

    labels: folder of label files (N uint32 per scan), or of a run. Or map: cloud file in the world
    frame [m]. voxel: edge length of a voxel [m]. min_range, max_range: only points at this
    distance from the sensor [m] are scored. box: only points within it ("X,Y,Z,X,Y,Z" [m], in the
    world). Options: as in open_recording().
    Returns the scores as a dict of shares 0..1, and the numbers of `scans` scored, `left_out`, and
    not scored because only some scans were to have ground truth (`without_truth`). Scores under
    `voxel_shifted` are those of the grid that is shifted by half a voxel.
    Raises ConfigError, InputError, TypeError and ValueError.
    """
    return _json.loads(_dynamicfilter.evaluate(truth, labels, map, voxel, min_range, max_range, box, options))


def convert(data, output, **options):
    """Writes a recording, a cloud or the map of several drives in another format, as `dynamicfilter convert` does.

    data: bag, folder or cloud file; output: bag, folder or cloud file, by its extension (.pcd, .ply, .las, .npy, .bin,
    .mcap, .bag, .db3, .bt, .ot).
    Options: labels (folder of a run, or of label files; default: the ground truth), to (layout of the output folder: kitti,
    benchmark, nav2, objects, autoware, 3dtiles or las), box ("X,Y,Z,X,Y,Z" [m]), max_range [m], only ("static" or
    "dynamic"), thin (width of a cell [m]), crs ("EPSG:32633"), origin ("LAT,LON,HEIGHT"), cell [m], robot_height [m], step [m],
    storey, normals, ground, moving_class, overwrite, quiet (False prints progress and what was written), and the options of open_recording().
    Notes on what a format could not hold go to stderr.
    Raises ConfigError (also if the output is there already), InputError, OutputError, TypeError, ValueError, and
    KeyboardInterrupt, after which no file is left.
    """
    _dynamicfilter.convert(data, output, options)


def diff(old_run, new_run, output, *, threads=0, memory="", overwrite=False, quiet=True):
    """Says what came and went between two runs of one place, as `dynamicfilter diff` does.

    old_run, new_run: output folders of runs, in one world. output: folder for clouds, tables and a page. threads: 0 uses all
    cores. memory: most memory to use, such as "1.5G". overwrite: True replaces an earlier comparison. quiet: False shows the
    progress. Files in `output`: docs/upkeep.md.
    Returns {"went": number, "came": number, "voxels": {"seen_at_both", "old_only", "new_only"}, "changes": [{"change":
    "went" or "came", "number", "center" [m], "size" [m], "points", "scans", "first" [s], "last" [s]}]}.
    Raises ConfigError, InputError, OutputError, and KeyboardInterrupt, after which the same call goes on.
    """
    _dynamicfilter.diff(old_run, new_run, output, threads, memory, overwrite, quiet)
    with open(_os.path.join(output, "changes.json"), encoding="utf-8") as file:
        return _json.load(file)


def check(data, **options):
    """Checks whether poses and scans of a recording fit together, as `dynamicfilter check` does.

    DynamicFilter does not detect inverse poses or wrong units, so use this check first.
    data: bag or folder. Options: as in open_recording(); with poses="none" only the scans are checked.
    Returns {"findings": [{"what", "advice"}], "notes", "overlays": {reading: share 0..1}, "unusable", "lost"}.
    The findings and the sentences of the last two are empty if there is no fault. The advice names
    options of the command: --pose-fix inverse is pose_fix="inverse" here.
    Raises TypeError, ConfigError and InputError.
    """
    return _json.loads(_dynamicfilter.check(data, options))
