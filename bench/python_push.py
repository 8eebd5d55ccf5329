#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""Measures the cost of the Python interface: scans per second of push() in Python and in C++, in turn, on one recording.

    PYTHONPATH=build/release/python bench/python_push.py build/release RECORDING [rounds]
"""
import statistics
import subprocess
import sys
import time

import dynamicfilter as df

build, recording = sys.argv[1:3]
rounds = int(sys.argv[3]) if len(sys.argv) > 3 else 5
frames = list(df.open_recording(recording))


def from_python(keep):
    filter = df.DynamicFilter(keep=keep)
    start = time.perf_counter()
    for frame in frames:
        filter.push(frame.points, frame.pose, frame.stamp)
    filter.flush()
    return len(frames) / (time.perf_counter() - start)


def from_cpp(*keep):
    return float(subprocess.run([f"{build}/push", recording, *keep], check=True, capture_output=True).stdout)


ways = {"C++": from_cpp, "Python": lambda: from_python(False),
        "C++, keeping": lambda: from_cpp("keep"), "Python, keeping": lambda: from_python(True)}
from_python(False)
rates = {name: [] for name in ways}
for _ in range(rounds):
    for name, measure in ways.items():
        rates[name].append(measure())
for name, values in rates.items():
    ratio = statistics.median(value / cpp for value, cpp in zip(values, rates["C++"]))
    print(f"{name:16} {statistics.median(values):8.1f} scans/s {ratio:6.3f} of C++")
