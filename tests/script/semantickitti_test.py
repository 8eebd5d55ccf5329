"""Table I on a small data set in SemanticKITTI's layout, made from a simulated recording.

Its poses are those of the camera, as in the data set, so the scores are those of the recording only if
calibration, window and stride are used as they should be.
"""
import shutil
import sys
import tempfile
from pathlib import Path

source, command = Path(sys.argv[1]), Path(sys.argv[2])
sys.dont_write_bytecode = True
sys.path.insert(0, str(source / "script"))
from lib.bench import Bench, both, cells, simulated, voxel  # noqa: E402
from lib.semantickitti import WINDOWS, table_one  # noqa: E402

# Camera x is LiDAR -y, camera y is LiDAR -z, camera z is LiDAR x; the camera sits a little ahead.
TR = [[0, -1, 0, 0.1], [0, 0, -1, 0.2], [1, 0, 0, -0.3]]


def product(a, b):
    full = b + [[0, 0, 0, 1]]
    return [[sum(row[k] * full[k][j] for k in range(4)) for j in range(4)] for row in a]


def inverse(a):
    turned = [[a[j][i] for j in range(3)] for i in range(3)]
    return [row + [-sum(row[k] * a[k][3] for k in range(3))] for row in turned]


def rows(numbers):
    return [numbers[4 * i:4 * i + 4] for i in range(3)]


def text(matrix):
    return " ".join(repr(float(v)) for row in matrix for v in row)


def make_sequence(recording, folder):
    """Links the scans and labels, and writes the poses anew."""
    folder.mkdir(parents=True)
    for name in ("velodyne", "labels"):
        (folder / name).symlink_to(recording / name)
    shutil.copy(recording / "times.txt", folder)
    poses = [rows([float(v) for v in line.split()]) for line in (recording / "poses.txt").read_text().splitlines()]
    camera = [product(product(TR, pose), inverse(TR)) for pose in poses]
    (folder / "poses.txt").write_text("".join(text(p) + "\n" for p in camera))
    (folder / "calib.txt").write_text(f"Tr: {text(TR)}\n")


def main():
    with tempfile.TemporaryDirectory() as scratch:
        data = Path(scratch) / "dataset"
        bench = Bench(Path(scratch), quick=True, semantickitti=data, command=command)
        recording = simulated(bench, "crowd", "vlp16", 1, "--frames", 24)
        for sequence in list(WINDOWS)[:-1]:  # one is missing
            make_sequence(recording, data / "sequences" / sequence)
        page = table_one(bench, {sequence: (4, 20, every) for sequence, (_, _, every) in WINDOWS.items()})
        direct = both(bench, recording, ("--first", 4, "--last", 19, "--stride", 2))
    for preset, result in zip(("default", "paper"), direct):
        row = " | ".join(["00", f"preset {preset}", *cells(voxel(result, reading="erasor"))])
        assert row in page, f"expected {row} in\n{page}"
    assert "| 07 | Skipped: not there |" in page, page
    assert "| mean | DynamicFilter, in the paper |  |  | 0.880 |" in page, page


if __name__ == "__main__":
    main()
