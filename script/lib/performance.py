"""Speed, latency and memory: the sections of docs/performance.md."""
import json
import os
import shutil
import statistics
import sys
import time

from .bench import BUILD, call, run, simulated, table

CASES = (("crowd", "vlp16"), ("street", "os64"))


def say(*words):
    print(*words, file=sys.stderr, flush=True)


def machine():
    lines = open("/proc/cpuinfo").read().splitlines()
    model = next((line.split(":")[1].strip() for line in lines if line.startswith("model name")), "unknown processor")
    return f"{os.cpu_count()} cores of {model}"


def kernels(_):
    """Each inner loop beside the roofline measured in the same run."""
    say("kernels")
    result = json.loads(call(BUILD / "kernels", "--benchmark_format=json", "--benchmark_min_time=0.3"))
    context = result["context"]
    rows = [[b["name"].replace("_", " "), f"{b['items/s'] / 1e6:.1f}", f"{100 * b['roofline']:.0f}"]
            for b in result["benchmarks"]]
    return (f"`build/release/kernels` measures each kernel with one thread on a machine with {machine()}. The roofline is the bound that memory and "
            f"arithmetic set. It is measured in the same run: a copy moves {float(context['copy'].split()[0]):.0f} GB/s, and multiply-adds reach "
            f"{float(context['multiply-add'].split()[0]):.0f} Gflop/s. From both follow two shortest possible times of a kernel. The share of the roofline "
            "is the longer of these two over the measured time. A share of more than 100 % means that the data stay in the cache.\n\n" +
            table(["kernel", "million items/s", "of its roofline [%]"], rows))


def stage_rates(preset, timing):
    """Of the two main stages, with what they count."""
    stages = {"default": (("judge", "scans"), ("integrate", "scans")), "paper": (("front_end", "scans"), ("back_end", "submaps"))}[preset]
    return [f"{statistics.median(t[stage][f'{item}_per_second'] for t in timing):.0f} {item}" for stage, item in stages]


def without_truth(recording):
    """The same scans and poses, without labels."""
    bare = recording.with_name(recording.name + "-without-truth")
    if not bare.exists():
        bare.mkdir()
        for name in ("velodyne", "poses.txt", "times.txt"):
            (bare / name).symlink_to(recording / name)
    return bare


def copy_rate(bench, recording):
    """Scans per second of a plain copy of the recording's scans."""
    scans = recording / "velodyne"
    rates = []
    for _ in range(3):
        start = time.monotonic()
        shutil.copytree(scans, bench.work / "copy")
        rates.append(len(list(scans.iterdir())) / (time.monotonic() - start))
        shutil.rmtree(bench.work / "copy")
    return statistics.median(rates)


def middle(timing, key):
    return statistics.median(t[key] for t in timing)


def sequences(bench):
    """Whole processes, from start to the last file, beside OctoMap's insertion and a copy of the same scans."""
    rows, stages = [], []
    for scene, sensor in CASES:
        recording = simulated(bench, scene, sensor, 1)
        octomap = json.loads(call(BUILD / "octomap_peer", recording, 10))["scans_per_second"]
        copied = copy_rate(bench, recording)
        say("octomap", recording.name)
        for preset, truth in (("default", False), ("default", True), ("paper", False)):
            results = [run(bench, recording if truth else without_truth(recording), preset=preset) for _ in range(3)]
            timing = [r["timing"] for r in results]
            scans = results[0]["metrics"]["scans"]
            rate = middle(timing, "scans_per_second")
            cores = statistics.median(t["cpu_seconds"] / t["wall_seconds"] for t in timing)
            rows.append([scene, sensor, preset, "yes" if truth else "no", f"{rate:.1f}", f"{1e3 * middle(timing, 'cpu_seconds') / scans:.1f}",
                         f"{cores:.2f}", f"{max(t['peak_rss_bytes'] for t in timing) / 1e6:.0f}", *stage_rates(preset, timing),
                         f"{rate / octomap:.0f}", f"{100 * rate / copied:.0f}"])
            if preset == "default":
                for stage in timing[0]["process"]:
                    of_stage = [next(p for p in t["process"] if p["stage"] == stage["stage"]) for t in timing]
                    stages.append([scene, sensor, "yes" if truth else "no", stage["stage"], f"{middle(of_stage, 'wall_seconds'):.2f}",
                                   f"{1e3 * middle(of_stage, 'cpu_seconds') / scans:.1f}"])
    return ("`script/bench --only sequences` measures `dynamicfilter run` as a whole process, from start to exit. The figures are the median of three runs. "
            "A run includes reading, refined poses where they are needed, verdicts, labels, both maps, the "
            "report, and scores where there is ground truth. OctoMap ran in the same session, with one thread, and inserted every tenth scan at 0.2 m. "
            "The last column compares with a plain copy of the scans. The rates of the two stages are items per wall second in which the stage was busy.\n\n" +
            table(["scene", "sensor", "preset", "ground truth", "scans/s", "CPU [ms/scan]", "cores busy", "memory [MB]", "judge / front-end alone",
                   "integrate / back-end alone", "times OctoMap", "of a copy's rate [%]"], rows) +
            "\nThe next table shows the stages of the same runs with the default preset (`process` in `timing.json`). The stage `prepare` chooses poses and "
            "deskewing. It takes the same time for a recording of any length.\n\n" +
            table(["scene", "sensor", "ground truth", "stage", "wall [s]", "CPU [ms/scan]"], stages))


