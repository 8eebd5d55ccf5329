# SPDX-License-Identifier: MIT
"""Runs a reader on a case in a process of its own, and says how that ended."""
import re
import resource
import signal
import struct
import subprocess
from pathlib import Path

SECONDS = 20
CRASH, ABORT, HANG, MEMORY = "crash", "abort", "hang", "out of memory"
# Where the reader says that all is well: points that the file does not hold; points that it holds,
# but no word of what is wrong with it; no points.
WRONG, SILENT, EMPTY = "wrong points", "accepted", "empty"
ERROR, READ = "error", "read"
OUTCOMES = [CRASH, ABORT, HANG, MEMORY, WRONG, SILENT, EMPTY, ERROR, READ]


def limit(gigabytes):
    def apply():
        resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
        if gigabytes:
            resource.setrlimit(resource.RLIMIT_AS, (gigabytes << 30,) * 2)
    return apply


def run(command, case, folder, gigabytes):
    """The exit status, what was said, and the points; a status of None means that time was up."""
    folder = Path(folder)
    out = folder / "out.bin"
    out.unlink(missing_ok=True)
    (folder / case.file).write_bytes(case.data)
    try:
        done = subprocess.run([*command, folder / case.file, out], capture_output=True, text=True,
                              errors="replace", timeout=SECONDS, preexec_fn=limit(gigabytes))
    except subprocess.TimeoutExpired:
        return None, "", []
    records = struct.iter_unpack("<4f", out.read_bytes()) if out.exists() else []
    return done.returncode, done.stderr, [record[:3] for record in records]


def same(found, expected):
    """Where both are not finite they are the same, too."""
    return repr(found) == repr([tuple(map(float, point)) for point in expected])


def failed(status, said):
    if re.search("bad_alloc|length_error|MemoryError", said):
        return MEMORY
    if status == -signal.SIGABRT:
        return ABORT
    if status < 0:
        return CRASH
    assert said, "an error without a reason"
    return ERROR


def outcome(case, status, said, points):
    if status is None:
        return HANG
    if status != 0:
        return failed(status, said)
    if case.valid and same(points, case.points):
        return READ
    if not points:
        return EMPTY
    held = {repr(tuple(map(float, point))) for point in case.points}
    return SILENT if not case.valid and all(repr(point) in held for point in points) else WRONG
