# SPDX-License-Identifier: MIT
"""Arrays in any layout mean the same; what is none is refused with what was expected."""
import unittest

from support import df, frames, main, np, recording, small_scan


class Layouts(unittest.TestCase):
    def labels_of(self, change):
        filter = df.DynamicFilter()
        return [filter.push(change(f.points), f.pose, f.stamp) for f in frames()[:8]]

    def test_layouts_give_the_same_labels(self):
        def wide(points):
            return np.hstack([points, np.ones((len(points), 2), np.float32)])

        def every_second(points):
            return np.repeat(points, 2, axis=0)[::2]

        def unaligned(points):
            records = np.zeros(len(points), np.dtype([("skip", "u1"), ("xyz", "<f4", 3)]))
            records["xyz"] = points
            return records["xyz"]

        def read_only(points):
            points = points.copy()
            points.flags.writeable = False
            return points

        expected = self.labels_of(lambda points: points)
        self.assertTrue(any((labels == df.STATIC).any() for labels in expected))
        for change in (np.float64, np.asfortranarray, wide, every_second, unaligned, read_only,
                       lambda points: points[::-1][::-1]):
            for a, b in zip(self.labels_of(change), expected):
                np.testing.assert_array_equal(a, b)

    def test_what_comes_out(self):
        frame = frames()[0]
        self.assertEqual((frame.points.dtype, frame.points.shape[1]), (np.float32, 3))
        self.assertEqual((frame.pose.dtype, frame.pose.shape), (np.float64, (4, 4)))
        self.assertEqual(frame.truth.dtype, np.uint8)
        self.assertEqual(len(frame.fields), len(frame.points))
        np.testing.assert_array_equal(frame.fields["x"], frame.points[:, 0])
        labels = df.DynamicFilter().push(frame.points, frame.pose, frame.stamp)
        self.assertEqual((labels.dtype, labels.shape), (np.uint8, (len(frame.points),)))
        labels[:] = 1  # it is the caller's

    def test_arrays_outlive_what_they_come_from(self):
        points = df.open_recording(recording())[0].points
        np.testing.assert_array_equal(points, frames()[0].points)

    def test_scan_without_points(self):
        labels = df.DynamicFilter().push(np.zeros((0, 3)), np.eye(4), 0.0)
        self.assertEqual(labels.shape, (0,))

    def test_transposed_points_are_refused(self):
        with self.assertRaisesRegex(ValueError, "transposed"):
            df.DynamicFilter().push(np.zeros((3, 1000)), np.eye(4), 0.0)

    def test_points_that_are_no_measurement_are_unknown(self):
        points = small_scan()
        points[0] = np.nan
        points[1] = 0
        labels = df.DynamicFilter().push(points, np.eye(4), 0.0)
        self.assertEqual(list(labels[:2]), [df.UNKNOWN, df.UNKNOWN])


class Refusals(unittest.TestCase):
    def refuses(self, error, pattern, points=None, pose=None, stamp=0.0):
        points = small_scan() if points is None else points
        pose = np.eye(4) if pose is None else pose
        filter = df.DynamicFilter()
        with self.assertRaisesRegex(error, pattern):
            filter.push(points, pose, stamp)
        self.assertEqual(len(filter), 0)

    def test_points(self):
        self.refuses(ValueError, r"points: .*N x 3.*\(5, 2\)", np.zeros((5, 2)))
        self.refuses(ValueError, r"points: .*\(3,\)", np.zeros(3))
        self.refuses(ValueError, r"points: .*\(2, 3, 3\)", np.zeros((2, 3, 3)))
        self.refuses(TypeError, "points: .*int64", np.zeros((5, 3), np.int64))
        self.refuses(TypeError, "points: .*float16", np.zeros((5, 3), np.float16))
        self.refuses(TypeError, "points: .*byte order", np.zeros((5, 3), ">f4"))
        self.refuses(TypeError, "points: ", "no points")

    def test_pose(self):
        scaled, flipped, moved, lost = np.eye(4), np.eye(4), np.eye(4), np.eye(4)
        scaled[:3, :3] *= 2
        flipped[0, 0] = -1
        moved[:3, 3] = 1, 2, 3
        lost[0, 3] = np.nan
        self.refuses(ValueError, r"4 x 4.*\(3, 4\)", pose=np.eye(4)[:3])
        self.refuses(ValueError, "not orthogonal", pose=scaled)
        self.refuses(ValueError, "reflection", pose=flipped)
        self.refuses(ValueError, "transposed", pose=moved.T)
        self.refuses(ValueError, "not finite", pose=lost)
        self.refuses(TypeError, "pose: ", pose="here")

    def test_stamp(self):
        self.refuses(ValueError, "stamp: .*nan", stamp=float("nan"))
        self.refuses(TypeError, "stamp: expected seconds as a number, got 'now'", stamp="now")

    def test_poses_that_are_nearly_rigid_are_taken(self):
        pose = np.eye(4, dtype=np.float32)
        pose[:2, :2] = [[0.6, -0.8], [0.8, 0.6]]
        df.DynamicFilter().push(small_scan(), pose, 0)


if __name__ == "__main__":
    main()