def threads(bench):
    """One thread and two, and what follows for more."""
    rows = []
    for scene, sensor in CASES:
        recording = without_truth(simulated(bench, scene, sensor, 1))
        wall = [statistics.median(run(bench, recording, preset="default", options=["--threads", n])["timing"]["wall_seconds"] for _ in range(3))
                for n in (1, 2)]
        serial = max(0.0, 2.0 * wall[1] / wall[0] - 1.0)  # Amdahl
        expected = [1.0 / (serial + (1.0 - serial) / n) for n in (4, 8)]
        rows.append([scene, sensor, f"{wall[0]:.1f}", f"{wall[1]:.1f}", f"{100 * serial:.0f}", *[f"{e:.1f}" for e in expected]])
    return ("`script/bench --only threads` measures whole processes with `--threads 1` and `--threads 2`, as the median of three runs. In both cases, reading "
            "ahead has a thread of its own. The serial share follows from the two times by Amdahl's law. The last two columns follow from the serial share. "
            "Four and eight threads were not measured.\n\n" +
            table(["scene", "sensor", "one thread [s]", "two [s]", "serial [%]", "four would be x times as fast", "eight"], rows))


def looped(bench, street, scans):
    """The street driven up and down until there are so many scans."""
    folder = bench.work / f"{street.name}-looped-{scans}"
    if folder.exists():
        return folder
    poses = (street / "poses.txt").read_text().splitlines()
    files = sorted((street / "velodyne").iterdir())
    there_and_back = list(range(len(files))) + list(range(len(files) - 2, 0, -1))
    order = [there_and_back[i % len(there_and_back)] for i in range(scans)]
    (folder / "velodyne").mkdir(parents=True)
    for i, k in enumerate(order):
        (folder / "velodyne" / f"{i:06}.bin").symlink_to(files[k].resolve())
    (folder / "poses.txt").write_text("".join(poses[k] + "\n" for k in order))
    (folder / "times.txt").write_text("".join(f"{0.1 * i:.3f}\n" for i in range(scans)))
    return folder


def lengths(bench):
    """What grows with the number of scans, and not with the map."""
    rows = []
    for sensor in ("vlp16", "os64"):
        street = without_truth(simulated(bench, "street", sensor, 1))
        for scans in (300, 600, 3000):
            timing = run(bench, looped(bench, street, scans), preset="default")["timing"]
            rows.append([sensor, scans, f"{timing['voxels'] / 1e3:.0f}", f"{timing['peak_rss_bytes'] / 1e6:.0f}",
                         f"{1e3 * timing['cpu_seconds'] / scans:.1f}"])
    return ("`script/bench --only lengths` drives up and down a street repeatedly, which has 300 scans.\n\n" +
            table(["sensor", "scans", "voxels [10^3]", "memory [MB]", "CPU [ms/scan]"], rows))


def floor(bench):
    """Each stage beside the least that its task needs."""
    rows = []
    for scene, sensor in CASES:
        recording = without_truth(simulated(bench, scene, sensor, 1))
        results = [run(bench, recording, preset="default") for _ in range(3)]
        scans = results[0]["metrics"]["scans"]
        plain = []
        for _ in range(3):
            plain.append(json.loads(call(BUILD / "plain", recording, bench.work / "out", bench.work / "plain")))
            shutil.rmtree(bench.work / "plain")
        least = {part: statistics.median(p[part] for p in plain) for part in plain[0]}

        def ours(*names):
            return statistics.median(sum(1e3 * p["cpu_seconds"] / scans for p in r["timing"]["process"] if p["stage"] in names) for r in results)

        def add(stage, *parts, of):
            floor_ms, our_ms = sum(least[part] for part in parts), ours(*of)
            rows.append([scene, sensor, stage, f"{floor_ms:.1f}" if parts else "-", f"{our_ms:.1f}", f"{our_ms / floor_ms:.1f}" if parts else "-"])

        filtering, writing = ("voxels", "image", "questions"), ("read", "transform", "write")
        add("prepare", of=["prepare"])
        add("filter", *filtering, of=["filter"])
        add("write and report", *writing, of=["write", "report"])
        add("whole run", *filtering, *writing, of=["prepare", "filter", "write", "report"])
    return ("`build/release/plain RECORDING RESULT OUT` does the least that a run needs, in the plainest way and with one thread: it reads the scans, "
            "transforms their points, and writes the labels and both maps, whose labels it takes from a finished run. That is the floor of *write and report*. "
            "The floor of *filter* is to find the voxel of each point, to make a range image of each scan, and to compare each known voxel within 50 m with the "
            "image of each scan: for the street, "
            f"{least['points'] / 1e3:.0f},000 points and {least['asked'] / 1e3:.0f},000 comparisons a scan. Our filter compares more: each new voxel also with "
            "earlier scans. What is left of it are alignment, objects, votes of neighbours, and contacts. All figures are CPU time in ms a scan, medians of three "
            "runs; `script/bench --only floor` measures them.\n\n" +
            table(["scene", "sensor", "stage", "least", "a run", "times"], rows))


