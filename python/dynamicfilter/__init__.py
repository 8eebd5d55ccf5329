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

from . import _dynamicfilter
from ._dynamicfilter import (ConfigError, DynamicFilter, Error, Frame, InputError, OutputError,
                             Recording, __version__, open_recording, read_cloud, simulate)

UNKNOWN, STATIC, DYNAMIC = 0, 9, 251

__all__ = ["ConfigError", "DYNAMIC", "DynamicFilter", "Error", "Frame", "InputError",
           "OutputError", "Recording", "STATIC", "UNKNOWN", "check", "evaluate", "open_recording",
           "read_cloud", "run", "simulate"]


def run(data, output=None, **options):
    """Removes moving objects from a recording and writes the results, as `dynamicfilter run` does.

    data: bag or folder; output: folder, by default results/<UTC stamp>.
    Options: config and threads as in DynamicFilter, overwrite, resume, online (multiple of the
    sensor's rate; 0: full speed), quiet (False prints progress, notes and the closing table on stderr
    and stdout, like the command), refine (poses), and the options of open_recording(). With
    poses="none", the poses are estimated from the scans. refine and deskew are True, False or "auto"
    (the default), which does it if scans overlay better afterwards.
    Returns {"output": folder, "metrics": as in metrics.json, "timing": as in timing.json [s, ms]}.
    The labels are in the folder `labels` of the output, N uint32 per scan. Rejected or dropped scans
    raise nothing; they are in metrics["rejected"], ["dropped"] and ["lost"].
    Raises ConfigError (also if the folder is not empty, without overwrite or resume), InputError,
    OutputError, and KeyboardInterrupt after the results so far are written.
    """
    folder, metrics, timing = _dynamicfilter.run(data, output, options)
    return {"output": str(folder), "metrics": _json.loads(metrics), "timing": _json.loads(timing)}


def evaluate(truth, *, labels=None, map=None, voxel=0.2, **options):
    """Scores labels or a map against a recording's ground truth, as `dynamicfilter eval` does.

    labels: folder of label files (N uint32 per scan), or of a run. Or map: cloud file in the world
    frame [m]. voxel: edge length of a voxel [m]. Options: as in open_recording().
    Returns the scores as a dict of shares 0..1, and the numbers of `scans` scored and `left_out`.
    Raises ConfigError, InputError, TypeError and ValueError.
    """
    return _json.loads(_dynamicfilter.evaluate(truth, labels, map, voxel, options))


def check(data, **options):
    """Checks whether poses and scans of a recording fit together, as `dynamicfilter check` does.

    DynamicFilter does not detect inverse poses or wrong units, so use this check first.
    data: bag or folder. Options: as in open_recording(); with poses="none" only the scans are checked.
    Returns {"findings": [{"what", "advice"}], "overlays": {reading: share 0..1}, "unusable", "lost"}.
    The findings and the sentences of the last two are empty if there is no fault. The advice names
    options of the command: --pose-fix inverse is pose_fix="inverse" here.
    Raises TypeError, ConfigError and InputError.
    """
    return _json.loads(_dynamicfilter.check(data, options))
