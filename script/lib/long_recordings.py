"""How the default preset does as a recording gets longer, faster or slower, and where things rest for long."""
import shutil

from lib.bench import cells, mean, point_cells, run, simulated, spread, table, voxel
from lib.chart import line_chart
from lib.figures import image_folder

PEOPLE = ("--pedestrians", 150)
HEAD = ["scans", "PR [%]", "RR [%]", "F1", "AA [%]", "instant F1"]


def results_of(bench, scene, sensor, *options):
    """Runs of the default preset over all seeds; the recordings are removed."""
    results = []
    for seed in bench.seeds:
        recording = simulated(bench, scene, sensor, seed, *options)
        results.append(run(bench, recording, preset="default"))
        shutil.rmtree(recording)
    return results


def row(results):
    pr, rr, f1 = cells(mean([voxel(r) for r in results]))
    return [round(mean([[r["metrics"]["scans"]] for r in results])[0]), pr, rr, f1 + spread([voxel(r)[2] for r in results]),
            *point_cells(results, ("aa",)), cells(mean([voxel(r, True) for r in results]))[2]]


def length_table(bench):
    """The same crowd for 1, 2, 4, 8 and 16 rounds."""
    rounds = [1, 4] if bench.quick else [1, 2, 4, 8, 16]
    results = {n: results_of(bench, "crowd", "vlp16", *PEOPLE, "--rate", 1.25, "--rounds", n) for n in rounds}
    series = [("F1 [%]", "#222222", False, [(n, 100 * voxel(r[0])[2]) for n, r in results.items()]),
              ("AA [%]", "#1f77b4", False, [(n, 100 * r[0]["metrics"]["point"]["aa"]) for n, r in results.items()])]
    (image_folder(bench) / "against-length.svg").write_text(line_chart("rounds of the robot", "[%]", (90, 100), series))
    return (bench.seeds_sentence + table(["rounds", *HEAD], [[n, *row(r)] for n, r in results.items()]) +
            f"\nThe picture shows seed {bench.seeds[0]}.\n\n![F1 and AA of the crowd of 150 against the number of rounds](images/against-length.svg)\n")


def rate_table(bench):
    """The same two rounds, with more or fewer scans a second."""
    rates = [1.25, 5] if bench.quick else [1.25, 2.5, 5, 10]
    return bench.seeds_sentence + table(["rate [Hz]", *HEAD], [[r, *row(results_of(bench, "crowd", "vlp16", *PEOPLE, "--rate", r))] for r in rates])


def long_rests(bench):
    """Whole scenes in which things stand for 5 to 120 s."""
    cases = [(scene, sensor, *options) for scene in ("jam", "platform")
             for sensor, *options in (("vlp16", "--rate", 5), ("os64", "--rate", 2.5))]
    rows = [[scene, sensor, options[1], *row(results_of(bench, scene, sensor, *options))] for scene, sensor, *options in cases]
    return bench.seeds_sentence + table(["scene", "sensor", "rate [Hz]", *HEAD], rows)
