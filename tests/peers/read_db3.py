# SPDX-License-Identifier: MIT
"""Prints what Python's SQLite finds in a bag, as read_bag.cjs does for the other kinds."""
import sqlite3
import struct
import sys

from fnv1a import fnv1a


class Cdr:
    """Little-endian CDR; alignment counts from behind the four bytes of its head."""

    def __init__(self, data):
        assert data[:4] == b"\0\1\0\0", data[:4]
        self.data, self.at = data[4:], 0

    def number(self, kind):
        size = struct.calcsize(kind)
        self.at += -self.at % size
        self.at += size
        return struct.unpack_from("<" + kind, self.data, self.at - size)[0]

    def bytes(self):
        size = self.number("I")
        self.at += size
        return self.data[self.at - size:self.at]

    def text(self):
        raw = self.bytes()
        assert raw.endswith(b"\0")
        return raw[:-1].decode()

    def header(self):
        stamp = self.number("i") * 10**9 + self.number("I")
        return stamp, self.text()


def point_values(cdr):
    height, width = cdr.number("I"), cdr.number("I")
    fields = {}
    for _ in range(cdr.number("I")):
        name = cdr.text()
        offset, kind, _ = cdr.number("I"), cdr.number("B"), cdr.number("I")
        fields[name] = (offset, {7: "<f", 8: "<d"}.get(kind))
    assert cdr.number("B") == 0
    step, row_step = cdr.number("I"), cdr.number("I")
    data = cdr.bytes()
    assert row_step == step * width and len(data) == row_step * height
    columns = [fields[name] for name in ("x", "y", "z", "intensity")]
    return [struct.unpack_from(kind, data, at + offset)[0]
            for at in range(0, len(data), step) for offset, kind in columns]


def read(kind, data):
    cdr = Cdr(data)
    if kind == "tf2_msgs/msg/TFMessage":
        assert cdr.number("I") == 1
    stamp, frame = cdr.header()
    if kind == "sensor_msgs/msg/PointCloud2":
        return stamp, frame, point_values(cdr)
    if kind == "nav_msgs/msg/OccupancyGrid":
        assert cdr.number("i") * 10**9 + cdr.number("I") == stamp
        values = [cdr.number("f"), cdr.number("I"), cdr.number("I")]
        values += [cdr.number("d") for _ in range(7)][:3]
        return stamp, frame, values + list(struct.unpack("b" * len(data := cdr.bytes()), data))
    if kind != "geometry_msgs/msg/PoseStamped":
        cdr.text()
    return stamp, frame, [cdr.number("d") for _ in range(7)]


database = sqlite3.connect(f"file:{sys.argv[1]}?mode=ro", uri=True)
assert database.execute("PRAGMA integrity_check").fetchall() == [("ok",)]
assert database.execute("SELECT schema_version FROM schema").fetchall() == [(4,)]
defined = {t for (t,) in database.execute("SELECT topic_type FROM message_definitions")}
rows = database.execute(
    "SELECT name, type, serialization_format, offered_qos_profiles, timestamp, data FROM messages "
    "JOIN topics ON topics.id = topic_id ORDER BY timestamp")
for topic, kind, encoding, qos, recorded, data in rows:
    assert encoding == "cdr" and kind in defined and "durability" in qos
    stamp, frame, values = read(kind, data)
    print(topic, kind.replace("/msg/", "/"), recorded, stamp, frame, len(values), fnv1a(values))
