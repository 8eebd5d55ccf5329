# SPDX-License-Identifier: MIT
"""Every arena from its simulated data to its table, and what a user may do wrong. Usage: bench_test.py COMMAND"""
import json
import re
import shutil
import struct
import subprocess
import sys
import tempfile
from pathlib import Path

COMMAND = sys.argv[1]
TWINS = {  # an entry of each arena, and the least of its scores
    "erasor": ("01", .9), "erasor2": ("01", .9), "strict": ("02", .9), "dynamicmap": ("01", .9), "dynamicmap-kitti": ("01", .9), "mos": ("08", .75), "helimos": ("Velodyne", .9),
    "doals": ("station/sequence_1", .75), "moe": ("00", .85), "nuscenes": ("scene-0061", .8), "kitti-raw": ("0001", .7),
}


def call(*arguments, code=0):
    """Runs the command; returns what it said."""
    done = subprocess.run([COMMAND, "bench", *map(str, arguments)], capture_output=True, text=True)
    said = done.stdout + done.stderr
    assert done.returncode == code, f"{arguments}: exit code {done.returncode}, expected {code}:\n{said}"
    return said


def expect(text, said):
    assert re.search(text, said), f"expected '{text}' in:\n{said}"


def rows(out):
    return json.loads((out / "table.json").read_text())["rows"]


def measured(out):
    return {(row["entry"], row["method"]): row["scores"] for row in rows(out) if row["measured"]}


def published_tables(work):
    """The page of comparisons has the tables that the command prints without a data set."""
    page = (Path(__file__).resolve().parents[2] / "docs/comparison.md").read_text()
    for arena in TWINS:
        said = call(arena)
        expect("download +[A-Z0-9a-z]", said)
        tables = said.split("FOLDER\n", 1)[1].strip()
        is_part = arena == "dynamicmap-kitti"  # the figures of dynamicmap
        assert is_part or tables in page, f"docs/comparison.md has not got what `dynamicfilter bench {arena}` prints"


def every_arena(work):
    for arena, (entry, least) in TWINS.items():
        data, out = work / arena, work / f"{arena}-out"
        call(arena, data, "--twin", "--only", entry)
        said = call(arena, data, "-o", out, "--preset", "default")
        scores = measured(out)[entry, "DynamicFilter, preset default"]
        assert all(score is not None and score > least for score in scores.values()), f"{arena}: {scores}"
        expect(f"{entry} +DynamicFilter, preset default", said)
        expect("measured here", (out / "table.md").read_text())
        is_alone = arena in ("mos", "nuscenes", "kitti-raw")  # there is no other entry
        expect("written" if is_alone else "not there: .*Download ", said)


def truth_beside_the_scans(work):
    """The scans of av2 have no intensity, those of semindoor the sensor's: the truth is in gt_cloud.pcd alone."""
    data, out = work / "others", work / "others-out"
    call("dynamicmap", data, "--twin", "--only", "av2", "--only", "semindoor")
    call("dynamicmap", data, "-o", out, "--preset", "default")
    for entry in ("av2", "semindoor"):
        scores = measured(out)[entry, "DynamicFilter, preset default"]
        assert min(scores.values()) > .9, f"{entry}: {scores}"
    (data / "av2/gt_cloud.pcd").unlink()
    expect("gt_cloud.pcd", call("dynamicmap", data, "-o", out, "--preset", "default", "--only", "av2", code=3))


def goes_on(work):
    """A second call does not filter again, and the table is the same."""
    out = work / "moe-out"
    table, labels = (out / "table.json").read_bytes(), out / "00/default/labels/000000.label"
    before = labels.stat().st_mtime_ns
    call("moe", work / "moe", "-o", out, "--preset", "default")
    assert labels.stat().st_mtime_ns == before, "the run was repeated"
    assert (out / "table.json").read_bytes() == table
    said = call("moe", work / "moe", "-o", out, "--preset", "default", "--poses", "none", code=2)
    expect("another", said)


def peers(work):
    """Our own labels and map, as if they were another program's."""
    labels, results = work / "peer", work / "dynamicmap-out"
    shutil.copytree(results / "01/default/labels", labels / "01")
    data, out = work / "dynamicmap", work / "peers-out"
    said = call("dynamicmap", data, "-o", out, "--no-run", "--peer", f"Twin={labels}", "--only", "01")
    expect("01 +Twin", said)
    ours = measured(results)["01", "DynamicFilter, preset default"]
    assert measured(out) == {("01", "Twin"): ours}
    call("dynamicmap", data, "-o", out, "--no-run", "--peer", f"Other={labels}", "--only", "01")
    assert measured(out) == {("01", "Twin"): ours, ("01", "Other"): ours}, "an earlier row is gone"
    submitted = work / "submission"
    call("dynamicmap", data, "-o", results, "--preset", "default", "--submission", "--only", "01")
    (work / "maps").mkdir()
    shutil.copy(results / "submission/01/dynamicfilter_output.pcd", work / "maps/01.pcd")
    call("dynamicmap", data, "-o", submitted, "--no-run", "--peer", f"Map={work / 'maps'}", "--only", "01")
    for name, score in measured(submitted)["01", "Map"].items():
        assert abs(score - ours[name]) < 1e-6, f"{name}: {score}, by labels {ours[name]}"
    expect("expected NAME=FOLDER", call("moe", data, "-o", out, "--peer", "nothing", code=2))
    expect("does not exist", call("moe", data, "-o", out, "--peer", "A=/nowhere", code=3))
    expect("has no result of 08", call("mos", work / "mos", "-o", work / "x", "--no-run", "--peer", f"A={labels}"))
    (work / "mos-map").mkdir()
    shutil.copy(work / "maps/01.pcd", work / "mos-map/08.pcd")
    expect("scores the labels of scans", call("mos", work / "mos", "-o", work / "x", "--no-run", "--peer", f"A={work / 'mos-map'}", code=3))


