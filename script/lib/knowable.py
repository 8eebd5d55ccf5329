"""How much is removed of what could be known: by how often somebody saw through a place, and by what the thing there does."""
import json
import shutil

from lib.bench import call, percent, run, simulated, table
from lib.chart import line_chart
from lib.figures import image_folder

CASES = [("street", 11, 5), ("queue", 11, 2.5), ("queue", 12, 2.5), ("queue", 13, 2.5), ("square", 11, 5), ("crowd", 11, 1.25)]
COLORS = ["#1f77b4", "#d62728", "#ff7f0e", "#9467bd", "#2ca02c", "#222222"]
GROUPS = {"all": "all", "beams_1": "passed by a beam", "beams_3": "by 3 or more", "beams_10": "by 10 or more", "moves": "moves",
          "moved": "rests, was seen to move", "will_move": "rests, will be seen to move", "never": "rests, is never seen to move",
          "knowable": "knowable"}
FEWEST = 50  # voxels of a bin in the picture


def knowable_of(bench, scene, seed, rate):
    """What `eval` says of the default preset on a recording, which is removed."""
    recording = simulated(bench, scene, "os64", seed, "--rate", rate, "--frames", 50 if bench.quick else 150, "--knowable")
    run(bench, recording, preset="default", options=("--no-report",))
    scores = bench.work / "knowable.json"
    call(bench.command, "eval", "--truth", recording, "--labels", bench.work / "out", "-o", scores)
    shutil.rmtree(recording)
    return json.loads(scores.read_text())["knowable"]


def cell(group, number, removed, everything):
    """Share removed [%], and in brackets the share of all [%]."""
    return f"{percent(group[removed])} ({100 * group[number] / everything:.1f})" if group[number] else "-"


def shares(results, number, removed):
    rows = []
    for (scene, seed, _), scores in results.items():
        everything = scores["groups"]["all"][number]
        rows.append([scene, seed, everything, percent(scores["groups"]["all"][removed]),
                     *(cell(scores["groups"][name], number, removed, everything) for name in GROUPS if name != "all")])
    return table(["scene", "seed", number, *GROUPS.values()], rows)


def name_of(bin):
    if bin["to"] is None:
        return f"{bin['from']}+"
    return str(bin["from"]) if bin["from"] == bin["to"] else f"{bin['from']}-{bin['to']}"


def knowable_table(bench):
    cases = [CASES[0], CASES[1]] if bench.quick else CASES
    results = {case: knowable_of(bench, *case) for case in cases}
    series = []
    for ((scene, seed, _), scores), color in zip(results.items(), COLORS):
        points = [(x, 100 * bin["rr"]) for x, bin in enumerate(scores["bins"]) if bin["voxels"] >= FEWEST]
        series.append((f"{scene}, seed {seed}", color, False, points))
    names = [name_of(bin) for bin in next(iter(results.values()))["bins"]]
    (image_folder(bench) / "knowable.svg").write_text(
        line_chart("beams that passed through the voxel while it was empty", "RR [%]", (0, 100), series, x_names=names))
    return (f"Voxels, RR [%]:\n\n{shares(results, 'voxels', 'rr')}\nPoints, share removed [%]:\n\n"
            f"{shares(results, 'points', 'points_removed')}\n"
            f"Bins of fewer than {FEWEST} voxels are left out of the picture.\n\n"
            "![RR against the number of beams that passed through a voxel](images/knowable.svg)\n")
