# SPDX-License-Identifier: MIT
"""Scans alone: the filter finds their poses, says how well, and labels as the command does."""
import functools
import os
import unittest

from support import df, main, np, scratch, small_scan

SCANS = 40
PAPER = {"preset": "paper", "submap.keyframes": 2}


@functools.cache
def crowd(**options):
    """A crowd at the rate of a usual sensor."""
    folder = scratch("-".join(["crowd", *options]))
    df.simulate("crowd", folder, frames=SCANS, rate=10.0, **options)
    return folder


def push_alone(filter, folder):
    for frame in df.open_recording(folder, poses="none"):
        filter.push(frame.points, frame.pose, frame.stamp, frame.times)
    return filter


def true_poses(folder):
    """Relative to the first."""
    poses = np.array([frame.pose for frame in df.open_recording(folder)])
    return np.linalg.inv(poses[0]) @ poses


def labels_of_run(name, folder, **options):
    """online=0: without the pace of the sensor, which a busy machine may miss."""
    labels = os.path.join(df.run(folder, scratch(name), **options)["output"], "labels")
    return [np.fromfile(os.path.join(labels, file), np.uint32) for file in sorted(os.listdir(labels))]


class ScansAlone(unittest.TestCase):
    def off(self, poses, truth):
        return np.linalg.norm((poses - truth)[:, :3, 3], axis=1).max()

    def same_labels(self, filter, expected):
        self.assertEqual(len(expected), SCANS)
        self.assertTrue(any((labels == df.DYNAMIC).any() for labels in expected))
        for i, labels in enumerate(expected):
            np.testing.assert_array_equal(filter.labels(i), labels)

    def test_poses_are_found(self):
        filter = push_alone(df.DynamicFilter(), crowd())
        poses = filter.poses()
        self.assertEqual((poses.dtype, poses.shape), (np.float64, (SCANS, 4, 4)))
        self.assertGreater(np.linalg.norm(poses[-1, :3, 3]), 3.0)
        self.assertLess(self.off(poses, true_poses(crowd())), 0.03)
        self.assertEqual({filter.status(i) for i in range(SCANS)}, {"good"})
        np.testing.assert_array_equal(filter.pose(-1), poses[-1])
        np.testing.assert_array_equal(filter.pose(0), np.eye(4))

    def test_labels_are_those_of_the_command(self):
        for name, folder, config, deskew in (("default", crowd(), None, False),
                                             ("sweep", crowd(sweep=True), None, True),
                                             ("sweep-paper", crowd(sweep=True), PAPER, True)):
            filter = push_alone(df.DynamicFilter(config), folder)
            filter.finish()
            self.same_labels(filter, labels_of_run(name, folder, poses="none", online=0.0, config=config, deskew=deskew))

    def test_the_motion_during_the_scans_is_undone(self):
        folder = crowd(sweep=True)
        truth = true_poses(folder)
        filter = push_alone(df.DynamicFilter(), folder)
        since = np.linalg.inv(filter.pose(1)) @ filter.poses()  # how the sensor began to move, nobody knew
        self.assertLess(self.off(since, np.linalg.inv(truth[1]) @ truth), 0.03)
        filter.flush()
        told = {scan: labels for scan, labels in filter.corrections()}
        self.assertTrue(told)
        for scan, labels in told.items():
            np.testing.assert_array_equal(labels, filter.labels(scan))

    def test_types_and_layouts_of_times_mean_the_same(self):
        frames = list(df.open_recording(crowd(sweep=True), poses="none", last=5))
        found = []
        for change in (np.asarray, np.float64, lambda times: np.repeat(times, 3)[::3]):
            filter = df.DynamicFilter()
            for f in frames: filter.push(f.points, None, f.stamp, change(f.times))
            found.append(filter.poses())
        np.testing.assert_array_equal(found[1], found[0])
        np.testing.assert_array_equal(found[2], found[0])
        without = df.DynamicFilter()
        for f in frames: without.push(f.points, stamp=f.stamp)
        self.assertGreater(self.off(without.poses(), found[0]), 0.001)

    def test_without_stamps_ten_scans_come_a_second(self):
        frames = list(df.open_recording(crowd(), last=5))
        with_stamps, without = df.DynamicFilter(), df.DynamicFilter()
        for i, f in enumerate(frames):
            a = with_stamps.push(f.points, None, 0.1 * i)
            np.testing.assert_array_equal(without.push(f.points), a)
        np.testing.assert_array_equal(without.poses(), with_stamps.poses())

    def test_windows_tell_their_poses_late(self):
        filter = df.DynamicFilter(PAPER)
        for frame in df.open_recording(crowd()):
            filter.push(frame.points, stamp=frame.stamp)
        waits = np.isnan(filter.poses()).any(axis=(1, 2))
        self.assertTrue(waits[-1])
        self.assertFalse(waits[0])
        for ask in (filter.pose, filter.status):
            with self.assertRaisesRegex(df.Error, f"scan {SCANS - 1} is not found yet"):
                ask(-1)
        filter.finish()
        self.assertLess(self.off(filter.poses(), true_poses(crowd())), 0.03)

    def test_the_map_is_where_the_scans_were(self):
        filter = push_alone(df.DynamicFilter(), crowd())
        near, _ = filter.local_map(radius=3.0)
        self.assertGreater(len(near), 10)
        self.assertLess(np.linalg.norm(near - filter.pose(-1)[:3, 3], axis=1).max(), 3.4)


