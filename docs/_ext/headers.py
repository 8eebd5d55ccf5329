"""Runs Doxygen over the headers that are installed, and no others; its warnings end the build."""
import subprocess
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]


def installed():
    """The headers that users include."""
    return sorted((ROOT / "include/dynamic_filter").glob("*.hpp"))


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
