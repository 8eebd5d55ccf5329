"""Speed, latency and memory: the sections of docs/performance.md."""
import json
import os
import statistics
import sys

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
    return (f"\n## Kernels\n\n`build/release/kernels`, one thread, {machine()}. The roofline is measured in the same run: a copy moves "
            f"{float(context['copy'].split()[0]):.0f} GB/s, multiply-adds reach {float(context['multiply-add'].split()[0]):.0f} Gflop/s; "
            "a kernel's share is the longer of its two least times over its time. More than 100 % means that the data stay in the cache.\n\n" +
            table(["kernel", "million items/s", "of its roofline [%]"], rows))


def stage_rates(preset, timing):
    """Of the two main stages, with what they count."""
    stages = {"default": (("judge", "scans"), ("integrate", "scans")), "paper": (("front_end", "scans"), ("back_end", "submaps"))}[preset]
    return [f"{statistics.median(t[stage][f'{item}_per_second'] for t in timing):.0f} {item}" for stage, item in stages]


def sequences(bench):
    """Whole runs beside OctoMap's insertion of the same scans."""
    rows = []
    for scene, sensor in CASES:
        recording = simulated(bench, scene, sensor, 1)
        octomap = json.loads(call(BUILD / "octomap_peer", recording, 10))["scans_per_second"]
        say("octomap", recording.name)
        for preset in ("default", "paper"):
            results = [run(bench, recording, preset=preset) for _ in range(3)]
            timing = [r["timing"] for r in results]
            scans = results[0]["metrics"]["scans"]
            rate = statistics.median(t["scans_per_second"] for t in timing)
            rows.append([scene, sensor, preset, f"{rate:.1f}",
                         f"{1e3 * statistics.median(t['cpu_seconds'] for t in timing) / scans:.1f}",
                         *stage_rates(preset, timing),
                         f"{max(t['peak_rss_bytes'] for t in timing) / 1e6:.0f}", f"{octomap:.2f}", f"{rate / octomap:.0f}"])
    return ("\n## Whole sequences\n\n`script/bench --only sequences`: `dynamicfilter run`, reading, writing and labels included, median of three; OctoMap "
            "is the insertion alone, of every tenth of the same scans at 0.2 m, one thread. Stages: items per busy wall second; the default preset judges and integrates scans, the paper's back-end integrates submaps.\n\n" +
            table(["scene", "sensor", "preset", "scans/s", "CPU [ms/scan]", "judge / front-end [scans/s]", "integrate / back-end", "memory [MB]",
                   "OctoMap [scans/s]", "ratio"], rows))


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
    text = ("\n## Online\n\n`dynamicfilter run --online`, 10 Hz: from the scan's arrival to its instant verdict; the share of one core includes reading, "
            "writing and the final verdicts.\n\n" +
            table(["scene", "sensor", "latency p50 [ms]", "p99 [ms]", "dropped", "of one core [%]"], rows))
    say("overload")
    result = json.loads(call(BUILD / "replay", simulated(bench, *CASES[0], 1), "overload", 60))
    return text + (
        f"\nOverload, `build/release/replay RECORDING overload 60` (crowd, VLP-16): a scan alone takes {result['alone_ms']:.1f} ms; ten times as many as "
        f"that allows come, {result['sent_per_second']:.0f} a second, for a minute. {result['judged_per_second']:.0f} a second are judged, the rest is "
        f"dropped. Age of what comes out: p50 {result['age_p50_ms']:.1f} ms, p99 {result['age_p99_ms']:.1f} ms. The last scan is dropped "
        f"{result['recovery_seconds']:.2f} s after the load ends. Counters exact at every push: {'yes' if result['counters_exact'] else 'NO'} "
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
    return ("\n## Scaling\n\nThe street, default preset.\n\n" +
            table(["", "scans", "points a scan [10^3]", "voxels [10^3]", "CPU [ms/scan]", "memory [MB]"], rows))


def long_replay(bench, hours):
    """Memory and time over hours."""
    rows = json.loads(call(BUILD / "replay", simulated(bench, "street", "vlp16", 1), "hours", hours))
    third = len(rows) // 3

    def mean(part, key):
        return statistics.mean(row[key] for row in part)

    def most(part):
        return max(row["resident_mib"] for row in part)

    first, last = mean(rows[:third], "ms_per_scan"), mean(rows[-third:], "ms_per_scan")
    return (f"\n## Hours\n\n`build/release/replay RECORDING hours {hours:g}`: the street with a VLP-16, again and again, each round beginning where the last "
            f"ended, through the online filter as fast as it can, horizon 200 m. Memory goes up and down as the map is cut; at most it is "
            f"{most(rows[:third]):.0f} MiB in the first third, {most(rows[third:-third]):.0f} in the second, {most(rows[-third:]):.0f} in the last. A scan takes "
            f"{first:.2f} ms in the first third and {last:.2f} ms in the last ({100 * (last / first - 1):+.1f} %).\n\n" +
            table(["hours", "resident [MiB]", "voxels [10^3]", "ms/scan"],
                  [[f"{r['hours']:.2f}", f"{r['resident_mib']:.0f}", f"{r['voxels'] / 1e3:.0f}", f"{r['ms_per_scan']:.2f}"] for r in rows]))


SECTIONS = [kernels, sequences, online, scaling]
