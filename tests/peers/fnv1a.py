# SPDX-License-Identifier: MIT
import struct


def fnv1a(values):
    """The sum that sample.hpp prints of the same numbers."""
    hash_ = 0x811C9DC5
    for byte in struct.pack(f"<{len(values)}d", *values):
        hash_ = (hash_ ^ byte) * 0x01000193 & 0xFFFFFFFF
    return f"{hash_:08x}"
