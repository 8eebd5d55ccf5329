# SPDX-License-Identifier: MIT
"""Do the edits of script/ablate still fit the sources? usage: mechanisms_test.py ROOT"""
import sys
from pathlib import Path

root = Path(sys.argv[1])
sys.path.insert(0, str(root / "script"))
from lib.ablation import edited  # noqa: E402
from lib.mechanisms import MECHANISMS  # noqa: E402

for edits in MECHANISMS.values():
    edited(root, edits)  # ends with a message if one does not
assert len(MECHANISMS) > 5
