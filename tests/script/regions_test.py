# SPDX-License-Identifier: MIT
"""Does each table of script/reproduce and script/bench have its place in its page, and is it replaced there alone? usage: regions_test.py ROOT"""
import re
import runpy
import sys
from pathlib import Path

root = Path(sys.argv[1])
sys.path.insert(0, str(root / "script"))
from lib import pages, performance  # noqa: E402

page = "a\n<!-- s: x -->\nold\n<!-- end of x -->\nb\n<!-- s: y -->\nkept\n<!-- end of y -->\n"
assert pages.put(page, "s", "x", "new\n") == page.replace("old", "new")

reproduce = runpy.run_path(str(root / "script/reproduce"))
for script, sections, name in (("script/reproduce", reproduce["SECTIONS"], "results"), ("script/bench", performance.SECTIONS, "performance")):
    text = (root / f"docs/{name}.md").read_text()
    there = set(re.findall(f"<!-- {script}: (\\w+) -->", text)) - {"hours"}  # made on request only
    assert there == {s.__name__ for s in sections}, there ^ {s.__name__ for s in sections}
    for section in there:
        assert "\nNEW\n" in pages.put(text, script, section, "NEW\n")