class GivenPoses(unittest.TestCase):
    def test_they_stay_as_they_are(self):
        filter = df.DynamicFilter()
        frames = list(df.open_recording(crowd(), last=5))
        for f in frames: filter.push(f.points, f.pose, f.stamp, np.zeros(len(f.points)))
        for i, f in enumerate(frames):
            np.testing.assert_array_equal(filter.pose(i), f.pose)
            self.assertEqual(filter.status(i), "given")

    def test_they_are_refined_if_asked_for(self):
        folder = scratch("noisy")
        df.simulate("crowd", folder, frames=SCANS, rate=10.0, pose_noise=0.05)
        truth = np.array([frame.pose for frame in df.open_recording(crowd())])
        filter, given = df.DynamicFilter({"odometry.refine": True}), []
        for f in df.open_recording(folder):
            filter.push(f.points, f.pose, f.stamp)
            given.append(f.pose)
        self.assertEqual({filter.status(i) for i in range(SCANS)}, {"good"})
        steps = [np.linalg.norm(np.diff((poses - truth)[:, :3, 3], axis=0), axis=1).mean()
                 for poses in (filter.poses(), np.array(given))]
        self.assertLess(steps[0], 0.2 * steps[1])
        filter.finish()
        expected = labels_of_run("refined", folder, refine=True, online=0.0, deskew=False)
        for i, labels in enumerate(expected):
            np.testing.assert_array_equal(filter.labels(i), labels)


class Keeping(unittest.TestCase):
    def test_poses_are_kept_as_scans_are(self):
        for keep, kept in ((False, 1), (3, 3), (True, 6)):
            filter = df.DynamicFilter(keep=keep)
            for i in range(6): filter.push(small_scan(), np.eye(4), 0.1 * i)
            self.assertEqual(filter.poses().shape, (kept, 4, 4))
            self.assertEqual(filter.status(-1), "given")
            if kept < 6:
                with self.assertRaisesRegex(IndexError, "not kept"): filter.pose(0)
        empty = df.DynamicFilter()
        self.assertEqual(empty.poses().shape, (0, 4, 4))
        self.assertRaises(IndexError, empty.pose, 0)
        self.assertRaises(IndexError, empty.status, -1)
        self.assertRaisesRegex(TypeError, "scan: .* got 'a'", empty.pose, "a")


