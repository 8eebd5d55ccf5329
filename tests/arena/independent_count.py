# SPDX-License-Identifier: MIT
"""A second, independent count of the scores that `dynamicfilter bench` gives to the results of others.

    independent_count.py COMMAND [CASES]

For each arena some small random data sets (4) are written in their authors' layout, with a result that is the truth with some of its labels
turned round. The command scores the result (bench ARENA DATA -o OUT --no-run --peer twin=LABELS --only ENTRY), and every score in
OUT/table.json must be the one that is counted here, with numpy alone. The rules are those of the authors' papers and public scripts:

- erasor, erasor2: analysis.py and mapgen of ERASOR, evaluate.py of ERASOR2: PR, RR and F1 by nearest neighbours of thinned maps;
- strict: evaluate_tools of FreeDOM: PR, RR and F1 by voxels;
- dynamicmap: export_eval_pcd and evaluate_all.py of KTH's DynamicMap_Benchmark: SA, DA, AA and HA by points;
- mos: evaluate_mos.py of semantic-kitti-api: IoU of moving points;
- helimos: the same IoU, over all labelled scans and over those of test.txt, and KTH's rule;
- moe: IoU of moving points.

Scores of points and voxels must agree to 1e-6. ERASOR's rule thins with means that its authors take in float32, so PR and RR may
differ there by two points of the total each, and F1 by what follows from that. The scenes stay clear of what rounding decides:
borders of voxels, limits of range, the limit of 5 cm, and centroids as far from a static as from a dynamic point. The arena doals is
not counted: its scans are in bags.
"""
import json
import pathlib
import subprocess
import sys
import tempfile
from dataclasses import dataclass

import numpy as np

CASES = int(sys.argv[2]) if len(sys.argv) > 2 else 4
METHOD = "twin"
ALLOWED = 1e-6
ALLOWED_POINTS = 2  # of the total, in ERASOR's rule only: its thinning takes means in float32

VOXEL = 0.2
BODY = 2.7  # metres: nearer points are the own vehicle's
PAIR_LIMIT = VOXEL * np.sqrt(3) / 2
KEPT_LIMIT = 0.05

# First scan, end, step.
WINDOWS = {"01": (150, 250, 1), "02": (860, 950, 2), "07": (630, 820, 2)}
R_ORIGIN = np.array([[0, 0, 1, 0], [-1, 0, 0, 0], [0, -1, 0, 0], [0, 0, 0, 1.0]])
CAM2BASE = np.array([
    [-1.857739385241e-03, -9.999659513510e-01, -8.039975204516e-03, -4.784029760483e-03],
    [-6.481465826011e-03, 8.051860151134e-03, -9.999466081774e-01, -7.337429464231e-02],
    [9.999773098287e-01, -1.805528627661e-03, -6.496203536139e-03, -3.339968064433e-01],
    [0, 0, 0, 1]])
LIFT = np.array([[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 1.73], [0, 0, 0, 1]])
# The camera of the data sets written here; unlike CAM2BASE on purpose, so that a swap of the two shows.
TR = np.array([[0.02, -0.9998, 0, 0.11], [-0.05, -0.001, -0.99875, -0.28], [0.99855, 0.02, -0.05, -0.42], [0, 0, 0, 1]])
# The nearest rotation, exact: whether the inverse or the transpose is taken must not matter.
TR[:3, :3] = np.linalg.svd(TR[:3, :3])[0] @ np.linalg.svd(TR[:3, :3])[2]

STATIC_CLASSES = [9, 10, 40, 44, 48, 50, 70, 72, 80, 99]


@dataclass
class Scan:
    """points are the sensor's; pose takes them to the map; found tells what the result labels dynamic."""
    number: int
    points: np.ndarray
    classes: np.ndarray
    found: np.ndarray
    pose: np.ndarray

    def on_map(self):
        return moved(self.pose, self.points)

    def take(self, mask):
        return Scan(self.number, self.points[mask], self.classes[mask], self.found[mask], self.pose)


def moved(pose, points):
    return points.astype(float) @ pose[:3, :3].T + pose[:3, 3]


# ---------------------------------------------------------------- counts

