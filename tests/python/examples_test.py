# SPDX-License-Identifier: MIT
"""The examples, as a user runs them."""
import os
import subprocess
import sys
import unittest

from support import SCANS, main, recording, scratch

EXAMPLES = os.path.join(os.path.dirname(__file__), "../../examples/python")


def said(name, *arguments):
    command = [sys.executable, os.path.join(EXAMPLES, name + ".py"), *arguments]
    return subprocess.run(command, check=True, capture_output=True, text=True).stdout


class Examples(unittest.TestCase):
    def test_clean_folder_then_evaluate(self):
        self.assertRegex(said("clean_folder", recording(), scratch("cleaned")), rf"^{SCANS} scans, \d{{5,}} points stay\n$")
        f1 = said("evaluate", recording(), scratch("cleaned")).split()[-1]
        self.assertGreater(float(f1), 0.8)

    def test_online(self):
        self.assertRegex(said("online", recording()), rf"^{SCANS} scans, [1-9]\d* corrected, [1-9]\d* static voxels around\n$")

    def test_without_poses(self):
        self.assertRegex(said("without_poses", recording()), rf"^{SCANS} scans, 0 lost, \d{{4,}} static voxels\n$")

    def test_they_are_short(self):
        for name, most in (("clean_folder", 10), ("without_poses", 15)):
            with open(os.path.join(EXAMPLES, name + ".py")) as file:
                self.assertLessEqual(len(file.readlines()), most)


if __name__ == "__main__":
    main()
