"""headers.py CMAKE BUILD: what is installed includes the standard library, Eigen and what is
installed with it, no more."""
import pathlib
import re
import subprocess
import sys
import tempfile

cmake, build = sys.argv[1:]
with tempfile.TemporaryDirectory() as prefix:
    subprocess.run([cmake, "--install", build, "--component", "dev", "--prefix", prefix],
                   check=True, stdout=subprocess.DEVNULL)
    include = pathlib.Path(prefix, "include")
    headers = list(include.rglob("*.hpp"))
    assert len(headers) >= 15, f"only {len(headers)} headers are installed"
    faults = []
    for header in headers:
        for mark, name in re.findall(r'^#include ([<"])(.*)[>"]', header.read_text(), re.M):
            own = mark == '"' and (include / name).is_file()
            if not own and not re.fullmatch(r"[a-z_]+|Eigen/\w+", name):
                faults.append(f"{header.relative_to(include)} includes {name}")
sys.exit("\n".join(faults) or None)
