"""Other methods on the same recordings."""
import json
import sys

from lib.bench import BUILD, call, cells, percent, run, simulated, table, voxel

OCTOMAP = BUILD / "octomap_peer"


def octomap(recording, stride=1):
    print("octomap", recording.name, "stride", stride, file=sys.stderr, flush=True)
    return json.loads(call(OCTOMAP, recording, stride))


def row(name, method, metrics, cpu, rate):
    point = [percent(metrics["point"][k]) for k in ("aa", "iou")]
    return [name, method, *cells(voxel({"metrics": metrics})), *point, f"{cpu:.0f}", f"{rate:.1f}"]


def peers_table(bench):
    """OctoMap takes almost a second a dense scan, so both get every second one."""
    if not OCTOMAP.exists():
        print("SKIPPED: OctoMap (install liboctomap-dev)", file=sys.stderr)
        return None
    rows = []
    for scene, sensor, stride in (("crowd", "vlp16", 1), ("street", "os64", 2), ("hall", "os64", 2)):
        stride *= 4 if bench.quick else 1
        recording = simulated(bench, scene, sensor, 1)
        name = f"{scene} {sensor}" + (f", one scan of {stride}" if stride > 1 else "")
        peer = octomap(recording, stride)
        rows.append(row(name, "OctoMap", peer, peer["cpu_seconds"], peer["scans_per_second_with_reading"]))
        ours = run(bench, recording, preset="default", options=("--stride", stride))
        rows.append(row(name, "default preset", ours["metrics"], ours["timing"]["cpu_seconds"],
                        ours["timing"]["scans_per_second"]))
    return table(["recording", "method", "PR [%]", "RR [%]", "F1", "AA [%]", "moving IoU [%]", "CPU [s]", "[scans/s]"], rows)
