# SPDX-License-Identifier: MIT
"""The filter from Python says what the command says, keeps what it was asked to, and reports what
it refuses."""
import os
import subprocess
import unittest

from support import COMMAND, SCANS, df, frames, main, np, push_all, recording, scratch, small_scan


def labels_of_command(name, *options):
    folder = scratch(name)
    subprocess.run([COMMAND, "run", recording(), "-o", folder, *options], check=True,
                   capture_output=True)
    files = sorted(os.listdir(os.path.join(folder, "labels")))
    return [np.fromfile(os.path.join(folder, "labels", file), np.uint32) for file in files]


class AsTheCommand(unittest.TestCase):
    def compare(self, config, *options):
        filter = df.DynamicFilter(config)
        push_all(filter)
        filter.finish()
        expected = labels_of_command("-".join(["run", *options]), *options)
        self.assertEqual(len(expected), SCANS)
        self.assertTrue(any((labels == df.DYNAMIC).any() for labels in expected))
        for i, labels in enumerate(expected):
            self.assertEqual(filter.labels(i).astype(np.uint32).tobytes(), labels.tobytes())

    def test_default(self):
        self.compare(None)

    def test_paper(self):
        self.compare({"preset": "paper", "submap": {"keyframes": 5}},
                     "--preset", "paper", "--set", "submap.keyframes=5")


    def test_several_sensors(self):
        """Scans of two sensors of a vehicle, of which each is told to be that of its sensor."""
        rig = scratch("rig.toml")
        with open(rig, "w", encoding="utf-8") as file:
            for name, mount, delay in ("front", (0.5, 0, 0, 0, 0, 0), 0.0), ("rear", (-0.5, 0, 0, 0, 0, 180), 0.25):
                df.simulate("crowd", scratch(name), frames=8, mount=mount, delay=delay)
                file.write(f'[[sensor]]\nname = "{name}"\nrecording = "{name}"\n')
        filter, scans = df.DynamicFilter(), list(df.open_recording(rig))
        self.assertEqual([scan.sensor for scan in scans], [0, 1] * 8)
        for scan in scans:
            filter.push(scan.points, scan.pose, scan.stamp, sensor=scan.sensor)
        filter.finish()
        folder = scratch("of_rig")
        subprocess.run([COMMAND, "run", rig, "-o", folder, "--refine", "off", "--deskew", "off"], check=True, capture_output=True)
        for i in range(16):
            name = f"{('front', 'rear')[i % 2]}_{i // 2:06}.label"
            labels = np.fromfile(os.path.join(folder, "labels", name), np.uint32)
            self.assertEqual(filter.labels(i).astype(np.uint32).tobytes(), labels.tobytes())


class Corrections(unittest.TestCase):
    def follow(self, config):
        """Corrections lead from the instant labels to those that labels() tells."""
        filter, told = df.DynamicFilter(config), {}
        for i, frame in enumerate(frames()):
            told[i] = filter.push(frame.points, frame.pose, frame.stamp)
            told.update(filter.corrections())
        self.assertEqual(filter.corrections(), [])
        filter.finish()
        instant, final = dict(told), dict(filter.corrections())
        told.update(final)
        for i in told:
            np.testing.assert_array_equal(told[i], filter.labels(i))
        return instant

    def test_default(self):
        self.follow(None)

    def test_paper_tells_by_windows(self):
        told = self.follow({"preset": "paper", "submap.keyframes": 3})
        self.assertTrue(any((labels == df.DYNAMIC).any() for labels in told.values()))

    def test_only_the_newest(self):
        filter = df.DynamicFilter()
        push_all(filter)
        self.assertTrue(all(scan >= SCANS - 3 for scan, _ in filter.corrections(newest=3)))


class Keeping(unittest.TestCase):
    def test_none(self):
        filter = df.DynamicFilter(keep=False)
        push_all(filter)
        self.assertEqual(filter.corrections(), [])
        with self.assertRaisesRegex(IndexError, "not kept"):
            filter.labels(0)

    def test_the_newest(self):
        filter = df.DynamicFilter(keep=4)
        push_all(filter)
        self.assertEqual(len(filter), SCANS)
        self.assertEqual(len(filter.labels(SCANS - 4)), len(frames()[SCANS - 4].points))
        with self.assertRaises(IndexError):
            filter.labels(SCANS - 5)

    def test_nonsense(self):
        self.assertRaises(ValueError, df.DynamicFilter, keep=-1)
        self.assertRaises(TypeError, df.DynamicFilter, keep="all")


