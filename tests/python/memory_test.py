# SPDX-License-Identifier: MIT
"""Pushing does not leak: what grows is the map, and here it does not."""
import os
import unittest

from support import df, main, np, small_scan


def resident():
    """[bytes]"""
    with open("/proc/self/statm") as file:
        return int(file.read().split()[1]) * os.sysconf("SC_PAGE_SIZE")


class Memory(unittest.TestCase):
    @unittest.skipUnless(os.path.exists("/proc/self/statm"), "needs /proc")
    def test_ten_thousand_pushes(self):
        filter, points = df.DynamicFilter(keep=10, threads=1), small_scan()
        for i in range(15000):
            filter.push(points, np.eye(4), 0.1 * i)
            if i % 100 == 0:
                filter.labels(i)
                filter.static_map()
            if i == 5000: before = resident()  # 400 keyframes and 4096 times are kept, no more
        # 10,000 arrays of labels would be 3 MB, of points 36 MB.
        self.assertLess(resident() - before, 1e6)


if __name__ == "__main__":
    main()
