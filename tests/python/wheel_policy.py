#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Checks a wheel against the policy of its tag, manylinux_2_N (PEP 600, and the list of auditwheel).

    wheel_policy.py WHEEL

Each program and library in it asks for nothing but what is in the wheel and what every such system has, in versions of symbols
that glibc 2.N and the libstdc++ of its time have; looks for libraries inside the wheel alone; and has its licence beside it.
"""
import pathlib
import re
import subprocess
import sys
import tempfile
import zipfile

SYSTEM = {"libatomic.so.1", "libgcc_s.so.1", "libstdc++.so.6", "libm.so.6", "libanl.so.1", "libdl.so.2", "librt.so.1", "libc.so.6",
          "libnsl.so.1", "libutil.so.1", "libpthread.so.0", "libresolv.so.2", "ld-linux-x86-64.so.2", "ld-linux-aarch64.so.1"}
# The newest symbols of g++'s libraries that come with a glibc 2.N: N -> GLIBCXX, CXXABI, GCC.
LIBSTDCXX = {35: ((3, 4, 30), (1, 3, 13), (12, 0, 0)), 39: ((3, 4, 33), (1, 3, 15), (14, 0, 0))}


def numbers(text):
    return tuple(int(part) for part in text.split("."))


def said_by(*command):
    return subprocess.run([str(word) for word in command], check=True, stdout=subprocess.PIPE, text=True).stdout


def faults(root, wheel):
    tag = re.fullmatch(r"dynamicfilter-[\d.]+-cp\d+-cp\d+-manylinux_2_(\d+)_(x86_64|aarch64)\.whl", wheel.name)
    if not tag:
        yield f"{wheel.name} has no tag manylinux_2_N"
        return
    glibc = int(tag[1])
    glibcxx, cxxabi, gcc = max(item for item in LIBSTDCXX.items() if item[0] <= glibc)[1]
    newest = {"GLIBC": (2, glibc), "GLIBCXX": glibcxx, "CXXABI": cxxabi, "GCC": gcc}
    programs = [file for file in root.rglob("*") if file.is_file() and file.read_bytes()[:4] == b"\x7fELF"]
    inside = {file.name for file in programs}
    if len(programs) < 5:
        yield f"only {len(programs)} programs and libraries"
    for file in programs:
        dynamic = said_by("readelf", "-d", file)
        for name in re.findall(r"\(NEEDED\).*\[(.+)\]", dynamic):
            if name not in SYSTEM | inside:
                yield f"{file.name} needs {name}, which is neither in the wheel nor on every system"
        for way in re.findall(r"\((?:RPATH|RUNPATH)\).*\[(.+)\]", dynamic):
            if not all(part.startswith("$ORIGIN") for part in way.split(":")):
                yield f"{file.name} looks for libraries in {way}"
        for kind, version in set(re.findall(r"\*UND\*.*\b(GLIBCXX|GLIBC|CXXABI|GCC)_([\d.]+)\)?\s", said_by("objdump", "-T", file))):
            if numbers(version) > newest[kind]:
                yield f"{file.name} needs {kind}_{version}, which glibc 2.{glibc} does not come with"
    licences = len(list(root.glob("*.dist-info/licenses/*")))
    if licences < 10:
        yield f"only {licences} licences of the libraries inside"


def main(wheel):
    with tempfile.TemporaryDirectory() as folder:
        zipfile.ZipFile(wheel).extractall(folder)
        found = list(faults(pathlib.Path(folder), wheel))
    print("\n".join(found) or f"{wheel.name}: {wheel.stat().st_size / 1e6:.1f} MB, as its tag promises")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main(pathlib.Path(sys.argv[1])))
