"""The paper's Figures 4, 5, 7 and 8 on the simulated crowd, as pictures in docs/images."""
from lib.bench import BUILD, ROOT, call, cells, run, simulated, voxel
from lib.chart import line_chart
from lib.paper_preset import VARIANTS

COLORS = {"PR": "#1f77b4", "RR": "#d62728", "F1": "#222222"}


def image_folder(bench):
    """A quick run leaves the pictures of the documentation alone."""
    folder = bench.work / "images" if bench.quick else ROOT / "docs/images"
    folder.mkdir(exist_ok=True)
    return folder


def crowd(bench):
    return simulated(bench, "crowd", "vlp16", 1)


def picture(bench, kind, name):
    """Of the last run. Returns its Markdown."""
    call(BUILD / "map_picture", kind, crowd(bench), bench.work / "out", image_folder(bench) / f"{name}.png")
    return f"![{name}](images/{name}.png)"


def score_text(result):
    pr, rr, f1 = cells(voxel(result))
    return f"PR {pr} %, RR {rr} %, F1 {f1}"


def variant_pictures(bench):
    """Figure 7, and 4 with it: what each variant keeps and loses."""
    runs = [("default preset", "default", [])] + [(f"preset paper, {name}", "paper", s) for name, s in reversed(VARIANTS.items())]
    variants = []
    for name, preset, settings in runs:
        result = run(bench, crowd(bench), settings, preset)
        image = picture(bench, "errors", "map-" + name.replace("preset ", "").replace(", ", "-").replace(" ", "-").lower())
        variants.append(f"{name}: {score_text(result)}\n\n{image}\n")
    return "\n".join(variants)


def submap_picture(bench):
    run(bench, crowd(bench))
    return picture(bench, "submaps", "submaps") + "\n"


def scores_over_time(bench):
    """The chart of Figure 8. A moment is the run of all scans until then, scored on them."""
    recording = crowd(bench)
    stamps = [float(t) for t in (recording / "times.txt").read_text().split()]
    parts = 4 if bench.quick else 16
    series = []
    for preset in ("default", "paper"):
        moments = [round(i * (len(stamps) - 1) / parts) for i in range(1, parts + 1)]
        scores = [voxel(run(bench, recording, preset=preset, options=("--last", last))) for last in moments]
        for k, name in enumerate(COLORS):
            points = [(stamps[last], 100 * score[k]) for last, score in zip(moments, scores)]
            series.append((f"{name}, {preset}", COLORS[name], preset == "paper", points))
    lowest = min(y for *_, points in series for _, y in points)
    chart = line_chart("time [s]", "score of the map so far [%]", (int(lowest / 5) * 5, 100), series,
                       [(stamps[-1] / 2, "one round")])
    (image_folder(bench) / "scores-over-time.svg").write_text(chart)
    return "![scores over time](images/scores-over-time.svg)\n"
