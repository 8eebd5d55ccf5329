#!/usr/bin/env python3
"""Builds the site and looks whether it is whole. usage: site_test.py ROOT BUILD"""
import re
import shutil
import subprocess
import sys
import tempfile
from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote, urldefrag

root, build = map(Path, sys.argv[1:])
missing = [tool for tool in ("doxygen", "katex") if not shutil.which(tool)]
missing += [name for name in ("sphinx", "myst_parser", "furo", "breathe")
            if subprocess.run(["/usr/bin/python3", "-c", f"import {name}"], capture_output=True).returncode]
if not (build / "python/dynamicfilter").is_dir():
    missing.append("the Python package")
if missing:
    print("skipped: missing", *missing)
    sys.exit(77)

scratch = tempfile.TemporaryDirectory()
subprocess.run([root / "script/docs", build, scratch.name], check=True)
site = Path(scratch.name) / "html"
sys.path.insert(0, str(root / "docs/_ext"))
from headers import installed
from stubs import TYPES


class Page(HTMLParser):
    def __init__(self, file):
        super().__init__()
        self.ids, self.links, self.loaded = set(), set(), set()
        self.feed(file.read_text())

    def handle_starttag(self, tag, attributes):
        found = dict(attributes)
        self.ids |= {found[key] for key in ("id", "name") if found.get(key)}
        if tag == "a" and found.get("href"):
            self.links.add(found["href"])
        elif found.get("src"):
            self.loaded.add(found["src"])
        elif tag == "link" and found.get("rel") == "stylesheet":
            self.loaded.add(found["href"])


pages = {file: Page(file) for file in site.rglob("*.html")}
wrong, leads_to = [], {}
for file, page in pages.items():
    name = file.relative_to(site)
    for url in page.loaded | page.links:
        path, fragment = urldefrag(url)
        if re.match(r"[a-z]+:", url):
            if url in page.loaded and not url.startswith("data:"):
                wrong.append(f"{name} loads {url}")
            continue
        target = (file.parent / unquote(path.split("?")[0])).resolve() if path else file
        leads_to.setdefault(file, set()).add(target)
        if not target.exists():
            wrong.append(f"{name}: {url} is not there")
        elif fragment and target in pages and unquote(fragment) not in pages[target].ids:
            wrong.append(f"{name}: nothing in {path} has the name {fragment}")
for style in site.rglob("*.css"):
    for url in re.findall(r"@import[^;]*|url\(([^)]*)\)", style.read_text()):
        if not url.strip("'\"").startswith("data:") and not (style.parent / url).exists():
            wrong.append(f"{style.name} loads {url or 'a style'}")

seen, waiting = set(), [site / "index.html"]
while waiting:
    file = waiting.pop()
    if file not in seen:
        seen.add(file)
        waiting += [target for target in leads_to.get(file, ()) if target in pages]
lists = {site / f"{name}.html" for name in ("search", "genindex", "py-modindex")}  # Sphinx's own
wrong += [f"{file.relative_to(site)} cannot be reached" for file in set(pages) - seen - lists]


def text_of(page):
    return (site / page).read_text()


settings = re.sub(r"struct Setting \{.*?\n\};", "", (root / "include/dynamic_filter/settings.hpp").read_text(), flags=re.DOTALL)
keys = re.findall(r'(?:Setting\{|\bfield\((?:\w+, )?)\s*"([\w.]+)"', settings)
fields = re.findall(r"^ +[\w:]+ (\w+) = [^;]*;", settings, re.MULTILINE)
assert len(keys) == len(fields) >= 50, (keys, fields)
listed = re.findall(r"<tr[^>]*><td><p><code[^>]*><span[^>]*>([\w.]+)<", text_of("parameters.html"))
wrong += [f"parameters.html lacks {key}" for key in keys if key not in listed]
wrong += [f"api/python.html lacks {name}" for name in TYPES if name not in pages[site / "api/python.html"].ids]
wrong += [f"api/cpp.html lacks {header.name}" for header in installed()
          if f"{header.relative_to(root / 'include/dynamic_filter')}<" not in text_of("api/cpp.html")
          and header.name != "dynamic_filter.hpp"]
# Equations are there already, in the page.
for page, least in (("how-it-works", 30), ("paper", 15), ("scores", 3)):
    assert text_of(f"{page}.html").count("<math") > least, page

assert not wrong, "\n".join(sorted(wrong))
print(f"{len(pages)} pages, {len(keys)} settings, {len(TYPES)} names of Python")
