#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""The version of CMakeLists.txt is the one that every other file names. usage: versions_test.py ROOT"""
import re
import sys
import xml.etree.ElementTree as ElementTree
from pathlib import Path

root = Path(sys.argv[1])
version = re.search(r"project\(DynamicFilter VERSION (\S+)", (root / "CMakeLists.txt").read_text())[1]
named = {
    file: ElementTree.parse(root / file).findtext("version")
    for file in ("package.xml", "packaging/dynamicfilter_msgs/package.xml")
}
for file, pattern in {
    "CITATION.cff": r"^version: (\S+)$",
    "CHANGELOG.md": r"^## (\S+?),? ",
    "packaging/debian/changelog": r"^dynamicfilter \((\S+)-\d+\)",
    "packaging/dynamicfilter.1": r'"dynamicfilter (\S+)"',
    "packaging/dynamicfilter-slurm.1": r'"dynamicfilter (\S+)"',
    "packaging/dynamicfilter_ros1.1": r'"dynamicfilter (\S+)"',
}.items():
    found = re.search(pattern, (root / file).read_text(), re.M)
    named[file] = found and found[1]
for file in ("python/METADATA.in", "packaging/ros1/package.xml.in"):  # filled in by CMake
    named[file] = version if "@PROJECT_VERSION@" in (root / file).read_text() else "a version of its own"
if 'dynamic = ["version"]' not in (root / "pyproject.toml").read_text():
    named["pyproject.toml"] = "a version of its own"
wrong = [f"{file}: {other}, but CMakeLists.txt has {version}" for file, other in named.items() if other != version]
print("\n".join(wrong) or f"{len(named)} files name version {version}")
sys.exit(bool(wrong))
