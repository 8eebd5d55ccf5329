# SPDX-License-Identifier: MIT
import struct

from case import FEW, MANY, NAN, POINTS, bad, good, rows, text

XYZ = "".join(f"property float {axis}\n" for axis in "xyz")
FACE = "element face 1\nproperty list uchar int vertex_indices\n"
LITTLE, BIG = "binary_little_endian", "binary_big_endian"


def header(form="ascii", points=FEW, properties=XYZ, before=""):
    return f"ply\nformat {form} 1.0\n{before}element vertex {points}\n{properties}end_header\n"


def binary(body=rows(POINTS), form=LITTLE, **changed):
    return header(form, **changed).encode() + body


LIST_X = XYZ.replace("float x", "list uchar float x")

BEGINNINGS = [
    bad("ply empty", b""),
    bad("ply first line only", "ply\n"),
    bad("ply no end_header", header().replace("end_header\n", "")),
    bad("ply header only", header(LITTLE)),
    bad("ply cut within a point", binary(rows(POINTS)[:30]), POINTS[:2]),
    bad("ply no format", header().replace("format ascii 1.0\n", "") + text(POINTS), POINTS),
    bad("ply unknown format", header("binary_middle_endian").encode() + rows(POINTS), POINTS),
]

COUNTS = [
    bad("ply 2^32-1 vertices", binary(points=MANY), POINTS),
    bad("ply 2^32-1 vertices ascii", header(points=MANY) + text(POINTS), POINTS),
    bad("ply 2^63 vertices", binary(points=2**63), POINTS),
    bad("ply -1 vertices", binary(points=-1)),
    bad("ply abc vertices", binary(points="abc")),
]

PROPERTIES = [
    bad("ply no vertices", "ply\nformat ascii 1.0\n" + FACE + "end_header\n3 0 1 2\n"),
    bad("ply no x y z", binary(properties=XYZ.replace("float ", "float no_"))),
    bad("ply x only", header(properties="property float x\n") + "1.5\n-4.25\n7\n"),
    bad("ply x a list", binary(b"".join(b"\1" + rows([p]) for p in POINTS), properties=LIST_X), POINTS),
    bad("ply list of a vertex cut", binary(rows(POINTS[:1]) + b"\2\7", points=1,
                                           properties=XYZ + "property list uchar uchar view\n"), POINTS[:1]),
    bad("ply unknown type", binary(properties=XYZ.replace("float x", "quad x"))),
    bad("ply property before element", "ply\nformat ascii 1.0\n" + XYZ + "end_header\n" + text(POINTS)),
    bad("ply 2^32-1 faces first", binary(before=FACE.replace("1", str(MANY), 1))),
    bad("ply list of 2^31 first", binary(struct.pack("<I", 2**31) + rows(POINTS),
                                         before=FACE.replace("uchar", "uint"))),
]

TEXTS = [
    bad("ply ascii junk", header() + "1.5 2.5 3.5\nabc 5 6\n7 -8.5 9\n", POINTS[:1]),
    bad("ply ascii short line", header() + "1.5 2.5 3.5\n-4.25 5\n7 -8.5 9\n", POINTS[:1]),
    bad("ply ascii decimal comma", header() + text(POINTS).replace(".", ",")),
    bad("ply ascii too few lines", header() + text(POINTS[:2]), POINTS[:2]),
]

NAMED = "comment a word\nobj_info 3\n"
MANY_NAMES = "".join(f"property uchar p{i}\n" for i in range(1000)) + XYZ
WIDE = b"".join(b"\7" * 1000 + rows([point]) for point in POINTS)

VALID = [
    good("ply little endian", binary(), POINTS),
    good("ply big endian", binary(rows(POINTS, order=">"), BIG), POINTS),
    good("ply ascii", header(before=NAMED) + text(POINTS), POINTS),
    good("ply ascii CRLF", (header() + text(POINTS)).replace("\n", "\r\n"), POINTS),
    good("ply ascii nan", header() + "1.5 2.5 3.5\nnan nan nan\n7 -8.5 9\n",
         [POINTS[0], (NAN, NAN, NAN), POINTS[2]]),
    good("ply no points", header(LITTLE, 0), []),
    good("ply doubles", binary(rows(POINTS, "d"), properties=XYZ.replace("float", "double")), POINTS),
    good("ply faces first", binary(b"\3" + struct.pack("<3i", 0, 1, 2) + rows(POINTS), before=FACE), POINTS),
    good("ply ascii faces first", header(before=FACE) + "3 0 1 2\n" + text(POINTS), POINTS),
    good("ply vertices with lists", binary(b"".join(rows([p]) + b"\2\7\7" for p in POINTS),
                                           properties=XYZ + "property list uchar uchar view\n"), POINTS),
    good("ply 1000 properties", binary(WIDE, properties=MANY_NAMES), POINTS),
]

CASES = BEGINNINGS + COUNTS + PROPERTIES + TEXTS + VALID