def header(cloud):
    """Fields of the header of a PCD file, and where its points begin."""
    text = cloud.split(b"DATA binary\n")[0].decode()
    return dict(line.split(" ", 1) for line in text.splitlines() if not line.startswith("#")), len(text) + len("DATA binary\n")


def submissions(work):
    """What the benchmarks ask for, by their rules."""
    call("dynamicmap", work / "others", "-o", work / "others-out", "--preset", "default", "--submission", "--only", "semindoor")
    exported = (work / "others-out/submission/semindoor/eval/dynamicfilter_output_exportGT.pcd").read_bytes()
    truth = (work / "others/semindoor/gt_cloud.pcd").read_bytes()
    (ours, at), (theirs, begin) = header(exported), header(truth)
    assert ours["POINTS"] == theirs["POINTS"] and ours["FIELDS"] == "x y z intensity"
    for point in range(0, int(ours["POINTS"]), 997):
        x = struct.unpack_from("<4f", exported, at + 16 * point)
        assert x[:3] == struct.unpack_from("<3f", truth, begin + 16 * point) and x[3] in (0.0, 1.0), point
    for arena, sequence in (("mos", "08"), ("helimos", "03")):
        entry, out = TWINS[arena][0], work / f"{arena}-out"
        call(arena, work / arena, "-o", out, "--preset", "default", "--submission")
        given = sorted((work / arena).rglob(f"{entry}/labels/*.label"))
        written = sorted((out / f"submission/sequences/{sequence}/predictions").iterdir())
        assert [f.name for f in written] == [f.name for f in given]
        for file, like in zip(written, given):
            values = struct.unpack(f"<{file.stat().st_size // 4}I", file.read_bytes())
            assert file.stat().st_size == like.stat().st_size and set(values) <= {9, 251}, file
    expect("asks for no files", call("moe", work / "moe", "-o", work / "x", "--submission", code=2))


def wrong_input(work):
    empty = work / "empty"
    empty.mkdir()
    for arena in TWINS:
        said = call(arena, empty, "-o", work / "x", code=3)
        expect("Expected is .* Download ", said)
    expect("is not a folder", call("moe", work / "nothing", "-o", work / "x", code=3))
    expect("has no entry '99'; choose from", call("erasor", work / "erasor", "--only", "99", "-o", work / "x", code=2))
    expect("is not empty", call("moe", work / "moe", "--twin", code=2))
    sequence = work / "erasor/sequences/01"
    scan = sequence / "velodyne/000200.bin"
    whole = scan.read_bytes()
    scan.write_bytes(whole[:1001])
    expect("000200.bin", call("erasor", work / "erasor", "-o", work / "erasor-x", "--only", "01", code=3))
    scan.unlink()
    expect("scan 000200.bin is missing, or one before it", call("erasor", work / "erasor", "-o", work / "x", "--only", "01", code=3))
    scan.write_bytes(whole)
    label = sequence / "labels/000210.label"
    label.write_bytes(label.read_bytes()[:400])
    expect("000210.label", call("erasor", work / "erasor", "-o", work / "erasor-out", "--preset", "default", "--only", "01", code=3))
    (sequence / "calib.txt").rename(sequence / "away.txt")
    expect("has no calib.txt", call("erasor", work / "erasor", "-o", work / "x", "--only", "01", code=3))
    (sequence / "away.txt").rename(sequence / "calib.txt")
    (work / "mos/sequences/08/labels/000007.label").unlink()
    expect("has labels of 59 of 60 scans", call("mos", work / "mos", "-o", work / "x", code=3))
    (work / "mos/sequences/08/velodyne/000059.bin").unlink()
    expect("59 scans", call("mos", work / "mos", "-o", work / "x", code=3))
    expect("--twin needs DATA", call("moe", "--twin", code=2))
    expect("is of this program", call("mos", work / "mos", "--no-run", "--peer", f"A={work}", "--submission", code=2))
    (sequence / "labels").rename(sequence / "gone")
    expect("no folder labels: unpack", call("erasor", work / "erasor", "-o", work / "x", "--only", "01", code=3))
    tracks = next((work / "kitti-raw").rglob("tracklet_labels.xml"))
    tracks.write_text(tracks.read_text()[:900])
    expect(r"tracklet_labels.xml \(line [0-9]+\): is not whole XML", call("kitti-raw", work / "kitti-raw", "-o", work / "x", code=3))
    indices = work / "doals/station/sequence_1/indices.csv"
    indices.write_text("17,1,2\n")
    expect("no scan of the bag has the stamp", call("doals", work / "doals", "-o", work / "x", code=3))
    scan = work / "moe/00/pcd/000039.pcd"
    whole = scan.read_bytes()
    scan.unlink()
    expect("39 scans", call("moe", work / "moe", "-o", work / "x", code=3))
    scan.write_bytes(whole)
    (work / "moe/00/label/000003.txt").write_text("1 1 0\n")
    expect("has 1 rows, but the scan has", call("moe", work / "moe", "-o", work / "moe-out", "--preset", "default", code=3))


def main():
    with tempfile.TemporaryDirectory() as scratch:
        work = Path(scratch)
        for part in (published_tables, every_arena, truth_beside_the_scans, goes_on, peers, submissions, wrong_input):
            part(work)
            print("passed", part.__name__, flush=True)


if __name__ == "__main__":
    main()
