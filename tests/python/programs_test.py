# SPDX-License-Identifier: MIT
"""run, evaluate, simulate and the readers do what the command does."""
import filecmp
import os
import signal
import subprocess
import threading
import unittest

from support import COMMAND, SCANS, df, frames, main, np, recording, scratch


class Programs(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.result = df.run(recording(), scratch("run"))

    def test_run_gives_what_the_command_gives(self):
        folder = scratch("by-command")
        subprocess.run([COMMAND, "run", recording(), "-o", folder], check=True, capture_output=True)
        names = [f"labels/{i:06}.label" for i in range(SCANS)] + ["static_map.pcd", "metrics.json"]
        same, other, missing = filecmp.cmpfiles(folder, self.result["output"], names, shallow=False)
        self.assertEqual((len(same), other, missing), (len(names), [], []))

    def test_run_returns_the_scores(self):
        self.assertEqual(self.result["metrics"]["scans"], SCANS)
        self.assertGreater(self.result["metrics"]["voxel"]["majority"]["f1"], 0.8)
        self.assertGreater(self.result["timing"]["scans_per_second"], 0)

    def test_settings_and_selection(self):
        result = df.run(recording(), scratch("few"), last=4, threads=1,
                        config={"map.voxel_size": 0.4})
        self.assertEqual(result["metrics"]["scans"], 5)
        with open(os.path.join(result["output"], "config.toml")) as file:
            self.assertIn("voxel_size = 0.4", file.read())

    def test_evaluate(self):
        scores = df.evaluate(recording(), labels=self.result["output"])
        self.assertEqual(scores["voxel"], self.result["metrics"]["voxel"])
        self.assertEqual((scores["scans"], scores["left_out"], scores["without_truth"]), (SCANS, 0, 0))
        self.assertIn("excluded", scores["voxel_shifted"])
        of_map = df.evaluate(recording(), map=os.path.join(scratch("run"), "static_map.pcd"))
        self.assertEqual(of_map["scans"], SCANS)
        self.assertRaises(TypeError, df.evaluate, recording())

    def test_convert_gives_what_the_command_gives(self):
        result = self.result["output"]
        for name, options in (("map.bt", []), ("thin.pcd", ["--only", "static", "--thin", "0.2"])):
            by_command, here = scratch("by-command-" + name), scratch(name)
            subprocess.run([COMMAND, "convert", recording(), by_command, "--labels", result, *options], check=True,
                           capture_output=True)
            df.convert(recording(), here, labels=result, **({"only": "static", "thin": 0.2} if options else {}))
            self.assertTrue(filecmp.cmp(by_command, here, shallow=False), name)
        self.assertRaises(df.ConfigError, df.convert, recording(), scratch("map.bt"), labels=result)
        self.assertRaises(df.ConfigError, df.convert, recording(), scratch("x.pcd"), labels=result, only="all")
        self.assertRaises(ValueError, df.convert, recording(), scratch("x.pcd"), thin=-1.0)
        self.assertRaises(TypeError, df.convert, recording(), scratch("x.pcd"), thinn=1.0)
        self.assertFalse(os.path.exists(scratch("x.pcd")))

    def test_update_gives_the_map_of_a_run_of_all(self):
        half = scratch("half")
        df.convert(recording(), half, to="kitti", last=2)
        rest = scratch("rest")
        df.convert(recording(), rest, to="kitti", first=3)
        old = df.run(half, scratch("old"), keep_evidence=True, deskew=False)["output"]
        new = df.run(rest, scratch("new"), update=old)["output"]
        both = scratch("both")
        subprocess.run([COMMAND, "run", half, rest, "--deskew", "off", "-o", both], check=True, capture_output=True)
        self.assertEqual(filecmp.dircmp(os.path.join(new, "map"), os.path.join(both, "map")).diff_files, [])
        with self.assertRaises(df.ConfigError):
            df.run(rest, scratch("again"), update=new)
        with self.assertRaises(TypeError):
            df.run(rest, scratch("no-path"), update=3)

    def test_diff_refuses_a_date_twice(self):
        with self.assertRaisesRegex(df.ConfigError, "is a drive of both runs"):
            df.diff(self.result["output"], self.result["output"], scratch("changes"))
        self.assertFalse(os.path.exists(scratch("changes")))

    def test_simulate_gives_what_the_command_gives(self):
        folder = scratch("simulated")
        subprocess.run([COMMAND, "simulate", "crowd", "-o", folder, "--frames", str(SCANS)],
                       check=True, capture_output=True)
        self.assertTrue(filecmp.cmp(os.path.join(folder, "velodyne/000007.bin"),
                                    os.path.join(recording(), "velodyne/000007.bin"), False))
        with self.assertRaisesRegex(df.ConfigError, "crowd"):
            df.simulate("nowhere", scratch("nowhere"))

    def test_evaluate_says_what_could_be_known(self):
        df.simulate("crowd", scratch("known"), frames=3, pedestrians=10, knowable=True)
        known = df.evaluate(scratch("known"), labels=scratch("known"))["knowable"]
        self.assertEqual(known["groups"]["knowable"]["rr"], 1.0)
        self.assertEqual(sum(b["points"] for b in known["bins"]), known["groups"]["all"]["points"])

    def test_recording(self):
        opened = df.open_recording(recording(), first=3, stride=2)
        self.assertEqual(len(opened), (SCANS - 3 + 1) // 2)
        np.testing.assert_array_equal(opened[0].points, frames()[3].points)
        np.testing.assert_array_equal(opened[-1].pose, opened[len(opened) - 1].pose)
        self.assertTrue(opened.has_truth)
        self.assertEqual(opened.format, "kitti")
        self.assertRaises(IndexError, lambda: opened[len(opened)])
        self.assertRaises(IndexError, lambda: opened[-len(opened) - 1])

    def test_a_slice_is_a_recording(self):
        opened = df.open_recording(recording())
        part = opened[3:9:2]
        self.assertEqual(len(part), 3)
        self.assertIsInstance(part, df.Recording)
        np.testing.assert_array_equal(part[1].points, frames()[5].points)
        np.testing.assert_array_equal(opened[-2:][1].pose, opened[-1].pose)
        self.assertEqual(len(part[1:]), 2)
        self.assertRaises(ValueError, lambda: opened[5:5])
        self.assertRaises(ValueError, lambda: opened[::-1])

    def test_clouds(self):
        cloud = df.read_cloud(os.path.join(recording(), "velodyne", "000000.bin"))
        self.assertEqual(cloud.dtype.names, ("x", "y", "z", "intensity"))
        raw = np.fromfile(os.path.join(recording(), "velodyne", "000000.bin"), np.float32)
        np.testing.assert_array_equal(cloud.view(np.float32), raw)

    def test_mistakes(self):
        for error, call in (
                (df.InputError, lambda: df.open_recording(scratch("missing"))),
                (df.InputError, lambda: df.read_cloud(scratch("missing.pcd"))),
                (df.ConfigError, lambda: df.open_recording(recording(), pose_fix="sideways")),
                (df.ConfigError, lambda: df.open_recording(recording(), stride=0)),
                (df.ConfigError, lambda: df.run(recording(), self.result["output"])),
                (df.OutputError, lambda: df.simulate("crowd", "/proc/none", frames=1)),
                (TypeError, lambda: df.run(recording(), scratch("x"), spedd=1)),
                (TypeError, lambda: df.run(recording(), scratch("x"), threads="two")),
                (ValueError, lambda: df.run(recording(), scratch("x"), threads=-1)),
                (ValueError, lambda: df.run(recording(), scratch("x"), online=-1.0)),
                (TypeError, lambda: df.open_recording(recording(), stride="two"))):
            self.assertRaises(error, call)

    def test_check(self):
        self.assertEqual(df.check(recording())["findings"], [])
        found = df.check(recording(), pose_fix="inverse")
        self.assertRegex(found["findings"][0]["what"], "inverse")
        self.assertEqual(set(found), {"findings", "notes", "overlays", "unusable", "lost"})
        self.assertRaises(TypeError, df.check, recording(), depth=1)

    def test_an_interrupt_or_two_of_a_run_are_one_exception(self):
        after = [threading.Timer(t, os.kill, (os.getpid(), signal.SIGINT)) for t in (0.2, 0.8)]
        df.simulate("street", scratch("long"), sensor="os64", frames=60)
        for timer in after: timer.start()
        with self.assertRaises(KeyboardInterrupt):
            df.run(scratch("long"), scratch("stopped"))
        for timer in after: timer.cancel()

    def test_interrupts(self):
        stop = threading.Timer(0.5, os.kill, (os.getpid(), signal.SIGINT))
        stop.start()
        with self.assertRaises(KeyboardInterrupt):
            df.simulate("street", scratch("street"), sensor="hdl64")
        stop.join()
        self.assertFalse(os.path.exists(scratch("street")))
        with self.assertRaises(KeyboardInterrupt):  # Python's own handler is back
            signal.raise_signal(signal.SIGINT)
        df.simulate("crowd", scratch("again"), frames=1)


if __name__ == "__main__":
    main()
