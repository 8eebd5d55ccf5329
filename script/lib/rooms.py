#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Checks which room includes which. usage: rooms.py [--headers]

A room is a folder of src. Its private headers lie beside their sources and are included as "room/file.hpp". The headers
for users lie in include/dynamic_filter, belong to a room, too, and are included as "dynamic_filter/file.hpp". Headers of
tests are included from tests ("support/random.hpp"), those of bench, python/src and ros1 from the root.

--headers compiles each header of src and include alone, which takes five minutes on one core.
"""
import collections
import os
import re
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]

# Rooms that compute read no files and print nothing: this is all they may include of base.
BASE = ("dynamic_filter/error.hpp dynamic_filter/parallel.hpp dynamic_filter/stage_times.hpp base/best_kernel.hpp "
        "base/numbers.hpp")

# What each room may include beside itself: rooms above it in this list, or single headers of theirs.
ROOMS = {
    "base": "",
    "geometry": BASE,
    "settings": "base",
    "filter": f"{BASE} geometry settings",
    "tracking": f"{BASE} geometry settings",
    "formats": "base geometry",
    "score": "base geometry",
    "draw": "base geometry",
    "sim": "base geometry",
    "paper": f"{BASE} geometry settings dynamic_filter/filter.hpp filter/keyframe.hpp filter/label.hpp",
    "online": f"{BASE} geometry settings filter tracking paper",
    "recording": "base geometry formats tracking/upright.hpp",
    "check": "base geometry settings tracking formats recording",
    "navigation": "base geometry formats dynamic_filter/filter.hpp",
    "objects": "base geometry",
    "export": "base geometry formats draw recording navigation objects",
    "page": "base geometry formats score recording objects dynamic_filter/filter.hpp",
    "run": "base geometry settings filter tracking online paper formats recording check score objects page",
    "upkeep": "base geometry formats recording draw objects export page run",
    "arena": "base geometry formats recording score sim run",
    "live": "base geometry settings filter tracking online formats recording check/watch.hpp navigation page run",
    "commands": "*",
}
OUTSIDE = ("bench", "examples", "python/src", "ros1", "tests")  # may include every room

# The room of each header for users.
PUBLIC = {
    "error.hpp": "base",
    "file.hpp": "base",
    "parallel.hpp": "base",
    "stage_times.hpp": "base",
    "types.hpp": "geometry",
    "range_image.hpp": "geometry",
    "motion.hpp": "geometry",
    "settings.hpp": "settings",
    "tracking.hpp": "tracking",
    "filter.hpp": "filter",
    "online.hpp": "online",
    "cloud.hpp": "formats",
    "writers.hpp": "formats",
    "poses.hpp": "formats",
    "bag.hpp": "formats",
    "recording.hpp": "recording",
    "check.hpp": "check",
    "scores.hpp": "score",
    "simulation.hpp": "sim",
    "dynamic_filter.hpp": "online",
}

# Includes that are wrong and still there: file -> rooms. The list only gets shorter.
EXCEPTIONS = {
}

INCLUDE = re.compile(r'^\s*#\s*include\s+([<"])([^>"]+)[>"]')


def own_files():
    listed = subprocess.run(["git", "ls-files", "*.cpp", "*.hpp"], cwd=ROOT, capture_output=True, text=True, check=True)
    return [name for name in listed.stdout.split() if (ROOT / name).exists()]


def room_of(file):
    """The room of a file of src or of a header for users; None: the file is outside of src."""
    if file.startswith("include/dynamic_filter/"):
        return PUBLIC.get(file.removeprefix("include/dynamic_filter/"))
    return file.split("/")[1] if file.startswith("src/") else None


def resolved(name, bracket, includer, files):
    """The own file that an include means, or what is wrong with the include; None: it means none of ours."""
    tops = ["include/", "src/", "tests/"] + [""] * name.startswith(("bench/", "python/src/", "ros1/"))
    found = [top + name for top in tops if top + name in files]
    beside = os.path.normpath(os.path.join(os.path.dirname(includer), name))
    if bracket == "<":
        if not found:
            return None
        if found[0].startswith("include/") and includer.startswith(("examples/", "tests/consumer/")):
            return found[0]
        return f'<{name}> is ours: "{name}"'
    if len(found) > 1:
        return f'"{name}" means {" or ".join(found)}'
    if "/" in name and found:
        return found[0]
    if beside in files:
        return f'"{name}" is spelt without its folder'
    return f'"{name}" is no file of ours; other headers are included with <>'


def may_include(room):
    rooms = ROOMS[room].split()
    return set(ROOMS) if rooms == ["*"] else {room, *rooms}


def faults():
    files = set(own_files())
    known = list(ROOMS)
    for position, room in enumerate(known):
        for other in ROOMS[room].split():
            floor = room_of(f"include/{other}") or other.split("/")[0]
            if other != "*" and floor not in known[:position]:
                yield f"rooms.py: {room} may include {other}, which is not above it in the list"
    for file in sorted(files):
        if file.startswith("include/") and file.removeprefix("include/dynamic_filter/") not in PUBLIC:
            yield f"{file} is no header for users: it belongs beside its source"
        if file.startswith("src/") and room_of(file) not in ROOMS:
            yield f"{file} is in no room"
    for name, room in PUBLIC.items():
        if f"include/dynamic_filter/{name}" not in files or room not in ROOMS:
            yield f"rooms.py: {name} of room {room} is not there"
    used = collections.defaultdict(set)
    for file in sorted(files):
        room = room_of(file)
        if room is None and not file.startswith(OUTSIDE):
            continue
        for number, line in enumerate((ROOT / file).read_text().splitlines(), 1):
            include = INCLUDE.match(line)
            if not include:
                continue
            target = resolved(include[2], include[1], file, files)
            if target is None:
                continue
            place = f"{file}:{number}"
            if target not in files:
                yield f"{place}: {target}"
                continue
            if room is None:
                continue
            other = room_of(target)
            if other is None:
                yield f"{place}: {target} is outside of src"
            elif file.startswith("include/") and not target.startswith("include/"):
                yield f"{place}: a header for users includes a private one"
            elif other in ROOMS and other not in may_include(room) and include[2] not in may_include(room):
                used[file].add(other)
                if other not in EXCEPTIONS.get(file, "").split():
                    yield f"{place}: {room} may not include {other}" + (f", but for {BASE}" if other == "base" else "")
    for file, rooms in EXCEPTIONS.items():
        for room in rooms.split():
            if room not in used[file]:
                yield f"rooms.py: {file} includes nothing of {room} any more; take it from the exceptions"


def compile_alone():
    eigen = subprocess.run(["pkg-config", "--cflags", "eigen3"], capture_output=True, text=True, check=True).stdout.split()
    command = ["g++", "-std=c++20", "-fsyntax-only", "-Wall", "-Wextra", "-Wno-psabi", "-Iinclude", "-Isrc", *eigen,
               "-DDYNAMIC_FILTER_LEVEL=baseline", "-x", "c++", "-"]

    def said_of(header):
        return subprocess.run(command, cwd=ROOT, input=f'#include "{header}"\n', capture_output=True, text=True).stderr

    # The plug-in's headers need those of MPI.
    headers = [name.split("/", 1)[1] for name in own_files() if name.endswith(".hpp")
               and name.startswith(("src/", "include/")) and not name.startswith("src/run/mpi/")]
    with ThreadPoolExecutor(len(os.sched_getaffinity(0))) as pool:
        found = [said for said in pool.map(said_of, headers) if said]
    print("\n".join(found) or f"{len(headers)} headers, each of which compiles alone")
    return bool(found)


def main():
    if sys.argv[1:] == ["--headers"]:
        return compile_alone()
    if sys.argv[1:]:
        sys.exit(__doc__)
    found = list(faults())
    print("\n".join(found) or f"{len(ROOMS)} rooms, {sum(len(rooms.split()) for rooms in EXCEPTIONS.values())} exceptions")
    return bool(found)


if __name__ == "__main__":
    sys.exit(main())
