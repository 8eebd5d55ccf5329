"""The default preset on simulated and real recordings."""
import os
import shutil
import sys
from pathlib import Path

from lib.bench import (BUILD, NOISE, both, call, cells, mean, memory_cell, percent, point_cells, simulated, spread,
                               table, voxel)

HEAD = ["PR [%]", "RR [%]", "F1", "instant F1", "AA [%]", "moving IoU [%]", "memory [MB]", "F1 with preset paper"]


def row(bench, scene, sensor, *options):
    """Both presets over all seeds."""
    pairs = []
    for seed in bench.seeds:
        recording = simulated(bench, scene, sensor, seed, *options)
        pairs.append(both(bench, recording))
        shutil.rmtree(recording)
    default = [d for d, _ in pairs]
    pr, rr, f1 = cells(mean([voxel(r) for r in default]))
    return [pr, rr, f1 + (spread([voxel(r)[2] for r in default]) if f1 != "-" else ""),
            cells(mean([voxel(r, True) for r in default]))[2], *point_cells(default), memory_cell(default),
            cells(mean([voxel(p) for _, p in pairs]))[2]]


def scenes(bench, cases):
    """One row a case: scene, sensor, people or None."""
    rows = [[scene, sensor, people or "-", *row(bench, scene, sensor, *(["--pedestrians", people] if people else []))]
            for scene, sensor, people in cases]
    return table(["scene", "sensor", "people", *HEAD], rows)


def default_table(bench):
    cases = [("crowd", sensor, people) for sensor in ("vlp16", "os64") for people in (50, 100, 150)]
    cases += [("street", "os64", None), ("square", "os64", None)]
    return bench.seeds_sentence + scenes(bench, cases)


def hall_table(bench):
    return bench.seeds_sentence + scenes(bench, [("hall", "os64", None)])


def scene_table(bench):
    cases = [("crowd", "vlp16", *NOISE), ("square", "os64", *NOISE), ("crowd", "vlp16", "--pedestrians", 0),
             ("crowd", "solid"), ("square", "solid"), ("street", "hdl64"), ("square", "vlp16"), ("crowd", "hdl32"),
             ("crowd", "os128"), ("crowd", "vlp16", "--rate", 5)]
    rows = [[scene, sensor, " ".join(map(str, options)), *row(bench, scene, sensor, *options)]
            for scene, sensor, *options in cases]
    return bench.seeds_sentence + table(["scene", "sensor", "options", *HEAD], rows)


def error_tables(_):
    tables = []
    for case in (("default", "crowd", "vlp16", 100, 1), ("paper", "crowd", "vlp16", 100, 1),
                 ("default", "street", "os64", 30, 1), ("default", "square", "os64", 60, 1),
                 ("default", "jam", "vlp16", -1, 1), ("default", "crowd", "vlp16", 150, 1)):
        print("errors", *case, file=sys.stderr, flush=True)
        words = " ".join(map(str, case))
        tables.append(f"`build/release/error_table {words}`\n\n{call(BUILD / 'error_table', *case)}")
    return "\n".join(tables)


def real_table(bench):
    data = os.environ.get("DYNAMICFILTER_DATA")
    if not data:
        print("SKIPPED: real recordings (set DYNAMICFILTER_DATA)", file=sys.stderr)
        return None
    rows = []
    for folder in sorted(p for p in Path(data).iterdir() if (p / "labels").is_dir()):
        for preset, result in zip(("default", "paper"), both(bench, folder)):
            point = result["metrics"]["point"]
            rows.append([folder.name, result["metrics"]["scans"], preset, *cells(voxel(result)),
                         cells(voxel(result, True))[2], *(percent(point[k]) for k in ("sa", "da", "aa", "iou")),
                         memory_cell([result])])
    return table(["recording", "scans", "preset", "PR [%]", "RR [%]", "F1", "instant F1", "SA", "DA", "AA", "moving IoU", "memory [MB]"], rows)