class Mixtures(unittest.TestCase):
    """Refused, with a sentence, and the filter goes on."""

    def refuses(self, pattern, first, second):
        filter = df.DynamicFilter()
        filter.push(small_scan(), **first)
        with self.assertRaisesRegex(df.Error, pattern): filter.push(small_scan(), **second)
        self.assertEqual(len(filter), 1)
        filter.push(small_scan(), **{name: value + 0.1 if name == "stamp" else value for name, value in first.items()})
        self.assertEqual(len(filter.labels(1)), len(small_scan()))

    def test_poses(self):
        with_pose, without = {"pose": np.eye(4), "stamp": 0.0}, {"stamp": 0.0}
        self.refuses("scan 1 has no pose, but those before had one", with_pose, without)
        self.refuses("scan 1 has a pose, but those before had none", without, with_pose)

    def test_stamps(self):
        self.refuses("scan 1 has no stamp, but those before had one", {"stamp": 5.0}, {})
        self.refuses("scan 1 has a stamp, but those before had none", {}, {"stamp": 5.0})

    def test_the_first_refused_scan_decides_nothing(self):
        filter = df.DynamicFilter()
        with self.assertRaises(ValueError): filter.push(small_scan(), np.zeros((4, 4)))
        filter.push(small_scan())
        self.assertEqual(len(filter), 1)


class Times(unittest.TestCase):
    def refuses(self, error, pattern, times):
        filter = df.DynamicFilter()
        with self.assertRaisesRegex(error, pattern): filter.push(small_scan(), None, 0.0, times)
        self.assertEqual(len(filter), 0)

    def test_refusals(self):
        size = len(small_scan())
        bad = np.zeros(size)
        bad[7] = np.nan
        self.refuses(ValueError, r"times: .*300 points.*\(299,\)", np.zeros(size - 1))
        self.refuses(ValueError, r"times: .*\(300, 1\)", np.zeros((size, 1)))
        self.refuses(ValueError, r"times: .*\(\)", 0.05)
        self.refuses(ValueError, "times: expected finite numbers, got nan for point 7", bad)
        self.refuses(ValueError, "times: .*absolute", np.full(size, 1.7e9))
        self.refuses(TypeError, "times: .*int64", np.zeros(size, np.int64))
        self.refuses(TypeError, "times: ", "late")

    def test_what_is_not_measured_needs_no_time(self):
        points, times = small_scan(), np.zeros(len(small_scan()))
        points[3], times[3] = np.nan, np.nan
        self.assertEqual(df.DynamicFilter().push(points, None, 0.0, times)[3], df.UNKNOWN)

    def test_of_recordings(self):
        frame = df.open_recording(crowd(sweep=True))[1]
        self.assertEqual((frame.times.dtype, frame.times.shape), (np.float32, (len(frame.points),)))
        self.assertLessEqual(np.abs(frame.times).max(), 0.1)
        self.assertIsNotNone(frame.pose)
        self.assertIsNone(df.open_recording(crowd(sweep=True), deskew=True)[1].times)
        frame = df.open_recording(crowd(), poses="none")[1]
        self.assertIsNone(frame.times)
        self.assertIsNone(frame.pose)


class Programs(unittest.TestCase):
    def test_run_and_check_take_recordings_without_poses(self):
        self.assertEqual(df.check(crowd(), poses="none")["findings"], [])
        result = df.run(crowd(), scratch("alone"), poses="none")
        self.assertGreater(result["metrics"]["voxel"]["majority"]["f1"], 0.8)
        scores = df.evaluate(crowd(), labels=result["output"], poses="none")
        self.assertGreater(scores["voxel"]["majority"]["f1"], 0.8)

    def test_switches(self):
        self.assertRaisesRegex(df.ConfigError, "refine: 'maybe' is none of", df.run, crowd(), scratch("x"), refine="maybe")
        self.assertRaisesRegex(TypeError, "deskew: ", df.open_recording, crowd(), deskew=1.5)
        for deskew in (None, False, "off", "auto"):
            self.assertIsNotNone(df.open_recording(crowd(sweep=True), deskew=deskew)[1].times)


if __name__ == "__main__":
    main()
