# SPDX-License-Identifier: MIT
"""Do the tests that docs/faults.md names exist? usage: faults_test.py ROOT"""
import re
import sys
from pathlib import Path

root = Path(sys.argv[1])
sources = "".join(path.read_text() for path in (root / "tests").rglob("*_test.cpp"))
known = {".".join(names) for names in re.findall(r"^TEST(?:_F|_P)?\((\w+),\s*(\w+)\)", sources, re.M)}
known |= {re.sub(r"_test\.\w+$", "", str(path.relative_to(root / "tests"))) for path in (root / "tests").rglob("*_test.*")}

rows = [line for line in (root / "docs/faults.md").read_text().splitlines() if line.startswith("| ")]
named = [re.findall(r"`([^`]+)`", row.split("|")[3]) for row in rows if not row.startswith("| fault ")]
assert len(named) > 40 and all(named), "a fault without a test"
missing = sorted({name for names in named for name in names} - known)
assert not missing, f"docs/faults.md names tests that are not there: {', '.join(missing)}"