class Configuration(unittest.TestCase):
    def test_a_file(self):
        path = scratch("settings.toml")
        with open(path, "w") as file:
            file.write("[map]\nvoxel_size = 0.3\n")
        a, b = df.DynamicFilter(path), df.DynamicFilter({"map.voxel_size": 0.3})
        for left, right in zip(push_all(a), push_all(b)):
            np.testing.assert_array_equal(left, right)

    def test_mistakes(self):
        for config, pattern in (({"back_end.voxel_siz": 1}, "voxel_size"),
                                ({"map.voxel_size": -1}, "voxel_size"), ("papr", "paper"),
                                ("missing.toml", "missing.toml")):
            with self.assertRaisesRegex(df.ConfigError, pattern):
                df.DynamicFilter(config)
        self.assertRaises(TypeError, df.DynamicFilter, 5)
        self.assertRaisesRegex(ValueError, "threads", df.DynamicFilter, threads=100000)
        self.assertRaisesRegex(df.ConfigError, "a section", df.DynamicFilter, {"back_end": 3})
        df.DynamicFilter({"map.keep_unknown": np.bool_(True)})


class Course(unittest.TestCase):
    def test_static_map(self):
        filter = df.DynamicFilter()
        self.assertEqual(filter.static_map()[0].shape, (0, 3))
        push_all(filter)
        centers, probability = filter.static_map()
        self.assertEqual((centers.dtype, centers.shape[1]), (np.float64, 3))
        self.assertEqual(probability.shape, (len(centers),))
        self.assertGreater(len(centers), 1000)
        self.assertTrue(((probability >= 0.5) & (probability <= 1)).all())
        for pose in (None, frames()[0].pose):
            near, _ = filter.local_map(pose, radius=5.0)
            self.assertLess(len(near), len(centers))
            off = np.linalg.norm(near - frames()[0 if pose is not None else -1].pose[:3, 3], axis=1)
            self.assertLess(off.max(), 5.0 + 0.4)
        self.assertRaises(ValueError, filter.local_map, radius=-1.0)
        self.assertRaises(ValueError, filter.local_map, np.eye(3))

    def test_wrong_arguments_are_named(self):
        filter = df.DynamicFilter()
        filter.push(small_scan(), np.eye(4), 0.0)
        np.testing.assert_array_equal(filter.labels(-1), filter.labels(0))
        for error, pattern, call in (
                (TypeError, "scan: .* got 'a'", lambda: filter.labels("a")),
                (IndexError, "scan", lambda: filter.labels(-2)),
                (TypeError, "newest: .* got -1", lambda: filter.corrections(newest=-1)),
                (TypeError, "radius: .* got 'far'", lambda: filter.local_map(radius="far"))):
            with self.assertRaisesRegex(error, pattern): call()

    def test_what_never_gets_evidence_is_asked_all_the_same(self):
        for config in ({"preset": "paper", "back_end.enabled": False}, {"method": "removert"}, "paper"):
            filter = df.DynamicFilter(config)
            push_all(filter)
            filter.flush()
            filter.corrections()
            self.assertEqual(len(filter.labels(0)), len(frames()[0].points))
            filter.finish()
            self.assertGreater((filter.labels(0) == df.STATIC).sum(), 1000)

    def test_merged_map(self):
        for config in ("default", {"preset": "paper", "submap.keyframes": 5}):
            filter = df.DynamicFilter(config)
            self.assertEqual(filter.local_map()[0].shape, (0, 3))
            push_all(filter)
            filter.finish()
            merged = {tuple(center) for center in np.round(filter.static_map()[0], 3)}
            local = {tuple(center) for center in np.round(filter.local_map(radius=5.0)[0], 3)}
            self.assertGreater(min(len(local), len(merged)), 100)
            if config == "default": self.assertTrue(local < merged)

    def test_late_and_repeated_scans_are_refused(self):
        filter, points = df.DynamicFilter(), small_scan()
        filter.push(points, np.eye(4), 5.0)
        for stamp, pattern in ((5.0, "before"), (4.5, "before")):
            with self.assertRaisesRegex(df.Error, pattern):
                filter.push(points, np.eye(4), stamp)
        self.assertEqual(len(filter), 1)
        filter.push(points, np.eye(4), 5.1)
        self.assertEqual(len(filter.labels(1)), len(points))

    def test_breaks_are_told(self):
        filter, points = df.DynamicFilter(), small_scan()
        filter.push(points, np.eye(4), 5.0)
        filter.push(points, np.eye(4), 1.0)
        (scan, text), = filter.notices()
        self.assertEqual(scan, 1)
        self.assertIn("new map", text)
        self.assertEqual(filter.notices(), [])

    def test_the_end_is_the_end(self):
        filter = df.DynamicFilter()
        filter.push(small_scan(), np.eye(4), 0.0)
        filter.flush()
        filter.finish()
        filter.finish()
        with self.assertRaises(df.Error):
            filter.push(small_scan(), np.eye(4), 1.0)


if __name__ == "__main__":
    main()
