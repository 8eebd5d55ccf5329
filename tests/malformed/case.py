# SPDX-License-Identifier: MIT
"""A file, and what a reader may say of it."""
import math
import struct
from dataclasses import dataclass

NAN = math.nan
POINTS = [(1.5, 2.5, 3.5), (-4.25, 5.0, 6.0), (7.0, -8.5, 9.0)]
FEW, MANY = 3, 2**32 - 1


@dataclass
class Case:
    name: str
    data: bytes
    points: list  # that the file holds; of a bad one, those before the defect
    valid: bool

    @property
    def file(self):
        return self.name.replace(" ", "_") + "." + self.kind

    @property
    def kind(self):
        return self.name.split()[0]


def bad(name, data, points=()):
    return Case(name, data if isinstance(data, bytes) else data.encode(), list(points), False)


def good(name, data, points):
    return Case(name, data if isinstance(data, bytes) else data.encode(), list(points), True)


def rows(points, letter="f", order="<"):
    return b"".join(struct.pack(f"{order}3{letter}", *point) for point in points)


def text(points):
    return "".join(" ".join(f"{value:g}" for value in point) + "\n" for point in points)
