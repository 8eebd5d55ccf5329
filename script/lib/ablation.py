"""The default preset without one of its mechanisms at a time."""
import dataclasses
import sys
from contextlib import contextmanager
from pathlib import Path

from lib.bench import NOISE, cells, percent, run, simulated, table, voxel
from lib.mechanisms import MECHANISMS
from lib.scratch import builds, prepare

RECORDINGS = {
    "crowd of 150, vlp16": ("crowd", "vlp16", 1, "--pedestrians", 150),
    "crowd, vlp16, pose noise": ("crowd", "vlp16", 1, *NOISE),
    "street, os64": ("street", "os64", 1),
    "square, solid": ("square", "solid", 1),
    "hall, os64": ("hall", "os64", 1),
}


def edited(tree, edits):
    """New text by file. Ends everything if an edit does not fit."""
    texts = {}
    for file, old, new in edits:
        text = texts.get(file) or (tree / file).read_text()
        if text.count(old) != 1:
            sys.exit(f"script/lib/mechanisms.py: found {text.count(old)} times instead of once in {file}: {old}")
        texts[file] = text.replace(old, new)
    return texts


@contextmanager
def applied(tree, edits):
    changed = edited(tree, edits)
    originals = {file: (tree / file).read_text() for file in changed}
    try:
        for file, text in changed.items():
            (tree / file).write_text(text)
        yield
    finally:
        for file, text in originals.items():
            (tree / file).write_text(text)


def score_row(bench, name):
    """F1 / AA by recording; PR and RR go to the log. Quick: ten seconds of what has 10 scans a second."""
    row = [name]
    for case in RECORDINGS.values():
        options = ("--last", 99) if bench.quick and case[0] != "crowd" else ()
        result = run(bench, simulated(bench, *case), preset="default", options=options)
        pr, rr, f1 = cells(voxel(result))
        print(f"without {name}: PR {pr}, RR {rr}, F1 {f1}", file=sys.stderr, flush=True)
        row.append(f"{f1} / {percent(result['metrics']['point']['aa'])}")
    return row


def ablation_table(bench, names=tuple(MECHANISMS), scratch=Path("/tmp/dynamic_filter_ablate")):
    tree, build = prepare(scratch, "-DCMAKE_BUILD_TYPE=Release", "-DDYNAMIC_FILTER_TESTS=OFF", "-DDYNAMIC_FILTER_BENCH=OFF")
    for name in names:
        edited(tree, MECHANISMS[name])  # all fit, or nothing is run
    copy = dataclasses.replace(bench, command=build / "dynamicfilter")
    rows = []
    for name, edits in {"(nothing)": [], **{n: MECHANISMS[n] for n in names}}.items():
        with applied(tree, edits):
            if not builds(build, "dynamicfilter"):
                sys.exit(f"script/lib/mechanisms.py: does not compile without {name}")
            rows.append(score_row(copy, name))
    return ("\n## Default preset, ablation\n\n`script/ablate`: the mechanisms are no settings; each is edited out of a copy of the sources. "
            "F1 / AA [%], seed 1.\n\n" + table(["without", *RECORDINGS], rows))
