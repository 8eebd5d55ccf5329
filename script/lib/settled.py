"""How good verdicts are that come with the scan, or some seconds after it."""
import sys

from lib.bench import BUILD, call

SCENES = [("a crowd of 100, VLP-16 at 5 Hz, 120 s", ("crowd", "vlp16", 100, 5, 120, 12)),
          ("a street, 64 beams at 10 Hz, 15 s", ("street", "os64", -1, 10, 15, 11)),
          ("the platform, VLP-16 at 5 Hz, 120 s", ("platform", "vlp16", -1, 5, 120, 12))]


def settled_table(bench):
    """Verdicts by the evidence that there was so many seconds after the scan."""
    tables = []
    for title, arguments in SCENES[:1] if bench.quick else SCENES:
        words = [str(a) for a in arguments]
        print("settled", *words, file=sys.stderr, flush=True)
        tables.append(f"{title[0].upper()}{title[1:]}, `settled {' '.join(words)}`:\n\n" + call(BUILD / "settled", *words))
    return "\n".join(tables)
