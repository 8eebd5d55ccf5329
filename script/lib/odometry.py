"""The odometry against exact poses, beside Open3D's ICP; and whether check names poses that are nearly right."""
import re
import shutil
import sys
from collections import defaultdict

from lib.bench import BUILD, call, simulated, table

ERRORS = re.compile(r"10 m: (\S+) %.*100 m: (\S+) % \S+ deg/m \((\d+)\).*  ([\d.]+) ms$")
LOST = re.compile(r"lost (\d+)")

CASES = [  # scene, sensor, rate, frames, sweep
    ("crowd", "vlp16", 10, 300, False), ("crowd", "os64", 5, 150, False), ("crowd", "os128", 5, 100, True),
    ("hall", "vlp16", 10, 300, False), ("hall", "os64", 5, 100, True), ("hall", "hdl32", 20, 300, False),
    ("street", "os64", 10, 150, False), ("street", "hdl64", 5, 80, True), ("street", "os128", 2, 40, True),
    ("street", "vlp16", 20, 300, False), ("street", "solid", 10, 150, True),
    ("square", "os64", 10, 150, False), ("square", "vlp16", 10, 150, True), ("square", "solid", 10, 150, False),
    ("jam", "vlp16", 5, 400, False), ("jam", "os64", 10, 200, True)]


def odometry_row(bench, scene, sensor, rate, frames, sweep):
    ours, theirs = [], []
    for seed in [21, 22, 23][:len(bench.seeds)]:
        recording = simulated(bench, scene, sensor, seed, "--rate", rate, "--frames", frames, *(["--sweep"] if sweep else []))
        print("odometry", recording.name, file=sys.stderr, flush=True)
        ours.append(call(BUILD / "odometry", recording).strip())
        theirs.append(call(BUILD / "open3d_peer", recording).strip())
        shutil.rmtree(recording)
    lost = sum(int(LOST.search(line).group(1)) for line in ours)
    return [scene, sensor, rate, "yes" if sweep else "", *errors(ours), lost, *errors(theirs)]


def errors(lines):
    """Of 10 m and 100 m as means over the seeds, and the time."""
    found = [ERRORS.search(line).groups() for line in lines]
    far = [float(hundred) for _, hundred, pieces, _ in found if int(pieces) > 0]
    mean = lambda values: sum(values) / len(values)  # noqa: E731
    return [f"{mean([float(f[0]) for f in found]):.2f}", f"{mean(far):.2f}" if far else "-",
            f"{mean([float(f[3]) for f in found]):.0f}"]


def odometry_table(bench):
    if not (BUILD / "open3d_peer").exists():
        print("SKIPPED: the odometry's table (install libopen3d-dev and build again)", file=sys.stderr)
        return None
    rows = [odometry_row(bench, *case) for case in CASES]
    return table(["scene", "sensor", "Hz", "sweep", "10 m", "100 m", "CPU", "lost", "ICP: 10 m", "100 m", "CPU"], rows)


def mistakes_table(bench):
    """Recordings on which the sensor turns or changes its speed, each with five kinds of poses."""
    cases = [(scene, sensor, rate) for scene, rate in (("crowd", 1.25), ("platform", 1.25), ("square", 2), ("jam", 2))
             for sensor in ("vlp16", "os64")]
    named, all_of, wrong = defaultdict(int), defaultdict(int), []
    for scene, sensor, rate in cases:
        for seed in (31, 32, 33):
            recording = simulated(bench, scene, sensor, seed, "--rate", rate, "--frames", 60 if scene == "square" else 80)
            print("mistakes", recording.name, file=sys.stderr, flush=True)
            for line in call(BUILD / "mistakes", "--motion", recording).splitlines():
                words = [w.strip() for w in line.strip("|").split("|")]
                if len(words) != 4:
                    continue
                all_of[words[1]] += 1
                named[words[1]] += words[2] == "yes"
                if words[2] != "yes":
                    wrong.append([f"{scene}, {sensor}, seed {seed}", words[1], words[3]])
            shutil.rmtree(recording)
    rows = [[kind, f"{named[kind]} of {all_of[kind]}"] for kind in all_of]
    return (table(["mistake", "correct answers"], rows) + "\nAll other answers:\n\n" +
            table(["recording", "mistake", "check"], wrong))
