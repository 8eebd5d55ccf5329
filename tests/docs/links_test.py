#!/usr/bin/env python3
"""Do the files and functions that pages link to exist, and is every mistake explained that `check` names?
usage: links_test.py ROOT"""
import re
import sys
from pathlib import Path

root = Path(sys.argv[1])
sys.path.insert(0, str(root / "docs/_ext"))
from symbols import line_of, links

pages = [root / name for name in ("README.md", "CONTRIBUTING.md", "examples/README.md")]
pages += sorted(root.glob("docs/*.md")) + sorted(root.glob("docs/api/*.md"))
wrong, functions = [], 0
for page in pages:
    for text, target in links(page.read_text()):
        if "://" in target or target.startswith("#"):
            continue
        file = page.parent / target.split("#")[0]
        name = re.fullmatch(r"`([\w:]+)`", text)
        if not file.exists():
            wrong.append(f"{page.name}: {target} does not exist")
        elif name and file.suffix in (".cpp", ".hpp") and name[1] != file.stem:
            functions += 1
            if not line_of(file.read_text(), name[1]):
                wrong.append(f"{page.name}: {target} defines no {name[1]}")

explained = (root / "docs/troubleshooting.md").read_text()
preflight = (root / "src/check/preflight.cpp").read_text()
meanings = re.findall(r'\{"\w+", "([^"{}]+)"\}', preflight)
meanings += re.findall(r'"(the po\w+[^"{}]*?)[:"]', preflight) + re.findall(r'"--[\w-]+', preflight)
for meaning in meanings:
    if meaning.strip('"') not in explained:
        wrong.append(f"troubleshooting.md does not explain: {meaning}")

assert len(meanings) >= 10 and functions >= 30, (meanings, functions)
assert not wrong, "\n".join(wrong)
print(f"{len(pages)} pages, {functions} links to functions, {len(meanings)} mistakes explained")