def online(bench):
    """Latency at the sensor's rate, and what ten times too many scans do."""
    rows = []
    for scene, sensor in CASES:
        recording = simulated(bench, scene, sensor, 1)
        result = run(bench, recording, preset="default", options=["--online"])
        timing, scans = result["timing"], result["metrics"]["scans"]
        latency = timing["stages"]["latency"]
        rows.append([scene, sensor, f"{latency['p50']:.1f}", f"{latency['p99']:.1f}", timing["online"]["dropped"],
                     f"{100 * timing['cpu_seconds'] / (0.1 * scans):.0f}"])
    text = ("The command is `dynamicfilter run --online` at 10 Hz. The latency is the time from the arrival of a scan to its instant verdict, which comes "
            "together with the scan. The share of one core includes reading, writing and the final verdicts.\n\n" +
            table(["scene", "sensor", "latency p50 [ms]", "p99 [ms]", "dropped", "of one core [%]"], rows))
    say("overload")
    result = json.loads(call(BUILD / "replay", simulated(bench, *CASES[0], 1), "overload", 60))
    return text + (
        f"\n`build/release/replay RECORDING overload 60` measures an overload with the crowd and a VLP-16. A single scan takes {result['alone_ms']:.1f} ms. "
        f"For a minute, {result['sent_per_second']:.0f} scans per second arrive, which is ten times the rate that this time allows. The filter judges "
        f"{result['judged_per_second']:.0f} scans per second and drops the rest. A scan is {result['age_p50_ms']:.1f} ms old (p50) when its verdict comes, "
        f"and {result['age_p99_ms']:.1f} ms (p99). The last scan is dropped "
        f"{result['recovery_seconds']:.2f} s after the load ends. The counters were exact at every push: {'yes' if result['counters_exact'] else 'NO'} "
        f"({result['in']} = {result['processed']} + {result['dropped']} + {result['rejected']}).\n")


def scaling(bench):
    """Time and memory with scans, points and voxels."""
    rows = []

    def add(what, recording, settings=(), options=()):
        result = run(bench, recording, settings, preset="default", options=options)
        timing, metrics = result["timing"], result["metrics"]
        points = sum(metrics["points"].values()) / metrics["scans"]
        rows.append([what, metrics["scans"], f"{points / 1e3:.0f}", f"{timing['voxels'] / 1e3:.0f}",
                     f"{1e3 * timing['cpu_seconds'] / metrics['scans']:.1f}", f"{timing['peak_rss_bytes'] / 1e6:.0f}"])

    street = simulated(bench, "street", "os64", 1)
    for last in (74, 149, 299):
        add("scans", street, options=["--last", last])
    for sensor in ("vlp16", "hdl32", "os64", "os128"):
        add(f"points: {sensor}", simulated(bench, "street", sensor, 1))
    for size in (0.4, 0.2, 0.1):
        add(f"voxels of {size} m", street, settings=[f"map.voxel_size={size}"])
    return ("All rows are of the street with the default preset and with ground truth. The first column says what changes from row to row.\n\n" +
            table(["", "scans", "points a scan [10^3]", "voxels [10^3]", "CPU [ms/scan]", "memory [MB]"], rows))


def hours(bench, hours):
    """Memory and time over hours."""
    rows = json.loads(call(BUILD / "replay", simulated(bench, "street", "vlp16", 1), "hours", hours))
    third = len(rows) // 3

    def mean(part, key):
        return statistics.mean(row[key] for row in part)

    def most(part):
        return max(row["resident_mib"] for row in part)

    first, last = mean(rows[:third], "ms_per_scan"), mean(rows[-third:], "ms_per_scan")
    return (f"`build/release/replay RECORDING hours {hours:g}` replays the street with a VLP-16 repeatedly through the online filter, as fast as it can. "
            f"Each round begins where the last one ended, and the horizon is 200 m. The memory rises and falls because the filter cuts the map at the "
            f"horizon. The maximum is {most(rows[:third]):.0f} MiB in the first third, {most(rows[third:-third]):.0f} in the second and "
            f"{most(rows[-third:]):.0f} in the last. A scan takes "
            f"{first:.2f} ms in the first third and {last:.2f} ms in the last ({100 * (last / first - 1):+.1f} %).\n\n" +
            table(["hours", "resident [MiB]", "voxels [10^3]", "ms/scan"],
                  [[f"{r['hours']:.2f}", f"{r['resident_mib']:.0f}", f"{r['voxels'] / 1e3:.0f}", f"{r['ms_per_scan']:.2f}"] for r in rows]))


SECTIONS = [kernels, sequences, floor, threads, online, scaling, lengths]
