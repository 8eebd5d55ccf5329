# SPDX-License-Identifier: MIT
"""Builds the wheel (PEP 517, 427): the package, its module, and the command in the folder of scripts.

    python3 backend.py DIR      # what script/wheel calls
"""
import base64
import hashlib
import pathlib
import re
import subprocess
import sys
import sysconfig
import zipfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
BUILD = ROOT / "build" / "release"


def version():
    return re.search(r"project\(DynamicFilter VERSION (\S+)", (ROOT / "CMakeLists.txt").read_text())[1]


def tag():
    """The tag of the wheel: the module needs this version of Python and the libraries of this system."""
    platform = re.sub(r"[-.]", "_", sysconfig.get_platform())
    python = f"cp{sys.version_info.major}{sys.version_info.minor}"
    return f"{python}-{python}-{platform}"


def build():
    # The Python of a temporary environment of pip would disappear.
    python = pathlib.Path(sys.executable).resolve()
    subprocess.run(["cmake", "--preset", "release", "-DDYNAMIC_FILTER_PYTHON=ON",
                    f"-DPython3_EXECUTABLE={python}"], cwd=ROOT, check=True, stdout=sys.stderr)
    subprocess.run(["cmake", "--build", BUILD, "--target", "_dynamicfilter", "dynamicfilter"],
                   check=True, stdout=sys.stderr)


def files(name):
    """Yields the path in the wheel and the content of each file."""
    suffix = sysconfig.get_config_var("EXT_SUFFIX")
    package = BUILD / "python" / "dynamicfilter"
    for file in ("__init__.py", "__init__.pyi", "py.typed", "_dynamicfilter" + suffix):
        yield f"dynamicfilter/{file}", (package / file).read_bytes()
    yield f"{name}.data/scripts/dynamicfilter", (BUILD / "dynamicfilter").read_bytes()
    yield f"{name}.dist-info/LICENSE", (ROOT / "LICENSE").read_bytes()
    yield f"{name}.dist-info/METADATA", (BUILD / "python" / f"{name}.dist-info" / "METADATA").read_bytes()
    yield f"{name}.dist-info/WHEEL", (f"Wheel-Version: 1.0\nGenerator: dynamicfilter\n"
                                      f"Root-Is-Purelib: false\nTag: {tag()}\n").encode()


def add(wheel, path, content, mode=0o644):
    entry = zipfile.ZipInfo(path)  # has a date in 1980, so the same sources give the same bytes
    entry.external_attr = (0o100000 | mode) << 16
    wheel.writestr(entry, content, zipfile.ZIP_DEFLATED)


def build_wheel(wheel_directory, config_settings=None, metadata_directory=None):
    build()
    name = f"dynamicfilter-{version()}"
    path = pathlib.Path(wheel_directory) / f"{name}-{tag()}.whl"
    path.parent.mkdir(parents=True, exist_ok=True)
    record = ""
    with zipfile.ZipFile(path, "w") as wheel:
        for place, content in files(name):
            add(wheel, place, content, 0o755 if "/scripts/" in place else 0o644)
            digest = base64.urlsafe_b64encode(hashlib.sha256(content).digest()).rstrip(b"=").decode()
            record += f"{place},sha256={digest},{len(content)}\n"
        add(wheel, f"{name}.dist-info/RECORD", record + f"{name}.dist-info/RECORD,,\n")
    return path.name


if __name__ == "__main__":
    print(pathlib.Path(sys.argv[1]) / build_wheel(sys.argv[1]))