def nearest(queries, cloud, reach):
    """Distance and index of the nearest point of the cloud; infinite and -1 if it is farther than reach.

    Compares with every point in a slice along x.
    """
    distance, index = np.full(len(queries), np.inf), np.full(len(queries), -1)
    order, turn = np.argsort(cloud[:, 0]), np.argsort(queries[:, 0])
    cloud = cloud[order]
    for rows in np.array_split(turn, len(turn) // 64 + 1):
        part = queries[rows]
        if not len(part):
            continue
        begin, end = np.searchsorted(cloud[:, 0], [part[0, 0] - reach, part[-1, 0] + reach])
        if begin == end:
            continue
        apart = sum((part[:, None, axis] - cloud[None, begin:end, axis]) ** 2 for axis in range(3))
        best = apart.argmin(axis=1)
        distance[rows] = np.sqrt(apart[np.arange(len(rows)), best])
        index[rows] = order[begin + best]
    index[distance > reach] = -1
    distance[distance > reach] = np.inf
    return distance, index


def share(part, whole):
    return part / whole if whole else None


def harmonic_mean(a, b):
    return 2 * a * b / (a + b) if a is not None and b is not None and a + b else None


def within(scores, allowed=ALLOWED):
    return {key: (value, allowed) for key, value in scores.items()}


def moving(classes):
    return (classes >= 251) & (classes <= 259)


def iou(truth, found):
    return share((truth & found).sum(), (truth | found).sum())


def thin(points, dynamic, doubts):
    """Centroids of the voxels; each is of the kind of the point nearest to it, whichever voxel that is in."""
    _, member, count = np.unique(np.floor(points / VOXEL).astype(int), axis=0, return_inverse=True, return_counts=True)
    sums = [np.bincount(member.ravel(), points[:, axis], len(count)) for axis in range(3)]
    centroids = np.stack(sums, axis=1) / count[:, None]
    doubts.append(undecided(centroids, points, dynamic))
    # A centroid is within its voxel, and so is at least one point: nearer than the voxel's diagonal.
    return centroids, dynamic[nearest(centroids, points, 2 * VOXEL)[1]]


def undecided(places, points, dynamic):
    """The places that are as far from a static as from a dynamic point: rounding would choose their kind."""
    to_static, to_dynamic = (nearest(places, points[kind], 2 * VOXEL)[0] for kind in (~dynamic, dynamic))
    both = np.isfinite(to_static) & np.isfinite(to_dynamic)
    places, to_static, to_dynamic = places[both], to_static[both], to_dynamic[both]
    return places[np.abs(to_static - to_dynamic) < 1e-4]


def joined(parts):
    return tuple(np.concatenate(column) for column in zip(*parts))


def outside_body(scan):
    return scan.take(np.hypot(*scan.points[:, :2].astype(float).T) >= BODY)


def erasor_map(scans, is_dynamic, doubts):
    """Thinned scan by scan, then as a whole, both in the frame of the map."""
    parts = [thin(scan.on_map(), is_dynamic(scan.classes), doubts) for scan in scans if len(scan.points)]
    return thin(*joined(parts), doubts)


def erasor_scores(truth, clean):
    (points, dynamic), (clean_points, clean_dynamic) = truth, clean
    distance, index = nearest(points, clean_points, 2 * VOXEL)
    kept = (distance < PAIR_LIMIT) & (clean_dynamic[index] == dynamic)
    statics, dynamics = (~dynamic).sum(), dynamic.sum()
    return pr_rr(share((kept & ~dynamic).sum(), statics), share((~kept & dynamic).sum(), dynamics),
                 share(ALLOWED_POINTS, statics), share(ALLOWED_POINTS, dynamics))


def pr_rr(pr, rr, pr_allowed=0, rr_allowed=0):
    f1 = harmonic_mean(pr, rr)
    corners = [harmonic_mean(pr + a * pr_allowed, rr + b * rr_allowed) - f1 for a in (-1, 1) for b in (-1, 1)]
    allowed = ALLOWED + np.array([pr_allowed, rr_allowed, np.abs(corners).max()])
    return dict(zip(("PR", "RR", "F1"), zip((pr, rr, f1), allowed)))


def cells(points):
    return set(map(tuple, np.floor(points / VOXEL).astype(int).tolist()))


def strict_part(scan):
    """What is in range and has a label."""
    distance = np.linalg.norm(scan.points.astype(float), axis=1)
    return scan.take((distance >= BODY) & (distance <= 1000) & (scan.classes > 1))


def strict_scores(points, dynamic, clean_points):
    static_cells, kept = cells(points[~dynamic]), cells(clean_points)
    dynamic_cells = cells(points[dynamic]) - static_cells
    return pr_rr(share(len(static_cells & kept), len(static_cells)), share(len(dynamic_cells - kept), len(dynamic_cells)))


def kth_scores(points, dynamic, clean_points):
    kept = nearest(points, clean_points, 2 * KEPT_LIMIT)[0] <= KEPT_LIMIT
    sa, da = share((kept & ~dynamic).sum(), (~dynamic).sum()), share((~kept & dynamic).sum(), dynamic.sum())
    return {"SA": sa, "DA": da, "AA": np.sqrt(sa * da), "HA": harmonic_mean(sa, da)}


def mos_score(scans):
    """Truth without a label (0, 1) is not counted."""
    classes, found = (np.concatenate([getattr(scan, name) for scan in scans]) for name in ("classes", "found"))
    return iou(moving(classes[classes > 1]), found[classes > 1])


# ---------------------------------------------------------------- checks of the counts, by hand

def check_nearest():
    rng = np.random.default_rng(1)
    queries, cloud = rng.uniform(-1, 1, (300, 3)), rng.uniform(-1, 1, (200, 3))
    apart = np.linalg.norm(queries[:, None] - cloud, axis=2)
    near = apart.min(axis=1) <= 0.2
    distance, index = nearest(queries, cloud, 0.2)
    assert 20 < near.sum() < 280 and np.allclose(distance[near], apart.min(axis=1)[near]) and np.isinf(distance[~near]).all()
    assert (index == np.where(near, apart.argmin(axis=1), -1)).all()


def check_erasor():
    # Two static points have their centroid at (0.1, 0.15, 0.1). The dynamic point of the next voxel is nearer to it than they are.
    points = np.array([[0.01, 0.15, 0.1], [0.19, 0.15, 0.1], [0.1, 0.21, 0.1], [-0.01, 0.5, 0.1], [0.5, 0.5, 0.1]])
    centroids, dynamic = thin(points, np.array([False, False, True, True, False]), [])
    assert np.allclose(centroids, [[-0.01, 0.5, 0.1], [0.1, 0.15, 0.1], [0.1, 0.21, 0.1], [0.5, 0.5, 0.1]])
    assert dynamic.tolist() == [True, True, True, False]
    # Without it they are the nearest; as near as each other, but of one kind.
    assert thin(points[[0, 1, 3, 4]], np.array([False, False, True, False]), [])[1].tolist() == [True, False, False]
    doubts = []
    thin(points[:2], np.array([False, True]), doubts)
    assert np.allclose(doubts, [[[0.1, 0.15, 0.1]]])
    # Kept; too far; nearest of the other kind; a dynamic one kept; a dynamic one gone.
    truth = np.array([[0, 0, 0], [1, 0, 0], [2, 0, 0], [3, 0, 0], [4, 0, 0.0]]), np.array([False, False, False, True, True])
    clean = np.array([[0.1732, 0, 0], [1, 0.1733, 0], [2, 0, 0.1], [3, 0, 0.1], [4, 0.1, 0]]), np.array([False, False, True, True, False])
    scores = erasor_scores(truth, clean)
    assert np.allclose([scores["PR"][0], scores["RR"][0], scores["F1"][0]], [1 / 3, 1 / 2, 0.4])


def check_others():
    points = np.array([[0.1, 0.1, 0.1], [0.15, 0.1, 0.1], [-0.1, 0.1, 0.1], [0.5, 0, 0], [0.7, 0, 0], [0.9, 0, 0]])
    dynamic = np.array([False, True, True, False, True, True])
    scores = strict_scores(points, dynamic, np.array([[0.19, 0.01, 0.01], [0.71, 0.1, 0.1]]))
    assert np.allclose([scores["PR"][0], scores["RR"][0]], [1 / 2, 2 / 3])
    scores = kth_scores(points, dynamic, np.array([[0.1, 0.1, 0.0501], [0.7, 0.0499, 0]]))
    assert np.allclose(list(scores.values()), [1 / 2, 3 / 4, np.sqrt(3 / 8), 0.6])
    scan = Scan(0, None, np.array([0, 1, 9, 9, 40, 251, 259, 255]), np.array([1, 0, 0, 1, 0, 1, 0, 1], bool), None)
    assert mos_score([scan]) == 2 / 4 and moving(np.array([250, 251, 259, 260])).tolist() == [False, True, True, False]


# ---------------------------------------------------------------- scenes

def rotation(axis, angle):
    c, s = np.cos(angle), np.sin(angle)
    turn = np.eye(4)
    a, b = [(1, 2), (2, 0), (0, 1)][axis]
    turn[[a, a, b, b], [a, b, a, b]] = c, -s, s, c
    return turn


def drive(rng, count, first=0):
    """Poses of a sensor that moves 0.3 m from scan to scan along a weakly bent road, near the origin at the scan `first`."""
    start, heading, poses = rng.uniform(-4, 4, 3), rng.uniform(-3, 3), []
    for way in 0.3 * (np.arange(count) - first):
        pose = rotation(2, heading + 0.15 * np.sin(0.2 * way)) @ rotation(1, 0.02 * np.sin(way)) @ rotation(0, 0.03 * np.cos(way))
        pose[:3, 3] = start + [way * np.cos(heading), way * np.sin(heading), 0.05 * np.sin(0.5 * way)]
        poses.append(pose)
    return poses


def draw_world(rng, poses, size):
    """Flat sheets beside the road, and boxes that pace to and fro; four of them along a small sheet, so that kinds mix in voxels."""
    def beside():
        pose = poses[rng.integers(len(poses))]
        return moved(pose, np.array([[rng.uniform(-3, 3), rng.choice([-1, 1]) * rng.uniform(3.5, 7), rng.uniform(-1.5, 2)]]))[0]
    sheets, boxes = [], []
    for number in range(10):
        across = np.linalg.qr(rng.normal(size=(3, 2)))[0].T * rng.uniform(0.7, 1.3, (2, 1)) * (size / 2 if number < 4 else size)
        sheets.append((beside(), across, rng.choice(STATIC_CLASSES)))
    for number, label in enumerate([258, 252, 251, rng.integers(253, 260), 1]):
        centre, way = (sheets[number][0], sheets[number][1][0] / 2) if number < 4 else (beside(), rng.normal(size=3) * [2, 2, 0])
        boxes.append((centre, way, rng.uniform(0.3, 0.7, 3) * min(size, 1.5), label, rng.uniform(0, 6)))
    return sheets, boxes


def look(rng, world, number, count):
    """Points on the sheets and in the boxes at the time of a scan, in the frame of the map, and their classes."""
    sheets, boxes = world
    points, classes = [], []
    for _ in range(count):
        if rng.random() < 0.7:
            centre, across, label = sheets[rng.integers(len(sheets))]
            points.append(centre + rng.uniform(-0.5, 0.5, 2) @ across + rng.normal(size=3) * 0.01)
            classes.append(label if rng.random() > 0.04 else rng.integers(2))
        else:
            centre, way, size, label, phase = boxes[rng.integers(len(boxes))]
            points.append(centre + way * np.sin(0.15 * number + phase) + rng.uniform(-0.5, 0.5, 3) * size)
            classes.append(label)
    return np.array(points), np.array(classes)


def about_the_body(rng, count):
    """Points by the sensor: all nearer than the limit horizontally, some of them farther in space."""
    angle, radius = rng.uniform(0, 2 * np.pi, count), rng.uniform(0.5, 2.6, count)
    points = np.stack([radius * np.cos(angle), radius * np.sin(angle), rng.uniform(-3, 3, count)], axis=1)
    return points, rng.choice([40, 50, 252, 258, 0], count)


def take_scan(rng, world, number, pose, count, turned, near=0, far=0):
    """A scan and its result; the share `turned` of the result's labels is wrong. far: points beyond a kilometre."""
    points, classes = look(rng, world, number, count)
    points = moved(np.linalg.inv(pose), points)
    body, body_classes = about_the_body(rng, near)
    beyond = np.array([[1500, 20, 10.0]]) + rng.uniform(-100, 100, (far, 3))
    points = np.concatenate([points, body, beyond]).astype(np.float32)
    classes = np.concatenate([classes, body_classes, np.full(far, 50)])
    order = rng.permutation(len(points))
    points, classes = points[order], classes[order]
    return Scan(number, points, classes, moving(classes) ^ (rng.random(len(points)) < turned), pose)


def clear_of_limits(scan):
    """Without points that rounding could put into another voxel or out of range."""
    cell = scan.on_map() / VOXEL
    safe = np.abs(cell - np.round(cell)).min(axis=1) * VOXEL > 5e-4
    for distance in np.hypot(*scan.points[:, :2].T), np.linalg.norm(scan.points, axis=1):
        safe &= np.abs(distance - BODY) > 1e-3
    # Beyond a kilometre float32 cannot stay clear of borders, and no point counts.
    return scan.take(safe | (np.linalg.norm(scan.points, axis=1) > 1100))


def clear_of_kept_limit(points, found):
    """A result of which no point is about 5 cm from the nearest point that it keeps: such points are kept instead."""
    while True:
        distance = nearest(points, points[~found], 2 * KEPT_LIMIT)[0]
        close = np.abs(distance - KEPT_LIMIT) < 3e-4
        if not close.any():
            return found
        found = found & ~close


# ---------------------------------------------------------------- files

def write_poses(path, poses):
    path.parent.mkdir(parents=True, exist_ok=True)
    np.savetxt(path, [pose[:3].ravel() for pose in poses], fmt="%.17g")


def write_calibration(path, tr):
    row = " ".join(f"{value:.17g}" for value in tr[:3].ravel())
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(f"P0: 700 0 600 0 0 700 180 0 0 0 1 0\nTr: {row}\n")


def write_labels(path, values):
    path.parent.mkdir(parents=True, exist_ok=True)
    values.astype("<u4").tofile(path)


def write_scan(rng, folder, scan, labelled=True):
    """A scan and its truth; the upper half of a label is the number of the object."""
    for name in "velodyne", "labels":
        (folder / name).mkdir(parents=True, exist_ok=True)
    rows = np.column_stack([scan.points, rng.uniform(0, 1, len(scan.points))]).astype("<f4")
    rows.tofile(folder / "velodyne" / f"{scan.number:06d}.bin")
    if labelled:
        write_labels(folder / "labels" / f"{scan.number:06d}.label", scan.classes + (rng.integers(0, 9, len(rows)) << 16))


def write_result(labels, entry, scan):
    write_labels(labels / entry / f"{scan.number:06d}.label", np.where(scan.found, 251, 9))


def write_pcd(path, points, intensity=None, viewpoint=(0, 0, 0, 1, 0, 0, 0)):
    rows = points if intensity is None else np.column_stack([points, intensity])
    width = rows.shape[1]
    header = ["# .PCD v0.7 - Point Cloud Data file format", "VERSION 0.7", "FIELDS " + " ".join("x y z intensity".split()[:width]),
              "SIZE" + " 4" * width, "TYPE" + " F" * width, "COUNT" + " 1" * width, f"WIDTH {len(rows)}", "HEIGHT 1",
              "VIEWPOINT " + " ".join(f"{value:.9g}" for value in viewpoint), f"POINTS {len(rows)}", "DATA binary", ""]
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_bytes("\n".join(header).encode() + rows.astype("<f4").tobytes())


# ---------------------------------------------------------------- cases: each writes a data set and a result, and counts

def kitti_scans(rng, entry, count, frame, size, far=0):
    """Scans of a window and two before and behind it, and the poses from scan 0; `frame` makes the way to the map from P_cam."""
    first, end, _ = WINDOWS[entry]
    road = drive(rng, end + 3, first)
    cameras = [R_ORIGIN.T @ pose @ R_ORIGIN for pose in road]
    world = draw_world(rng, road[first:end:4], size)
    turned = rng.uniform(0.1, 0.2)
    # Scans next to the window and at its end have more points, so that it shows if they are counted by mistake, or are not.
    scans = [take_scan(rng, world, number, frame(cameras[number]), count * (1 if first <= number < end else 4), turned, count // 15, far)
             for number in range(first - 2, end + 3)]
    return [clear_of_limits(scan) for scan in scans], cameras


def in_window(scans, entry, inclusive):
    first, end, step = WINDOWS[entry]
    numbers = range(first, end + inclusive, step)
    return [scan for scan in scans if scan.number in numbers]


def write_kitti(rng, data, labels, entry, scans, cameras):
    folder = data / "sequences" / entry
    write_poses(folder / "poses.txt", cameras)
    write_calibration(folder / "calib.txt", TR)
    for scan in scans:
        write_scan(rng, folder, scan)
        if labels:
            write_result(labels, entry, scan)


def erasor_frame(camera):
    return R_ORIGIN @ camera @ CAM2BASE @ LIFT


def lidar_frame(camera):
    return np.linalg.inv(TR) @ camera @ TR


def without_doubts(scans, entry, inclusive, is_dynamic):
    """Takes away the dynamic point next to each centroid whose kind rounding would choose, until there is none. Then the two maps."""
    for _ in range(100):
        used, doubts = [outside_body(scan) for scan in in_window(scans, entry, inclusive)], []
        truth = erasor_map(used, is_dynamic, doubts)
        clean = erasor_map([scan.take(~scan.found) for scan in used], is_dynamic, doubts)
        doubts.append(undecided(truth[0], *clean))
        places = np.concatenate(doubts)
        if not len(places):
            return scans, truth, clean
        scans = without_nearest(scans, used, places, is_dynamic)
    raise RuntimeError("the scene leaves too much to rounding")


def without_nearest(scans, used, places, is_dynamic):
    movers = np.concatenate([scan.on_map()[is_dynamic(scan.classes)] for scan in used])
    gone = movers[nearest(places, movers, 1.0)[1]]
    # A point is known by its place: the same numbers give the same place again.
    return [scan.take(~(scan.on_map()[:, None] == gone).all(axis=2).any(axis=1)) for scan in scans]


def map_of_erasor(rng, scans, entry, inclusive, is_dynamic, truth):
    """A clean map as a program would write it: a part of the thinned map. The nearest raw point has the label that it carries."""
    used = [outside_body(scan) for scan in in_window(scans, entry, inclusive)]
    raw, raw_dynamic = joined([(scan.on_map(), is_dynamic(scan.classes)) for scan in used])
    points, dynamic = truth
    same = raw_dynamic[nearest(points, raw, 2 * VOXEL)[1]] == dynamic
    stays = np.where(dynamic, rng.random(len(points)) < 0.15, rng.random(len(points)) < 0.8)
    return points[same & stays].astype(np.float32), dynamic[same & stays]


def erasor_case(rng, case, data, labels, inclusive=False, static_class=None):
    def is_dynamic(classes):
        return moving(classes) & (classes != static_class)
    entry, as_map = ("01", "02")[case % 2], case >= 7
    scans, cameras = kitti_scans(rng, entry, 100 if entry == "01" else 150, erasor_frame, 5.0)
    scans, truth, clean = without_doubts(scans, entry, inclusive, is_dynamic)
    if as_map:
        points, dynamic = map_of_erasor(rng, scans, entry, inclusive, is_dynamic, truth)
        write_pcd(labels / f"{entry}.pcd", points, np.where(dynamic, 252, 40))
        clean = points.astype(float), dynamic
    write_kitti(rng, data, None if as_map else labels, entry, scans, cameras)
    return entry, erasor_scores(truth, clean)


def erasor2_case(rng, case, data, labels):
    """The window's end is scored too, and class 258 (moving truck) is static."""
    return erasor_case(rng, case, data, labels, inclusive=True, static_class=258)


def strict_case(rng, case, data, labels):
    entry, as_map = ("02", "07")[case % 2], case >= 7
    scans, cameras = kitti_scans(rng, entry, 150 if entry == "02" else 80, lidar_frame, 3.0, far=1)
    used = [strict_part(scan) for scan in in_window(scans, entry, False)]
    points, dynamic, found = joined([(scan.on_map(), moving(scan.classes), scan.found) for scan in used])
    clean = points[~found]
    if as_map:
        clean = clean[rng.random(len(clean)) < 0.8].astype(np.float32)
        write_pcd(labels / f"{entry}.pcd", clean)
    write_kitti(rng, data, None if as_map else labels, entry, scans, cameras)
    return entry, strict_scores(points, dynamic, clean.astype(float))


def dynamicmap_kitti_case(rng, case, data, labels):
    """Points up to 50 m. What is unlabelled within 3 m is the vehicle, which moves; elsewhere it is static."""
    entry = ("01", "02")[case % 2]
    scans, cameras = kitti_scans(rng, entry, 60, lidar_frame, 1.5)
    ranges = [np.linalg.norm(scan.points.astype(float), axis=1) for scan in scans]
    scans = [scan.take((np.abs(r - 3) > 1e-3) & (np.abs(r - 50) > 1e-3)) for scan, r in zip(scans, ranges)]
    first, end, _ = WINDOWS[entry]
    used = [scan for scan in scans if first <= scan.number <= end]
    ranges = [np.linalg.norm(scan.points.astype(float), axis=1) for scan in used]
    points, dynamic, found = joined([(scan.on_map()[r < 50], (moving(scan.classes) | ((scan.classes < 2) & (r < 3)))[r < 50],
                                      scan.found[r < 50]) for scan, r in zip(used, ranges)])
    found = clear_of_kept_limit(points, found)
    for scan, r, part in zip(used, ranges, np.split(found, np.cumsum([(r < 50).sum() for r in ranges])[:-1])):
        scan.found[r < 50] = part
    write_kitti(rng, data, labels, entry, scans, cameras)
    return entry, within(kth_scores(points, dynamic, points[~found]))


def viewpoint(pose):
    """tx ty tz qw qx qy qz. The sensor turns about its z mostly: the largest part of the quaternion is w or z."""
    x, y, z = pose[:3, 3]
    r = pose[:3, :3]
    w, k = np.sqrt(max(0, 1 + np.trace(r))) / 2, np.sqrt(max(0, 1 - r[0, 0] - r[1, 1] + r[2, 2])) / 2
    if w > 0.5:
        return x, y, z, w, (r[2, 1] - r[1, 2]) / 4 / w, (r[0, 2] - r[2, 0]) / 4 / w, (r[1, 0] - r[0, 1]) / 4 / w
    return x, y, z, (r[1, 0] - r[0, 1]) / 4 / k, (r[0, 2] + r[2, 0]) / 4 / k, (r[2, 1] + r[1, 2]) / 4 / k, k


def map_of_kth(rng, points, found):
    """A clean map whose points are not quite those of the scans."""
    clean = points[~found].astype(float) + rng.normal(size=((~found).sum(), 3)) * 0.02
    while True:
        clean = clean.astype(np.float32).astype(float)
        close = np.abs(nearest(points, clean, 2 * KEPT_LIMIT)[0] - KEPT_LIMIT) < 3e-4
        if not close.any():
            return clean
        clean = np.concatenate([clean, points[close]])


def kth_scans(rng, numbers, count):
    """Scans in the frame of the world, as the benchmark writes them, and the sensor's poses."""
    poses, turned = drive(rng, len(numbers)), rng.uniform(0.1, 0.2)
    world = draw_world(rng, poses, 1.3)
    return [take_scan(rng, world, number, np.eye(4), count, turned) for number in numbers], poses


def dynamicmap_case(rng, case, data, labels):
    entry, as_map = ("00", "01", "05", "av2", "semindoor")[case % 5], case >= 7
    first, last = {"00": (4390, 4399), "01": (147, 254), "05": (2350, 2361)}.get(entry, (0, 11))
    scans, poses = kth_scans(rng, range(first, last + 1), 30 if entry == "01" else 220)
    used = [scan for scan in scans if entry != "01" or 150 <= scan.number <= 250]
    points, dynamic, found = joined([(scan.on_map(), moving(scan.classes), scan.found) for scan in used])
    found = clear_of_kept_limit(points, found)
    for scan, part in zip(used, np.split(found, np.cumsum([len(scan.points) for scan in used])[:-1])):
        scan.found = part
    clean = map_of_kth(rng, points, found) if as_map else points[~found]
    write_dynamicmap(data / entry, scans, poses)
    if as_map:
        write_pcd(labels / f"{entry}.pcd", clean)
    else:
        for scan in scans:
            write_result(labels, entry, scan)
    return entry, within(kth_scores(points, dynamic, clean))


def write_dynamicmap(folder, scans, poses):
    """The truth holds all points of all scans, in order."""
    for scan, pose in zip(scans, poses):
        write_pcd(folder / "pcd" / f"{scan.number:06d}.pcd", scan.points, moving(scan.classes), viewpoint(pose))
    write_pcd(folder / "gt_cloud.pcd", *joined([(scan.points, moving(scan.classes)) for scan in scans]))


def short_drive(rng, scans, count, size, frame):
    road, turned = drive(rng, scans), rng.uniform(0.1, 0.2)
    cameras = [R_ORIGIN.T @ pose @ R_ORIGIN for pose in road]
    world = draw_world(rng, road, size)
    return [take_scan(rng, world, number, frame(cameras[number]), count, turned, near=5) for number in range(scans)], cameras


def mos_case(rng, case, data, labels):
    """In the odd cases the result uses other labels too: 251 to 259 are moving, all others are not."""
    scans, cameras = short_drive(rng, 20, 150, 3.0, lidar_frame)
    write_kitti(rng, data, labels, "08", scans, cameras)
    if case % 2:
        for scan in scans:
            values = np.where(scan.found, rng.integers(251, 260, len(scan.found)), rng.choice([0, 9, 40, 250, 260], len(scan.found)))
            write_labels(labels / "08" / f"{scan.number:06d}.label", values)
    return "08", within({"IoU": mos_score(scans)})


def helimos_scan(scan):
    """Labels 0, 9 and 251 only."""
    scan.classes = np.where(scan.classes < 2, 0, np.where(moving(scan.classes), 251, 9))
    return scan


def without_close_unlabelled(scans):
    """Without unlabelled points by others: so it makes no difference whether the clean map holds them."""
    known = np.concatenate([scan.on_map()[scan.classes > 0] for scan in scans])
    return [scan.take((scan.classes > 0) | ~np.isfinite(nearest(scan.on_map(), known, 0.1)[0])) for scan in scans]


def helimos_case(rng, case, data, labels):
    """Unlabelled points count neither for the IoU nor as points of the static or dynamic truth."""
    entry, root = ("Aeva", "Avia", "Ouster", "Velodyne")[case % 4], data / "Deskewed_LiDAR"
    scans, poses = short_drive(rng, 16, 200, 1.3, lambda camera: R_ORIGIN @ camera @ R_ORIGIN.T)
    scans = without_close_unlabelled([helimos_scan(scan) for scan in scans])
    numbers = rng.permutation(16)
    labelled, test = set(numbers[:11].tolist()), set(numbers[6:14].tolist())
    used = [scan for scan in scans if scan.number in labelled]
    points, classes, found = joined([(scan.on_map(), scan.classes, scan.found) for scan in used])
    found = clear_of_kept_limit(points, found)
    for scan, part in zip(used, np.split(found, np.cumsum([len(scan.points) for scan in used])[:-1])):
        scan.found = part
    write_helimos(rng, root, entry, scans, labelled, test)
    for scan in scans:
        write_result(labels, entry, scan)
    scores = kth_scores(points[classes > 0], classes[classes > 0] == 251, points[~found])
    del scores["HA"]
    scores["IoU test"] = mos_score([scan for scan in used if scan.number in test])
    scores["IoU"] = mos_score(used)
    return entry, within(scores)


def write_helimos(rng, root, entry, scans, labelled, test):
    write_calibration(root / entry / "calib.txt", np.eye(4))
    write_poses(root / entry / "poses.txt", [scan.pose for scan in scans])
    for scan in scans:
        write_scan(rng, root / entry, scan, scan.number in labelled)
    others = [scan.number for scan in scans if scan.number not in test]
    for name, numbers in ("train", others[2:]), ("val", others[:2]), ("test", sorted(test)):
        (root / f"{name}.txt").write_text("".join(f"{number}\n" for number in numbers))


def moe_case(rng, case, data, labels):
    entry = f"{case % 5:02d}"
    scans, poses = short_drive(rng, 15, 150, 3.0, lambda camera: R_ORIGIN @ camera @ R_ORIGIN.T)
    write_poses(data / entry / "gt_poses.txt", [scan.pose for scan in scans])
    truth = []
    for scan in scans:
        truth.append(moving(scan.classes))
        write_pcd(data / entry / "pcd" / f"{scan.number:06d}.pcd", scan.points)
        write_moe_labels(rng, data / entry / "label" / f"{scan.number:06d}.txt", truth[-1])
        write_result(labels, entry, scan)
    return entry, within({"IoU": iou(np.concatenate(truth), np.concatenate([scan.found for scan in scans]))})


def write_moe_labels(rng, path, truth):
    """Moveable, moving, class; what could move often does not, and the class is -1 unless it moves."""
    moveable = truth | (rng.random(len(truth)) < 0.3)
    path.parent.mkdir(parents=True, exist_ok=True)
    np.savetxt(path, np.column_stack([moveable, truth, np.where(truth, rng.integers(0, 4, len(truth)), -1)]), fmt="%d")


# ---------------------------------------------------------------- comparison

ARENAS = {"erasor": erasor_case, "erasor2": erasor2_case, "strict": strict_case,
          "dynamicmap-kitti": dynamicmap_kitti_case, "dynamicmap": dynamicmap_case,
          "mos": mos_case, "helimos": helimos_case, "moe": moe_case}


def table_of(command, arena, data, labels, out, entry):
    """The scores of the row for our result."""
    words = [*command, "bench", arena, data, "-o", out, "--no-run", "--peer", f"{METHOD}={labels}", "--only", entry]
    done = subprocess.run([str(word) for word in words], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, errors="replace")
    if done.returncode:
        last = " / ".join(done.stdout.strip().splitlines()[-2:])
        raise ValueError(f"the command ends with {done.returncode}: {last}")
    try:
        table = json.loads((out / "table.json").read_text())
        rows = [row["scores"] for row in table["rows"] if (row["entry"], row["method"]) == (entry, METHOD)]
    except (OSError, KeyError, TypeError, json.JSONDecodeError) as fault:
        raise ValueError(f"table.json cannot be used: {fault!r}") from fault
    if table.get("arena") != arena or len(rows) != 1:
        raise ValueError(f"table.json is for the arena {table.get('arena')} and has {len(rows)} rows for {METHOD}, not one")
    return rows[0]


def differences(counted, scores):
    """What differs, as text, and the largest difference among what does not."""
    faults, largest = [], 0
    for key, (value, allowed) in counted.items():
        other = scores.get(key)
        if not isinstance(other, (int, float)):
            faults.append(f"{key} is {other if key in scores else 'missing'} in the table, {value:.8f} here")
        elif not abs(other - value) <= allowed:
            faults.append(f"{key} is {other:.8f} in the table, {value:.8f} here (allowed: {allowed:.1e})")
        else:
            largest = max(largest, abs(other - value))
    return faults, largest


def try_case(command, arena, case):
    rng = np.random.default_rng([list(ARENAS).index(arena), case])
    with tempfile.TemporaryDirectory() as folder:
        data, labels, out = (pathlib.Path(folder, name) for name in ("data", "labels", "out"))
        labels.mkdir()
        entry, counted = ARENAS[arena](rng, case, data, labels)
        easy = [key for key, (value, _) in counted.items() if value is None or not 0 < value < 1]
        assert not easy, f"{arena}, case {case}: the scene does not test {easy}"
        try:
            faults, largest = differences(counted, table_of(command, arena, data, labels, out, entry))
        except ValueError as fault:
            faults, largest = [str(fault)], 0
    return [f"  case {case}, entry {entry}: {fault}" for fault in faults], len(counted), largest


def try_arena(command, arena):
    """Prints one line, and one more for each score that differs. True if none does."""
    faults, scores, largest = [], 0, 0
    for case in range(CASES):
        found, count, apart = try_case(command, arena, case)
        faults, scores, largest = faults + found, scores + count, max(largest, apart)
    verdict = f"{len(faults)} faults:" if faults else f"all agree (largest difference {largest:.1e})"
    print("\n".join([f"{arena}: {CASES} cases, {scores} scores, {verdict}", *faults]), flush=True)
    return not faults


def main(command):
    if not command:
        return "usage: independent_count.py COMMAND [CASES]"
    for check in check_nearest, check_erasor, check_others:
        check()
    differing = [arena for arena in ARENAS if not try_arena(command, arena)]
    return f"the second count differs from the command's in: {', '.join(differing)}" if differing else None


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:2]))
