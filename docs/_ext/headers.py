"""Runs Doxygen over the headers that are installed, and no others; its warnings end the build."""
import re
import subprocess
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]


def installed():
    """The headers that users include, as cmake/install.cmake has them."""
    include = ROOT / "include/dynamic_filter"
    text = (ROOT / "cmake/install.cmake").read_text()
    core = re.search(r"set\(DF_CORE_HEADERS\s+([^)]*)\)", text)[1].split()
    parts = re.search(r"install\(DIRECTORY ([^C]*)COMPONENT", text)[1].split()
    return [include / name for name in core] + [
        header for part in parts for header in sorted((ROOT / part).glob("*.hpp"))]


def run_doxygen(app):
    out = Path(app.doctreedir) / "doxygen"
    out.mkdir(parents=True, exist_ok=True)
    options = (ROOT / "docs/_ext/Doxyfile").read_text() + f"""
OUTPUT_DIRECTORY = {out}
STRIP_FROM_PATH = {ROOT}/include
INPUT_FILTER = {ROOT}/docs/_ext/header_filter
INPUT = {' '.join(map(str, installed()))}
"""
    subprocess.run(["doxygen", "-"], input=options, text=True, check=True)
    app.config.breathe_projects = {"dynamic_filter": str(out / "xml")}
    app.config.breathe_default_project = "dynamic_filter"


def setup(app):
    app.connect("builder-inited", run_doxygen, priority=1)
