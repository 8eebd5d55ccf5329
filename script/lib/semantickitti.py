"""Table I: five windows of SemanticKITTI."""
import statistics
import sys

from lib.bench import both, cells, point_cells, table, voxel

WINDOWS = {  # first scan, the one after the last, every so many (ERASOR, RA-L 2021)
    "00": (4390, 4530, 2), "01": (150, 250, 1), "02": (860, 950, 2), "05": (2350, 2670, 2), "07": (630, 820, 2),
}
PAPER = {  # Table I: PR, RR, F1. Its F1 of ERASOR on 05 is 0.921; PR and RR make it 0.933
    "00": {"Removert": (86.83, 90.62, .887), "ERASOR": (93.98, 97.08, .955), "DynamicFilter": (90.07, 91.09, .906)},
    "01": {"Removert": (95.82, 57.08, .715), "ERASOR": (91.49, 95.38, .934), "DynamicFilter": (87.95, 87.69, .878)},
    "02": {"Removert": (83.29, 88.37, .858), "ERASOR": (87.73, 97.01, .921), "DynamicFilter": (88.02, 86.10, .871)},
    "05": {"Removert": (88.17, 79.98, .839), "ERASOR": (88.73, 98.26, .933), "DynamicFilter": (90.17, 84.65, .873)},
    "07": {"Removert": (82.04, 95.50, .883), "ERASOR": (90.62, 99.27, .948), "DynamicFilter": (87.94, 86.80, .874)},
}


def published(sequence):
    return [[sequence, f"{name}, in the paper", f"{pr:.2f}", f"{rr:.2f}", f"{f1:.3f}", "", "", ""]
            for name, (pr, rr, f1) in PAPER[sequence].items()]


def measured(bench, sequence, folder, window):
    first, end, every = window
    options = ("--first", first, "--last", end - 1, "--stride", every)
    return [[sequence, f"preset {preset}", *cells(voxel(result, reading="erasor")), cells(voxel(result))[2], *point_cells([result])]
            for preset, result in zip(("default", "paper"), both(bench, folder, options))]


def mean_rows(rows):
    """Mean F1 of each method that has all sequences."""
    methods = dict.fromkeys(r[1] for r in rows)
    scores = {m: [float(r[4]) for r in rows if r[1] == m and r[4] != "-"] for m in methods}
    return [["mean", m, "", "", f"{statistics.mean(f1):.3f}", "", "", ""] for m, f1 in scores.items() if len(f1) == len(PAPER)]


def table_one(bench, windows=None):
    if not bench.semantickitti:
        print("SKIPPED: Table I (give --semantickitti PATH)", file=sys.stderr)
        return None
    root = bench.semantickitti
    root = root / "sequences" if (root / "sequences").is_dir() else root
    rows = []
    for sequence, window in (windows or WINDOWS).items():
        rows += published(sequence)
        if (root / sequence / "velodyne").is_dir():
            rows += measured(bench, sequence, root / sequence, window)
        else:
            print(f"SKIPPED: sequence {sequence} of SemanticKITTI is not in {root}", file=sys.stderr)
            rows.append([sequence, "Skipped: not there", *["-"] * 6])
    return table(["sequence", "method", "PR [%]", "RR [%]", "F1", "F1, mixed left out", "AA [%]", "moving IoU [%]"], rows + mean_rows(rows))
