# SPDX-License-Identifier: MIT
import struct

from case import FEW, MANY, NAN, POINTS, bad, good, rows, text

FIRST = "# .PCD v0.7 - Point Cloud Data file format\nVERSION 0.7\n"


def header(data="ascii", points=FEW, **changed):
    """Of three floats a point; a line that is None is left out."""
    lines = {"FIELDS": "x y z", "SIZE": "4 4 4", "TYPE": "F F F", "COUNT": "1 1 1",
             "WIDTH": points, "HEIGHT": 1, "VIEWPOINT": "0 0 0 1 0 0 0", "POINTS": points, "DATA": data}
    lines.update(changed)
    return FIRST + "".join(f"{key} {value}\n" for key, value in lines.items() if value is not None)


def binary(body=rows(POINTS), **changed):
    return header("binary", **changed).encode() + body


def packed(stream, expanded, size=None, **changed):
    sizes = struct.pack("<II", len(stream) if size is None else size, expanded)
    return header("binary_compressed", **changed).encode() + sizes + stream


def columns(points):
    return b"".join(struct.pack(f"<{len(points)}f", *column) for column in zip(*points))


def literals(block):
    """LZF that repeats nothing."""
    parts = (block[at:at + 32] for at in range(0, len(block), 32))
    return b"".join(bytes([len(part) - 1]) + part for part in parts)


REPEATS = b"\0\0" + b"\xe0\xff\0" * 6  # one zero, then 264 of them six times

BEGINNINGS = [
    bad("pcd empty", b""),
    bad("pcd one byte", b"#"),
    bad("pcd first line only", FIRST),
    bad("pcd no DATA line", header(DATA=None)),
    bad("pcd header only", header("binary")),
    bad("pcd cut within a point", binary(rows(POINTS)[:30]), POINTS[:2]),
    bad("pcd cut between points", binary(rows(POINTS)[:24]), POINTS[:2]),
    bad("pcd random bytes", bytes(i * 167 % 256 for i in range(1000))),
]

COUNTS = [
    bad("pcd 2^32-1 points", header("binary", MANY).encode() + rows(POINTS), POINTS),
    bad("pcd 2^32-1 points ascii", header(points=MANY) + text(POINTS), POINTS),
    bad("pcd WIDTH -1", binary(WIDTH=-1, POINTS=-1)),
    bad("pcd POINTS abc", binary(POINTS="abc"), POINTS),
    bad("pcd WIDTH x HEIGHT overflows", binary(WIDTH=2**31, HEIGHT=2**31, POINTS=2**62), POINTS),
    bad("pcd WIDTH 2^64", binary(WIDTH=2**64, POINTS=2**64), POINTS),
    bad("pcd WIDTH 2 POINTS 3", binary(WIDTH=2), POINTS),
    bad("pcd no counts", binary(WIDTH=None, HEIGHT=None, POINTS=None), POINTS),
]

FIELDS = [
    bad("pcd no FIELDS", binary(FIELDS=None)),
    bad("pcd SIZE 3", binary(SIZE="3 4 4")),
    bad("pcd SIZE -4", binary(SIZE="-4 4 4")),
    bad("pcd two SIZEs for three fields", binary(SIZE="4 4")),
    bad("pcd TYPE Q", binary(TYPE="Q F F")),
    bad("pcd COUNT 0", binary(COUNT="0 1 1")),
    bad("pcd COUNT 10^9", binary(COUNT="1000000000 1 1")),
    bad("pcd COUNT -1", binary(COUNT="-1 1 1")),
    bad("pcd no x y z", binary(FIELDS="a b c")),
    bad("pcd no y", binary(FIELDS="x a z")),
    bad("pcd x twice", binary(FIELDS="x x z")),
    bad("pcd DATA zip", header("zip") + text(POINTS), POINTS),
]

TEXTS = [
    bad("pcd ascii junk", header() + "1.5 2.5 3.5\nabc 5 6\n7 -8.5 9\n", POINTS[:1]),
    bad("pcd ascii short line", header() + "1.5 2.5 3.5\n-4.25 5\n7 -8.5 9\n", POINTS[:1]),
    bad("pcd ascii decimal comma", header() + text(POINTS).replace(".", ",")),
    bad("pcd ascii too few lines", header() + text(POINTS[:2]), POINTS[:2]),
]

LZF = [
    bad("pcd lzf 4 GB of 20 bytes", packed(REPEATS, 2**32 - 4, points=(2**32 - 4) // 12)),
    bad("pcd lzf 1 GB of 20 bytes", packed(REPEATS, 2**30 - 4, points=(2**30 - 4) // 12)),
    bad("pcd lzf size beyond points", packed(REPEATS, 2**32 - 4)),
    bad("pcd lzf cut", packed(literals(columns(POINTS))[:-10], 36)),
    bad("pcd lzf stream beyond file", packed(literals(columns(POINTS)), 36, size=10**6), POINTS),
    bad("pcd lzf repeat before start", packed(b"\xe0\xff\xff" * 8, 36)),
    bad("pcd lzf without sizes", header("binary_compressed")),
]

X_LAST = b"".join(struct.pack("<4f", z, 0.5, x, y) for x, y, z in POINTS)
PADDED = b"".join(struct.pack("<3f10x", *point) for point in POINTS)
HOLED = [POINTS[0], (NAN, NAN, NAN), POINTS[2], POINTS[1]]

VALID = [
    good("pcd binary", binary(), POINTS),
    good("pcd ascii", header() + text(POINTS), POINTS),
    good("pcd ascii CRLF", (header() + text(POINTS)).replace("\n", "\r\n"), POINTS),
    good("pcd ascii nan", header() + "1.5 2.5 3.5\nnan nan nan\n7 -8.5 9\n", [HOLED[i] for i in (0, 1, 2)]),
    good("pcd ascii exponents", header() + "15e-1 +2.5 3.5E0\n-4.25 5e0 6.0\n7 -8.5 9\n", POINTS),
    good("pcd no points", header("binary", 0), []),
    good("pcd no COUNT", binary(COUNT=None), POINTS),
    good("pcd organised with nan", binary(rows(HOLED), WIDTH=2, HEIGHT=2, POINTS=4), HOLED),
    good("pcd padding of COUNT 0", binary(FIELDS="x y z _", SIZE="4 4 4 1", TYPE="F F F U",
                                          COUNT="1 1 1 0"), POINTS),
    good("pcd padding of COUNT 10", binary(PADDED, FIELDS="x y z _", SIZE="4 4 4 1", TYPE="F F F U",
                                           COUNT="1 1 1 10"), POINTS),
    good("pcd z i x y", binary(X_LAST, FIELDS="z intensity x y", SIZE="4 4 4 4", TYPE="F F F F",
                               COUNT="1 1 1 1"), POINTS),
    good("pcd float64", binary(rows(POINTS, "d"), SIZE="8 8 8"), POINTS),
    good("pcd lzf", packed(literals(columns(POINTS)), 36), POINTS),
]

CASES = BEGINNINGS + COUNTS + FIELDS + TEXTS + LZF + VALID
