# SPDX-License-Identifier: MIT
"""A second count of the arenas whose data are more than scans in files: DOALS, nuScenes mini and KITTI's raw drives.

The command writes a simulated recording in the layout of the data set. This program reads its truth from the files of the layout,
makes some random results of it (4), and compares the moving IoU of each with that of the command.
Usage: count_on_twins.py COMMAND [CASES]
"""
import json
import subprocess
import sys
import tempfile
import xml.etree.ElementTree as ElementTree
from pathlib import Path

import numpy as np

COMMAND = sys.argv[1]
CASES = int(sys.argv[2]) if len(sys.argv) > 2 else 4
EARTH = 6378137.0


def call(*words):
    done = subprocess.run([COMMAND, *map(str, words)], capture_output=True, text=True)
    assert done.returncode == 0, f"{words}: {done.stderr}"


def iou(truth, found):
    """Empty truth and result give nothing."""
    either = (truth | found).sum()
    return (truth & found).sum() / either if either else None


def scans_in(folder):
    return {file.stem: np.fromfile(file, "<f4").reshape(-1, 4)[:, :3].astype(float) for file in sorted(folder.glob("*.bin"))}


def doals(data, work):
    """Points of people by scan, from indices.csv; the scans as a converted folder has them."""
    call("convert", data / "station/sequence_1/bag.bag", work / "scans", "--to", "kitti", "--poses", "none")
    scans = scans_in(work / "scans/velodyne")
    rows = [[int(word) for word in line.split(",")] for line in (data / "station/sequence_1/indices.csv").read_text().split()]
    truth = {}
    for stamp, *people in rows:
        name = f"{round((stamp - 1582196325 * 10**9) / 1e8):06d}"
        truth[name] = np.isin(np.arange(len(scans[name])), people)

    def count(found):
        near, everything = [], []
        for name, moves in truth.items():
            far = np.linalg.norm(scans[name], axis=1)
            part = (far >= .5) & (far <= 20)
            near.append(iou(moves[part], found[name][part]))
            everything.append(iou(moves, found[name]))
        mean = [np.mean([1.0 if one is None else one for one in ious]) for ious in (near, everything)]
        return {"IoU to 20 m": mean[0], "IoU": mean[1]}
    return scans, truth, count


def table(data, name):
    return json.loads((data / f"v1.0-mini/{name}.json").read_text())


