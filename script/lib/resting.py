"""How long until the map shows that something left, or that it came to stay."""
import sys

from lib.bench import BUILD, call


def resting_table(bench):
    sensors = ["vlp16"] if bench.quick else ["vlp16", "os64"]
    print("resting", *sensors, file=sys.stderr, flush=True)
    return call(BUILD / "resting", *sensors)
