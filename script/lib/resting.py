"""How long until the map shows that something left, or that it came to stay."""
import sys

from lib.bench import BUILD, call


def resting_table(bench):
    sensors = ["vlp16"] if bench.quick else ["vlp16", "os64"]
    print("resting", *sensors, file=sys.stderr, flush=True)
    return (f"\n## Default preset: what rests\n\n`build/release/resting {' '.join(sensors)}`: people who stand 7 m from the middle of a yard, 5 scans "
            "a second for 150 s, the sensor in the middle or walking to and fro over 10 m at 1 m/s. First those who stand there from the start and "
            "leave after so many seconds: seconds until at most 10 % of their voxels are in the map. Then those who come to a place that was empty "
            "for so long, and stay: seconds until 90 % are. In brackets: the share that the map holds in the end. "
            "\"> 90\": not before the recording ended.\n\n" + call(BUILD / "resting", *sensors))
