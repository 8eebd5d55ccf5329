"""What all sections share: recordings, runs, scores, Markdown."""
import json
import shutil
import statistics
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
BUILD = ROOT / "build/release"
NOISE = ("--pose-noise", 0.03, "--pose-noise-deg", 0.2)


@dataclass
class Bench:
    """Where and how much. `work` keeps recordings and the last run's output."""
    work: Path
    quick: bool = False
    command: Path = BUILD / "dynamicfilter"

    @property
    def seeds(self):
        return [1] if self.quick else [1, 2, 3]

    @property
    def seeds_sentence(self):
        return f"The figures are those of seed {self.seeds[0]}.\n\n" if self.quick else "The figures are the means of seeds 1, 2 and 3.\n\n"


def call(*words, good=(0,)):
    """Standard output of a command; its failure ends everything."""
    done = subprocess.run([str(w) for w in words], capture_output=True, text=True)
    if done.returncode not in good:
        sys.exit(f"{' '.join(map(str, words))}: {done.stderr[-2000:]}")
    return done.stdout


def simulated(bench, scene, sensor, seed, *options):
    folder = bench.work / "-".join(str(w) for w in (scene, sensor, seed, *options))
    if not folder.exists():
        unfinished = folder.with_name(folder.name + ".part")
        shutil.rmtree(unfinished, ignore_errors=True)
        call(bench.command, "simulate", scene, "--sensor", sensor, "--seed", seed, *options, "-o", unfinished)
        unfinished.rename(folder)
    return folder


def run(bench, recording, settings=(), preset="paper", options=()):
    """Scores and timing of one run."""
    out = bench.work / "out"
    words = [w for s in settings for w in ("--set", s)]
    call(bench.command, "run", recording, "-o", out, "--overwrite", "--preset", preset, *words, *options,
         good=(0, 4))  # 4: some scans were rejected or dropped, which the tables show
    print(recording.name, preset, *settings, *options, file=sys.stderr, flush=True)
    return {name: json.loads((out / f"{name}.json").read_text()) for name in ("metrics", "timing")}


def both(bench, recording, options=()):
    """The results of the default preset and of the paper's on one recording."""
    return run(bench, recording, preset="default", options=options), run(bench, recording, options=options)


def voxel(result, instant=False):
    metrics = result["metrics"]["instant"] if instant else result["metrics"]
    v = metrics["voxel"]["excluded"]
    return v["pr"], v["rr"], v["f1"]


def mean(rows):
    return [None if None in column else statistics.mean(column) for column in zip(*rows)]


def spread(values):
    return f" (+-{statistics.pstdev(values):.3f})" if len(values) > 1 else ""


def percent(value):
    return "-" if value is None else f"{100 * value:.2f}"


def cells(score):
    pr, rr, f1 = score
    return [percent(pr), percent(rr), "-" if f1 is None else f"{f1:.3f}"]


def point_cells(results, keys=("aa", "iou")):
    """Scores per point [%], mean of the runs."""
    return [percent(v) for v in mean([[r["metrics"]["point"][key] for key in keys] for r in results])]


def memory_cell(results):
    return f"{max(r['timing']['peak_rss_bytes'] for r in results) / 1e6:.0f}"


def table(head, rows):
    lines = ["| " + " | ".join(head) + " |", "|" + "---|" * len(head)]
    return "\n".join(lines + ["| " + " | ".join(str(c) for c in row) + " |" for row in rows]) + "\n"
