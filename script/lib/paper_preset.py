"""Tables II and III and Figure 3 with the preset `paper`."""
import shutil
import statistics

from lib.bench import cells, mean, point_cells, run, simulated, spread, table, voxel, memory_cell

PEDESTRIANS = [50, 100, 150]
PAPER = {  # Tables II and III: PR, RR, F1
    50: {"Removert": (69.63, 64.84, .671), "ERASOR": (72.25, 76.26, .742), "front-end only": (80.69, 62.19, .702),
         "back-end only": (95.78, 92.12, .939), "non-visibility check": (74.48, 99.66, .852),
         "non-incident correction": (90.96, 98.92, .948), "full": (95.63, 94.57, .951)},
    100: {"Removert": (66.48, 57.96, .619), "ERASOR": (69.16, 71.87, .705), "front-end only": (78.73, 57.39, .664),
          "back-end only": (95.06, 80.85, .874), "non-visibility check": (71.82, 99.38, .834),
          "non-incident correction": (90.27, 99.22, .945), "full": (95.32, 94.26, .948)},
    150: {"Removert": (68.59, 51.13, .586), "ERASOR": (71.86, 59.13, .649), "front-end only": (76.94, 61.42, .683),
          "back-end only": (93.83, 58.32, .719), "non-visibility check": (68.12, 99.47, .809),
          "non-incident correction": (89.33, 98.97, .939), "full": (95.41, 90.76, .930)},
}
VARIANTS = {
    "Removert": ["method=removert"],
    "front-end only": ["back_end.enabled=false"],
    "back-end only": ["front_end.enabled=false"],
    "non-visibility check": ["back_end.visibility_check=false"],
    "non-incident correction": ["back_end.incident_correction=false"],
    "full": [],
}
FULL_HEAD = ["people", "PR [%]", "RR [%]", "F1", "F1 in the paper", "AA [%]", "moving IoU [%]",
             "front-end [scans/s]", "back-end [submaps/s]", "run [scans/s]", "memory [MB]"]


def full_row(people, results):
    """A row of Table II: the full method, mean of the seeds, with its speed."""
    scores = [voxel(r) for r in results]
    pr, rr, f1 = cells(mean(scores))
    timing = [r["timing"] for r in results]
    rates = ([t["front_end"]["scans_per_second"] for t in timing],
             [t["back_end"]["submaps_per_second"] for t in timing], [t["scans_per_second"] for t in timing])
    return [people, pr, rr, f1 + spread([s[2] for s in scores]), PAPER[people]["full"][2], *point_cells(results),
            *(f"{statistics.median(rate):.0f}" for rate in rates), memory_cell(results)]


def crowd_vlp16(bench):
    """Tables II and III with the paper's sensor."""
    rows2, rows3, shares = [], [], []
    for people in PEDESTRIANS:
        results = {name: [] for name in VARIANTS}
        for seed in bench.seeds:
            recording = simulated(bench, "crowd", "vlp16", seed, "--pedestrians", people)
            for name, settings in VARIANTS.items():
                results[name].append(run(bench, recording, settings))
        rows2.append(full_row(people, results["full"]))
        for name in VARIANTS:
            pr, rr, f1 = PAPER[people][name]
            rows3.append([people, name, *cells(mean([voxel(r) for r in results[name]])), pr, rr, f"{f1:.3f}"])
        shares.append([people, *(f"{100 * r['metrics']['dynamic_voxel_share']:.1f}" for r in results["full"]),
                       {50: 54.8, 100: 58.5, 150: 59.3}[people]])
    seeds = [f"seed {s}" for s in bench.seeds]
    return (bench.seeds_sentence + "Table II of the paper, the full method:\n\n" + table(FULL_HEAD, rows2) +
            "\nShare of the voxels that hold a moving point [%]:\n\n" + table(["people", *seeds, "paper"], shares) +
            "\nTable III of the paper, the ablation. The last three columns are the paper's figures:\n\n" +
            table(["people", "variant", "PR [%]", "RR [%]", "F1", "PR", "RR", "F1"], rows3))


def crowd_os64(bench):
    """Table II with 64 beams."""
    rows = []
    for people in PEDESTRIANS:
        results = []
        for seed in bench.seeds:
            recording = simulated(bench, "crowd", "os64", seed, "--pedestrians", people)
            results.append(run(bench, recording))
            shutil.rmtree(recording)
        rows.append(full_row(people, results))
    return bench.seeds_sentence + table(FULL_HEAD, rows)


def reverting_table(bench):
    """Figure 3 in figures: the front-end alone with each kind of reverting."""
    recording = simulated(bench, "crowd", "vlp16", 1, "--pedestrians", 100)
    rows = [[kind, *cells(voxel(run(bench, recording, ["back_end.enabled=false", f"front_end.reverting={kind}"])))]
            for kind in ("none", "visibility", "map")]
    return table(["reverting", "PR [%]", "RR [%]", "F1"], rows)
