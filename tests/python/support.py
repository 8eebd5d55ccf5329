# SPDX-License-Identifier: MIT
"""What the tests of the package share. Exit code 77 where they cannot run: ctest says skipped."""
import functools
import os
import sys
import tempfile
import unittest

try:
    import numpy as np
    import dynamicfilter as df
except ImportError as missing:
    print(f"skipped: {missing}")
    sys.exit(77)

COMMAND = os.environ.get("DYNAMICFILTER_COMMAND")
SCANS = 25


@functools.cache
def _folder():
    return tempfile.TemporaryDirectory(prefix="dynamicfilter-")


def scratch(name):
    return os.path.join(_folder().name, name)


@functools.cache
def recording():
    """A crowd, a few scans of it."""
    folder = scratch("recording")
    df.simulate("crowd", folder, frames=SCANS)
    return folder


@functools.cache
def frames():
    return list(df.open_recording(recording()))


def push_all(filter):
    return [filter.push(f.points, f.pose, f.stamp) for f in frames()]


def small_scan(seed=0, size=300):
    random = np.random.default_rng(seed)
    return (random.random((size, 3)) * 20 - 10).astype(np.float32)


main = unittest.main
