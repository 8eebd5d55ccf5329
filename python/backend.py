# SPDX-License-Identifier: MIT
"""Builds the wheel (PEP 517, 427): the package, its module, and the command.

    python3 backend.py DIR      # what script/wheel calls: a wheel with all libraries that it needs, for other systems, too

pip calls build_wheel(), whose wheel needs the libraries of this system.
"""
import base64
import hashlib
import pathlib
import re
import shutil
import subprocess
import sys
import sysconfig
import tempfile
import zipfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
BUILD = ROOT / "build" / "release"


def version():
    return re.search(r"project\(DynamicFilter VERSION (\S+)", (ROOT / "CMakeLists.txt").read_text())[1]


def tag(platform):
    """The tag of the wheel: the module needs this version of Python."""
    python = f"cp{sys.version_info.major}{sys.version_info.minor}"
    return f"{python}-{python}-{platform}"


def build():
    # The Python of a temporary environment of pip would disappear.
    python = pathlib.Path(sys.executable).resolve()
    subprocess.run(["cmake", "--preset", "release", "-DDYNAMIC_FILTER_PYTHON=ON",
                    f"-DPython3_EXECUTABLE={python}"], cwd=ROOT, check=True, stdout=sys.stderr)
    subprocess.run(["cmake", "--build", BUILD, "--target", "_dynamicfilter", "dynamicfilter"],
                   check=True, stdout=sys.stderr)


def stage(folder):
    """Copies into `folder` what gets installed into Python's folder of packages."""
    package = folder / "dynamicfilter"
    (package / "bin").mkdir(parents=True)
    module = "_dynamicfilter" + sysconfig.get_config_var("EXT_SUFFIX")
    for file in ("__init__.py", "__init__.pyi", "py.typed", module):
        shutil.copy(BUILD / "python" / "dynamicfilter" / file, package)
    shutil.copy(BUILD / "dynamicfilter", package / "bin")
    return package / module, package / "bin" / "dynamicfilter"


# Installed as `dynamicfilter`; the command itself stays beside its libraries.
SCRIPT = b"""#!python
import importlib.util
import os
import sys

package = os.path.dirname(importlib.util.find_spec("dynamicfilter").origin)
command = os.path.join(package, "bin", "dynamicfilter")
os.execv(command, ["dynamicfilter", *sys.argv[1:]])
"""


def add(wheel, path, content, mode=0o644):
    entry = zipfile.ZipInfo(path)  # has a date in 1980, so the same sources give the same bytes
    entry.external_attr = (0o100000 | mode) << 16
    wheel.writestr(entry, content, zipfile.ZIP_DEFLATED)


def write_wheel(directory, staged, platform, licences):
    name = f"dynamicfilter-{version()}"
    path = pathlib.Path(directory) / f"{name}-{tag(platform)}.whl"
    path.parent.mkdir(parents=True, exist_ok=True)
    contents = {str(file.relative_to(staged)): file.read_bytes() for file in sorted(staged.rglob("*")) if file.is_file()}
    contents[f"{name}.data/scripts/dynamicfilter"] = SCRIPT
    contents[f"{name}.dist-info/LICENSE"] = (ROOT / "LICENSE").read_bytes()
    for package, text in sorted(licences.items()):
        contents[f"{name}.dist-info/licenses/{package}.txt"] = text
    contents[f"{name}.dist-info/METADATA"] = (BUILD / "python" / f"{name}.dist-info" / "METADATA").read_bytes()
    contents[f"{name}.dist-info/WHEEL"] = (f"Wheel-Version: 1.0\nGenerator: dynamicfilter\nRoot-Is-Purelib: false\n"
                                           f"Tag: {tag(platform)}\n").encode()
    record = ""
    with zipfile.ZipFile(path, "w") as wheel:
        for place, content in contents.items():
            add(wheel, place, content, 0o755 if "/scripts/" in place or "/bin/" in place else 0o644)
            digest = base64.urlsafe_b64encode(hashlib.sha256(content).digest()).rstrip(b"=").decode()
            record += f"{place},sha256={digest},{len(content)}\n"
        add(wheel, f"{name}.dist-info/RECORD", record + f"{name}.dist-info/RECORD,,\n")
    return path


def build_wheel(wheel_directory, config_settings=None, metadata_directory=None):
    build()
    with tempfile.TemporaryDirectory() as folder:
        stage(pathlib.Path(folder))
        platform = re.sub(r"[-.]", "_", sysconfig.get_platform())
        return write_wheel(wheel_directory, pathlib.Path(folder), platform, {}).name


def build_travelling_wheel(directory):
    import libraries
    for tool in ("patchelf", "readelf", "objdump"):
        if not shutil.which(tool):
            sys.exit(f"{tool} is missing: script/bootstrap tests installs it")
    build()
    with tempfile.TemporaryDirectory() as folder:
        staged = pathlib.Path(folder)
        module, command = stage(staged)
        beside = staged / "dynamicfilter" / "libs"
        beside.mkdir()
        licences = libraries.bundle({module: "libs", command: "../libs"}, beside)
        glibc = libraries.least_glibc([module, command, *beside.iterdir()])
        machine = sysconfig.get_platform().split("-")[-1]
        return write_wheel(directory, staged, f"manylinux_2_{glibc}_{machine}", licences)


if __name__ == "__main__":
    print(build_travelling_wheel(sys.argv[1]))
