"""The default preset without one of its mechanisms at a time."""
import sys

from lib.bench import NOISE, cells, percent, run, simulated, table, voxel
from lib.mechanisms import MECHANISMS

RECORDINGS = {
    "crowd of 150, vlp16": ("crowd", "vlp16", 1, "--pedestrians", 150),
    "crowd, vlp16, pose noise": ("crowd", "vlp16", 1, *NOISE),
    "street, os64": ("street", "os64", 1),
    "square, solid": ("square", "solid", 1),
    "hall, os64": ("hall", "os64", 1),
    "queue, os64": ("queue", "os64", 1, "--rate", 5, "--frames", 150),
    "slow, os64": ("slow", "os64", 1, "--rate", 5, "--frames", 150),
}


def score_row(bench, name, settings):
    """F1 / AA by recording; PR and RR go to the log. Quick: ten seconds of what has 10 scans a second."""
    row = [name]
    for case in RECORDINGS.values():
        options = ("--last", 99) if bench.quick and case[0] != "crowd" else ()
        result = run(bench, simulated(bench, *case), settings, preset="default", options=options)
        pr, rr, f1 = cells(voxel(result))
        print(f"without {name}: PR {pr}, RR {rr}, F1 {f1}", file=sys.stderr, flush=True)
        row.append(f"{f1} / {percent(result['metrics']['point']['aa'])}")
    return row


def ablation_table(bench, names=tuple(MECHANISMS)):
    rows = [score_row(bench, name, settings) for name, settings in {"(nothing)": [], **{n: MECHANISMS[n] for n in names}}.items()]
    return table(["without", *RECORDINGS], rows)
