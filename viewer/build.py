#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""build.py OUT: builds the whole viewer as one HTML file that refers to nothing outside itself."""
import re
import subprocess
import sys
import tempfile
from pathlib import Path

HERE = Path(__file__).resolve().parent
MARKER = "<!--DATA-->"
BROWSERS = "chrome100,firefox113,safari16.4"  # they have DecompressionStream, or nearly so


def esbuild():
    found = sorted(HERE.glob("node_modules/@esbuild/*/bin/esbuild"))
    if not found:
        sys.exit("build.py: viewer/node_modules holds no esbuild; script/bootstrap fetches it")
    return found[0]


def bundle():
    with tempfile.TemporaryDirectory() as out:
        # Licences are given in full, see below.
        subprocess.run([esbuild(), "src/main.js", "--bundle", "--minify", "--format=iife", f"--target={BROWSERS}", "--charset=utf8",
                        "--legal-comments=none", "--log-level=warning", f"--outdir={out}"], cwd=HERE, check=True)
        return [(Path(out) / f"main.{kind}").read_text() for kind in ("js", "css")]


def licences():
    texts = [(name, (HERE / f"node_modules/{name}/LICENSE").read_text().strip()) for name in ("three", "uplot")]
    return "\n\n".join(f"{name}\n\n{text}" for name, text in texts)


def in_script(code):
    """What would end a script element, or begin a comment in it, is written so that it does not."""
    return re.sub(r"<(?=/script|!--)", r"\\x3C", code, flags=re.IGNORECASE)


def main(out):
    script, style = bundle()
    parts = {"STYLE": style.strip(), "LICENCES": licences().replace("<", "&lt;"), "SCRIPT": in_script(script).strip()}
    html = re.sub(r"<!--([A-Z]+)-->", lambda place: parts.get(place[1], place[0]), (HERE / "src/index.html").read_text())
    if html.count(MARKER) != 1:
        sys.exit(f"build.py: {MARKER} must be in the page exactly once")
    out.parent.mkdir(parents=True, exist_ok=True)
    out.write_text(html)


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit("usage: build.py OUT")
    main(Path(sys.argv[1]))
