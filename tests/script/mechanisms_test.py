# SPDX-License-Identifier: MIT
"""Do the settings of script/ablate exist, and does each change something? usage: mechanisms_test.py ROOT COMMAND"""
import subprocess
import sys
from pathlib import Path

root = Path(sys.argv[1])
sys.path.insert(0, str(root / "script"))
from lib.mechanisms import MECHANISMS  # noqa: E402


def config(*settings):
    words = [w for s in settings for w in ("--set", s)]
    return subprocess.run([sys.argv[2], "config", *words], check=True, capture_output=True, text=True).stdout


for name, settings in MECHANISMS.items():
    assert config(*settings) != config(), name
assert len(MECHANISMS) > 5
