# SPDX-License-Identifier: MIT
"""script/lib/skips finds skipped tests and cases with their reasons, and fails where they are not allowed."""
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

SCRIPT = Path(sys.argv.pop(1)) / "script/lib/skips"


def section(name, output, skipped=False):
    state = '<skipped message="SKIP_RETURN_CODE=77"/>' if skipped else ""
    return f'<testcase name="{name}" status="{"notrun" if skipped else "run"}">{state}<system-out>{output}</system-out></testcase>'


class Skips(unittest.TestCase):
    def said(self, *sections):
        with tempfile.TemporaryDirectory() as build:
            results = Path(build) / "results.xml"
            results.write_text(f"<testsuite>{''.join(sections)}</testsuite>")
            done = subprocess.run([sys.executable, SCRIPT, results], capture_output=True, text=True)
            return done.returncode, done.stdout

    def test_nothing_skipped(self):
        self.assertEqual(self.said(section("formats/clouds/pcd", "[  PASSED  ] 3 tests.")), (0, "0 skipped\n"))

    def test_a_skipped_test_fails_and_says_why(self):
        code, text = self.said(section("viewer", "skipped: there is no chromium", True))
        self.assertEqual(code, 1)
        self.assertIn("1 skipped\n  viewer: skipped: there is no chromium", text)

    def test_a_skipped_case_of_a_test_that_passed_is_found(self):
        output = "[ RUN      ] Page.IsWhole\na.cpp:3: Skipped\nno viewer\n\n[  SKIPPED ] Page.IsWhole (0 ms)\n[  SKIPPED ] Page.IsWhole"
        code, text = self.said(section("page/page", output), section("formats/clouds/pcd", ""))
        self.assertEqual(code, 1)
        self.assertIn("1 skipped\n  page/page: Page.IsWhole: no viewer", text)


if __name__ == "__main__":
    unittest.main()
