# SPDX-License-Identifier: MIT
"""Removes moving objects from LiDAR scans and maps.

    import dynamicfilter as df
    recording = df.open_recording("recording")
    filter = df.DynamicFilter()
    for frame in recording:
        labels = filter.push(frame.points, frame.pose, frame.stamp)

Where nobody knows the poses, the filter finds them: filter.push(points, stamp=stamp), and
filter.pose(scan) tells.

Labels are N uint8, one a point: UNKNOWN (0), STATIC (9) or DYNAMIC (251), as in SemanticKITTI.
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
    """Removes moving objects from a recording, as `dynamicfilter run` does, and says what it says.

    data: bag or folder; output: folder, by default results/<UTC stamp>.
    Options: config and threads as of DynamicFilter, overwrite, resume, online (times the sensor's
    rate; 0: as fast as it can), quiet (False: progress, notes and the closing table on stderr and
    stdout, as the command has them), refine (poses), and how to read the recording, as of
    open_recording(); with poses="none" they are found from the scans. refine and deskew: True, False, or
    "auto", the default: where scans overlay better then.
    Returns {"output": folder, "metrics": as in metrics.json, "timing": as in timing.json [s, ms]};
    labels are in its folder `labels`, N uint32 a scan. Scans that were rejected or dropped raise
    nothing: they are in metrics["rejected"], ["dropped"] and ["lost"].
    Raises ConfigError (also if the folder holds something, without overwrite or resume), InputError,
    OutputError, and KeyboardInterrupt after what was filtered until then is written.
    """
    folder, metrics, timing = _dynamicfilter.run(data, output, options)
    return {"output": str(folder), "metrics": _json.loads(metrics), "timing": _json.loads(timing)}


def evaluate(truth, *, labels=None, map=None, voxel=0.2, min_range=0.0, max_range=float("inf"), **options):
    """Scores labels or a map against a recording's ground truth, as `dynamicfilter eval` does.

    labels: folder of label files (N uint32 a scan), or of a run; or map: cloud file in the world's
    frame [m]. voxel: edge of a voxel [m]. min_range, max_range: only points at this distance from the
    sensor [m] are scored. Options: as of open_recording().
    Returns the scores as a dict of shares 0..1, and how many `scans` were scored and `left_out`.
    Raises ConfigError, InputError, TypeError and ValueError.
    """
    return _json.loads(_dynamicfilter.evaluate(truth, labels, map, voxel, min_range, max_range, options))


def check(data, **options):
    """Looks whether poses and scans of a recording fit together, as `dynamicfilter check` does.

    DynamicFilter cannot see that poses are inverse, or in other units: look here first.
    data: bag or folder. Options: as of open_recording(); with poses="none" only the scans are looked at.
    Returns {"findings": [{"what", "advice"}], "overlays": {reading: share 0..1}, "unusable", "lost"}:
    findings and the sentences of the last two are empty if all is well. Advice is worded for the
    command: --pose-fix inverse is pose_fix="inverse" here.
    Raises TypeError, ConfigError and InputError.
    """
    return _json.loads(_dynamicfilter.check(data, options))
