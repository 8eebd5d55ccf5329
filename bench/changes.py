#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Compares what `dynamicfilter diff` found with the truth of `dynamicfilter simulate city`.

usage: changes.py OLD NEW DIFF     OLD, NEW: drives of the city, one for each date; DIFF: output of `diff`

A thing is what rests in one drive and is absent from the other (label 259, with a number). It counts if it has at least 50
points within 40 m, and if the other drive saw through its place: of the beams that pass its middle within 0.4 m, from within
12 m, at least 40 end behind it, and four times as many as in it or before it (every fourth scan is looked at). It is found if
at least half of the voxels of 0.2 m with its points hold points of a change. A change is right if at least half of its points
are of such things, seen through or not, or of what moves (label 251).
"""
import re
import sys
from pathlib import Path

import numpy as np

TEMPORARY, MOVING = 259, 251


def scans_of(drive, step=1):
    poses = np.loadtxt(drive / "poses.txt").reshape(-1, 3, 4)
    for i in range(0, len(poses), step):
        points = np.fromfile(drive / "velodyne" / f"{i:06}.bin", np.float32).reshape(-1, 4)[:, :3]
        yield i, points, poses[i]


def voxels_of(points):
    """One number for each voxel of 0.2 m."""
    cells = np.floor(points / 0.2).astype(np.int64) + (1 << 20)
    return (cells[:, 0] << 42) | (cells[:, 1] << 21) | cells[:, 2]


def things_of(drive):
    """The voxels and the middle of each thing by its number, and the voxels of what moves."""
    places, moving = {}, [np.empty(0, np.int64)]
    for i, points, pose in scans_of(drive):
        labels = np.fromfile(drive / "labels" / f"{i:06}.label", np.uint32)
        kind = labels & 0xffff
        rests, moves = kind == TEMPORARY, kind == MOVING
        world = points @ pose[:, :3].T + pose[:, 3]
        moving.append(np.unique(voxels_of(world[moves])))
        near = np.linalg.norm(points, axis=1) < 40.0
        for number in np.unique(labels[rests] >> 16):
            places.setdefault(int(number), []).append(world[rests & near & (labels >> 16 == number)])
    things = {}
    for number, parts in places.items():
        points = np.concatenate(parts)
        if len(points) >= 50:
            things[number] = (np.unique(voxels_of(points)), points.mean(0))
    return things, np.unique(np.concatenate(moving))


def seen_through(drive, middles):
    """The numbers of the things whose place the drive saw through."""
    counts = {number: [0, 0] for number in middles}
    for _, points, pose in scans_of(drive, 4):
        ranges = np.linalg.norm(points, axis=1)
        for number, middle in middles.items():
            at = pose[:, :3].T @ (middle - pose[:, 3])
            if np.linalg.norm(at) > 12.0:
                continue
            along = points @ at / np.maximum(ranges, 1e-6)
            passes = (along > 0) & (at @ at - along * along <= 0.16)
            behind = ranges[passes] > along[passes] + 0.6
            counts[number][0] += int(behind.sum())
            counts[number][1] += int((~behind).sum())
    return {number for number, (through, blocked) in counts.items() if through >= 40 and through >= 4 * blocked}


def read_pcd(file):
    data = file.read_bytes()
    end = data.index(b"DATA binary\n") + len(b"DATA binary\n")
    header = dict(line.split(" ", 1) for line in data[:end].decode().splitlines() if " " in line)
    kinds = {("F", "4"): "<f4", ("F", "8"): "<f8", ("U", "1"): "u1", ("U", "2"): "<u2", ("U", "4"): "<u4"}
    dtype = [(name, kinds[kind, size]) for name, kind, size in
             zip(header["FIELDS"].split(), header["TYPE"].split(), header["SIZE"].split())]
    cloud = np.frombuffer(data[end:], dtype)
    return np.stack([cloud["x"], cloud["y"], cloud["z"]], 1).astype(float), cloud["change"]


def main():
    if len(sys.argv) != 4:
        sys.exit(re.split(r"\n\n", __doc__)[1])
    old, new, diff = map(Path, sys.argv[1:])
    print("| change | things | seen through | found | found of seen through [%] | changes | right [%] | of things [%] |")
    print("|---|---|---|---|---|---|---|---|")
    of_dates = {old: things_of(old), new: things_of(new)}
    for what, drive, other in (("went", old, new), ("came", new, old)):
        all_things, moving = of_dates[drive]
        things = {n: thing for n, thing in all_things.items() if n not in of_dates[other][0]}
        visible = seen_through(other, {n: middle for n, (_, middle) in things.items()})
        points, numbers = read_pcd(diff / f"{what}.pcd")
        changed = voxels_of(points)
        found = {n for n, (voxels, _) in things.items() if np.isin(voxels, changed).mean() >= 0.5}
        of_things = np.isin(changed, np.concatenate([voxels for voxels, _ in things.values()] or [np.empty(0)]))
        of_moving = np.isin(changed, moving)
        right = rests = 0
        changes = np.unique(numbers)
        for number in changes:
            mine = numbers == number
            rests += of_things[mine].mean() >= 0.5
            right += (of_things | of_moving)[mine].mean() >= 0.5
        share = 100 * len(found & visible) / max(len(visible), 1)
        print(f"| {what} | {len(things)} | {len(visible)} | {len(found)} | {share:.1f} | {len(changes)} "
              f"| {100 * right / max(len(changes), 1):.1f} | {100 * rests / max(len(changes), 1):.1f} |")
        missed = sorted(visible - found)
        if missed:
            print(f"missed: {missed}: " + ", ".join(
                f"{np.isin(things[n][0], changed).mean():.2f} at {np.round(things[n][1], 1)}" for n in missed), file=sys.stderr)
        wrong = [int(n) for n in changes if (of_things | of_moving)[numbers == n].mean() < 0.5]
        print(f"{what}, wrong: {wrong}", file=sys.stderr)


if __name__ == "__main__":
    main()