def nuscenes(data, work):
    """Boxes that move, of the key frames; they lie along the axes of the world, and the mount is not turned."""
    poses = {row["token"]: row for row in table(data, "ego_pose")}
    mount = np.array(table(data, "calibrated_sensor")[0]["translation"])
    boxes = table(data, "sample_annotation")
    scans, truth = {}, {}
    for row in table(data, "sample_data"):
        name = Path(row["filename"]).name.removesuffix(".bin")
        points = np.fromfile(data / row["filename"], "<f4").reshape(-1, 5)[:, :3].astype(float)
        scans[name] = points
        if not row["is_key_frame"]:
            continue
        w, x, y, z = poses[row["ego_pose_token"]]["rotation"]
        turn = np.array([[1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
                         [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
                         [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)]])
        world = (points + mount) @ turn.T + poses[row["ego_pose_token"]]["translation"]
        moves = np.zeros(len(points), bool)
        for box in boxes:
            if box["sample_token"] == row["sample_token"]:
                width, length, height = box["size"]
                moves |= (np.abs(world - box["translation"]) <= np.array([length, width, height]) / 2).all(axis=1)
        truth[name] = moves

    def count(found):
        pairs = []
        for name, moves in truth.items():
            far = np.linalg.norm(scans[name], axis=1)
            pairs.append((moves[(far >= 3) & (far <= 50)], found[name][(far >= 3) & (far <= 50)]))
        return {"IoU": iou(*map(np.concatenate, zip(*pairs)))}
    return scans, truth, count


def places_of(folder):
    """Positions of the sensor and its turns, by scan: Mercator's projection, scaled at the first latitude."""
    rows = [np.array(file.read_text().split()[:6], float) for file in sorted(folder.glob("*.txt"))]
    scale = EARTH * np.cos(np.radians(rows[0][0]))
    poses = []
    for lat, lon, height, roll, pitch, yaw in rows:
        (a, b), (c, d), (e, f) = ((np.cos(v), np.sin(v)) for v in (roll, pitch, yaw))
        turn = (np.array([[e, -f, 0], [f, e, 0], [0, 0, 1]]) @ np.array([[c, 0, d], [0, 1, 0], [-d, 0, c]])
                @ np.array([[1, 0, 0], [0, a, -b], [0, b, a]]))
        at = np.array([scale * np.radians(lon), scale * np.arcsinh(np.tan(np.radians(lat))), height])
        poses.append((turn, at + turn @ np.array([.81, -.32, .80])))  # from the inertial unit to the sensor
    return poses


def kitti_raw(data, work):
    drive = data / "2011_09_26/2011_09_26_drive_0001_sync"
    scans = scans_in(drive / "velodyne_points/data")
    poses = places_of(drive / "oxts/data")
    tracks = []
    for item in ElementTree.parse(drive / "tracklet_labels.xml").getroot().find("tracklets").findall("item"):
        places = [np.array([float(one.find(axis).text) for axis in ("tx", "ty", "tz")]) for one in item.find("poses").findall("item")]
        first = int(item.find("first_frame").text)
        world = np.array([poses[first + i][0] @ place + poses[first + i][1] for i, place in enumerate(places)])
        farthest = max(np.linalg.norm(world - one, axis=1).max() for one in world)
        size = np.array([float(item.find(side).text) for side in ("l", "w", "h")])
        tracks.append((first, places, size, farthest))
    truth, known = {}, {}
    for number, (name, points) in enumerate(scans.items()):
        far = np.hypot(points[:, 0], points[:, 1])
        known[name] = (far >= 3) & (far <= 60) & (np.abs(np.degrees(np.arctan2(points[:, 1], points[:, 0]))) <= 40)
        moves = np.zeros(len(points), bool)
        for first, places, size, farthest in tracks:
            if not first <= number < first + len(places) or farthest <= .75:
                continue
            beside = np.abs(points - places[number - first] - [0, 0, size[2] / 2]) - size / 2
            outside, low = beside.max(axis=1), points[:, 2] - places[number - first][2]
            inside = (outside <= 0) & (low > .2) if farthest > 1.5 else np.zeros(len(points), bool)
            moves |= inside & known[name]
            known[name] &= inside | (outside > .2)
        truth[name] = moves

    def count(found):
        pairs = [(truth[name][part], found[name][part]) for name, part in known.items()]
        return {"IoU": iou(*map(np.concatenate, zip(*pairs)))}
    return scans, truth, count


def differing(arena, entry, layout, work):
    data = work / arena
    call("bench", arena, data, "--twin", "--only", entry)
    scans, truth, count = layout(data, work)
    rng, faults = np.random.default_rng(1), []
    for case in range(CASES):
        wrong = rng.uniform(.02, .2)
        found = {name: truth.get(name, np.zeros(len(points), bool)) ^ (rng.random(len(points)) < wrong) for name, points in scans.items()}
        labels = work / f"{arena}-{case}"
        (labels / entry).mkdir(parents=True)
        for name, dynamic in found.items():
            np.where(dynamic, 251, 9).astype("<u4").tofile(labels / entry / f"{name}.label")
        call("bench", arena, data, "-o", work / f"{arena}-out", "--no-run", "--peer", f"case {case}={labels}", "-q")
        rows = json.loads((work / f"{arena}-out/table.json").read_text())["rows"]
        scores = next(row["scores"] for row in rows if row["method"] == f"case {case}" and row["entry"] == entry)
        for key, value in count(found).items():
            if abs(scores[key] - value) > 1e-9:
                faults.append(f"{arena}, case {case}, {key}: {scores[key]}, counted {value}")
    print(f"{arena}: {CASES} cases, {len(faults)} differ")
    return faults


def main():
    with tempfile.TemporaryDirectory() as scratch:
        faults = [fault for arena, entry, layout in (("doals", "station/sequence_1", doals), ("nuscenes", "scene-0061", nuscenes),
                                                     ("kitti-raw", "0001", kitti_raw))
                  for fault in differing(arena, entry, layout, Path(scratch))]
    return "\n".join(faults) or None


if __name__ == "__main__":
    sys.exit(main())
