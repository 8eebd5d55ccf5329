"""What is known with the scan, two seconds later, and in the end; and the map around the sensor at each moment."""
import functools
import sys

from lib.bench import BUILD, call, table
from lib.chart import line_chart
from lib.figures import image_folder

SCENES = ["street os64 31 120 5", "street os64 32 120 5", "square os64 33 100 5", "crowd vlp16 41 200 2.5", "jam vlp16 38 200 2.5",
          "hall os64 40 80 10", "queue os64 11 300 5", "queue os64 12 300 5", "queue os64 13 300 5", "queue vlp16 11 300 5",
          "queue vlp16 12 300 5", "queue vlp16 13 300 5", "queue hdl32 14 300 5", "jam os64 13 300 5", "platform vlp16 12 300 5",
          "street os128 51 100 10", "square os128 52 80 10"]
OTHER_WAYS = {"exact poses": (), "noise of the poses": ("noise",), "own odometry": ("odometry",), "preset paper": ("paper",)}
WITH_OTHER_WAYS = ["street os64 31 120 5", "street os64 32 120 5", "square os64 33 100 5", "hall os64 40 80 10", "queue os64 13 300 5",
                   "crowd vlp16 41 200 2.5", "jam vlp16 38 200 2.5", "platform vlp16 12 300 5", "street os128 51 100 10"]
LOCAL_MAPS = ["street os64 31 150 5", "square os64 33 150 5", "crowd vlp16 41 150 5"]
COLORS = ["#1f77b4", "#d62728", "#2ca02c"]


@functools.cache
def moved(scene, *words):
    """The rows that `moved` prints, by their first cell: instant, settled, final."""
    print("moved", scene, *words, file=sys.stderr, flush=True)
    lines = call(BUILD / "moved", *scene.split(), *words).splitlines()[2:]
    rows = [[cell.strip().removesuffix(" %") for cell in line.strip("|").split("|")] for line in lines]
    return {name: values for name, _, *values in rows}


def name_of(scene):
    name, sensor, seed, scans, rate = scene.split()
    return f"{name}, {sensor}, seed {seed}: {scans} at {rate} Hz"


def tenths(values):
    return [f"{float(v):.1f}" for v in values]


def at_once_table(bench):
    rows = []
    for scene in SCENES[:1] if bench.quick else SCENES:
        of = moved(scene)
        static = of["static"]
        rows.append([name_of(scene), *tenths(of["moves"]), *tenths(of["moves, from its third scan on"][:1]),
                     *tenths(of["rests, was seen to move"]), static[0], static[2], *of["IoU of what moves"],
                     of["verdicts on things that were taken back"][0], of["verdicts on things that were taken back"][2]])
    return table(["scene, scans, rate", "moves: instant", "settled", "final", "from its third scan on: instant", "rests, was seen to move: instant",
                  "settled", "final", "static: instant", "final", "IoU: instant", "settled", "final", "taken back: instant", "final"], rows)


def ways_table(bench):
    """Other poses, and the paper's method, on the same scenes."""
    rows = []
    for scene in WITH_OTHER_WAYS[:1] if bench.quick else WITH_OTHER_WAYS:
        row = [name_of(scene)]
        for words in OTHER_WAYS.values():
            of = moved(scene, *words)
            ious = of["IoU of what moves"]
            row.append(f"{tenths(of['moves'])[0]} / {of['static'][0]} / {ious[0]} / {ious[2]}")
        rows.append(row)
    return table(["scene, scans, rate", *OTHER_WAYS], rows)


def local_map_chart(bench):
    series, means = [], []
    for scene, color in list(zip(LOCAL_MAPS, COLORS))[:1 if bench.quick else None]:
        print("local_map", scene, file=sys.stderr, flush=True)
        lines = call(BUILD / "local_map", *scene.split()).splitlines()[2:]
        *rows, mean = [[cell.strip() for cell in line.strip("|").split("|")] for line in lines]
        for column, (score, dashed) in enumerate((("PR", False), ("RR", True)), start=1):
            series.append((f"{score}, {' '.join(scene.split()[:3])}", color, dashed, [(float(r[0]), float(r[column])) for r in rows]))
        means.append([name_of(scene), *mean[1:]])
    chart = line_chart("time [s]", "score of the map around the sensor [%]", (80, 100), series)
    (image_folder(bench) / "local-map.svg").write_text(chart)
    return table(["scene, scans, rate", "PR [%]", "RR [%]", "F1", "there now [%]"], means) + "\n![the map around the sensor](images/local-map.svg)\n"
