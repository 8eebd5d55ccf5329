# SPDX-License-Identifier: MIT
"""Clouds are written as they are read; masked points count as not measured; errors speak of Python's arguments."""
import json
import os
import tempfile
import unittest
import warnings

from support import df, frames, main, np, recording


def sample():
    cloud = np.zeros(50, [("x", "<f4"), ("y", "<f4"), ("z", "<f4"), ("ring", "<u2"), ("stamp", "<f8")])
    random = np.random.default_rng(1)
    for axis in "xyz":
        cloud[axis] = random.normal(size=50)
    cloud["ring"], cloud["stamp"] = np.arange(50), 1e9 + np.arange(50) / 7
    return cloud


class WriteCloud(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)

    def file(self, name):
        return os.path.join(self.folder.name, name)

    def test_records_come_back_as_they_were(self):
        for kind in ("pcd", "ply", "csv"):
            df.write_cloud(self.file(f"a.{kind}"), sample())
            back = df.read_cloud(self.file(f"a.{kind}"))
            self.assertEqual(back.dtype.names, sample().dtype.names)
            for name in back.dtype.names:
                np.testing.assert_array_equal(back[name].astype(sample().dtype[name]), sample()[name])
        self.assertEqual(df.read_cloud(self.file("a.pcd")).dtype, sample().dtype)

    def test_layout_in_memory_does_not_matter(self):
        df.write_cloud(self.file("a.pcd"), sample())
        padded = np.zeros(100, np.dtype({"names": sample().dtype.names, "formats": [">f4", ">f4", ">f4", "<u2", ">f8"],
                                         "offsets": [4, 12, 20, 31, 40], "itemsize": 64}))
        for name in padded.dtype.names:
            padded[name][::2] = sample()[name]
        df.write_cloud(self.file("b.pcd"), padded[::2])
        with open(self.file("a.pcd"), "rb") as a, open(self.file("b.pcd"), "rb") as b:
            self.assertEqual(a.read(), b.read())

    def test_columns_are_named(self):
        points = np.arange(20, dtype=np.float32).reshape(4, 5)
        df.write_cloud(self.file("a.pcd"), points)
        back = df.read_cloud(self.file("a.pcd"))
        self.assertEqual(back.dtype.names, ("x", "y", "z", "intensity", "c4"))
        np.testing.assert_array_equal(back["c4"], points[:, 4])

    def test_what_a_format_cannot_hold_is_said(self):
        with warnings.catch_warnings(record=True) as said:
            warnings.simplefilter("always")
            df.write_cloud(self.file("a.bin"), sample())
        self.assertEqual(len(said), 1)
        self.assertIn("ring", str(said[0].message))

    def test_what_is_no_cloud_is_refused(self):
        for wrong, error in ((np.zeros((4, 2)), ValueError), (np.zeros(4), ValueError), (sample()[["x", "y"]], ValueError),
                             (np.zeros((4, 3), complex), TypeError), (np.zeros((4, 3), "U4"), TypeError)):
            with self.assertRaises(error):
                df.write_cloud(self.file("a.pcd"), wrong)
        with self.assertRaises(df.OutputError):
            df.write_cloud(self.file("a.unknown"), sample())
        self.assertEqual(os.listdir(self.folder.name), [])


class Masks(unittest.TestCase):
    def test_masked_points_are_not_measured(self):
        masked, holes = df.DynamicFilter(), df.DynamicFilter()
        for frame in frames()[:6]:
            points = frame.points.copy()
            mask = np.zeros(points.shape, bool)
            mask[::3] = True
            with_holes = points.copy()
            with_holes[::3] = np.nan
            labels = masked.push(np.ma.MaskedArray(points, mask), frame.pose, frame.stamp)
            self.assertTrue((labels[::3] == df.UNKNOWN).all())
            np.testing.assert_array_equal(labels, holes.push(with_holes, frame.pose, frame.stamp))

    def test_masked_points_are_written_as_holes(self):
        with tempfile.TemporaryDirectory() as folder:
            file = os.path.join(folder, "a.pcd")
            df.write_cloud(file, np.ma.MaskedArray(np.ones((3, 3)), [[False] * 3, [True] * 3, [False] * 3]))
            np.testing.assert_array_equal(np.isnan(df.read_cloud(file)["x"]), [False, True, False])


class Errors(unittest.TestCase):
    def test_they_name_arguments_of_python(self):
        with tempfile.TemporaryDirectory() as folder:
            out = os.path.join(folder, "out")
            os.mkdir(out)
            with open(os.path.join(out, "mine.txt"), "w") as file:
                file.write("kept")
            with self.assertRaises(df.Error) as caught:
                df.run(recording(), out)
            self.assertIn("choose another output, or overwrite=True", str(caught.exception))
            edited = os.path.join(folder, "edited")
            df.run(recording(), edited, last=3)
            with open(os.path.join(edited, "edits.json"), "w") as file:
                file.write(json.dumps({"format": "dynamicfilter edits", "version": 1, "cell_size": 0.2, "edits": []}))
            with self.assertRaises(df.Error) as caught:
                df.run(recording(), edited, overwrite=True, config={"map.time": "latest"})
            self.assertIn('use config={"map.time": "always"}', str(caught.exception))
            with self.assertRaises(df.Error) as caught:
                df.open_recording(recording(), first=5, last=2)
            self.assertNotIn("--", str(caught.exception))


if __name__ == "__main__":
    main()
