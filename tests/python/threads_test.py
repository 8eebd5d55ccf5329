# SPDX-License-Identifier: MIT
"""Filters work side by side, and other threads of Python go on meanwhile."""
import threading
import time
import unittest

from support import df, frames, main, np, push_all


class Threads(unittest.TestCase):
    def test_two_filters(self):
        alone, found = push_all(df.DynamicFilter()), [None, None]

        def work(i):
            found[i] = push_all(df.DynamicFilter(threads=1 + i))

        threads = [threading.Thread(target=work, args=(i,)) for i in range(2)]
        for thread in threads: thread.start()
        for thread in threads: thread.join()
        for labels in found:
            for a, b in zip(labels, alone):
                np.testing.assert_array_equal(a, b)

    def test_one_filter_from_two_threads(self):
        filter = df.DynamicFilter()
        asking = threading.Event()

        def ask():
            while not asking.is_set():
                filter.local_map(radius=5.0)
                filter.corrections(newest=1)

        other = threading.Thread(target=ask)
        other.start()
        labels = push_all(filter)
        asking.set()
        other.join()
        for a, b in zip(labels, push_all(df.DynamicFilter())):
            np.testing.assert_array_equal(a, b)

    def test_the_lock_is_free_while_the_filter_works(self):
        # Who holds the lock gives it up once or twice around a call, so few ticks prove nothing.
        filter, ticks, stop = df.DynamicFilter(), [0], threading.Event()

        def tick():
            while not stop.is_set():
                ticks[0] += 1
                time.sleep(0.001)

        big = np.vstack([f.points + [0, 0, 0.01 * i] for i, f in enumerate(frames())]).astype("f4")
        other = threading.Thread(target=tick)
        other.start()
        seen = 0
        for i in range(5):
            before = ticks[0]
            filter.push(big, frames()[0].pose, float(i))
            seen += ticks[0] - before
        stop.set()
        other.join()
        self.assertGreater(seen, 20)


if __name__ == "__main__":
    main()
