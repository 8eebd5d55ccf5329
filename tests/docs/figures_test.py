# SPDX-License-Identifier: MIT
"""figures_test.py ROOT: a figure that stands on several pages is the same on all of them.

- Tables with a column per program and a row per recording agree wherever both are the same.
- The README's table of simulated recordings repeats rows of docs/results.md.
- Scores, rates and times in the text of README and of pages that measure nothing stand on a page that does.
- Each section of docs/results.md with a table says by which command it is made, or from where it is taken.
"""
import re
import sys
from pathlib import Path

ROOT = Path(sys.argv[1])
MEASURED = ["docs/results.md", "docs/performance.md", "docs/poses.md", "docs/comparison.md", "docs/paper.md", "docs/how-it-works.md"]
QUOTING = ["README.md", "docs/online.md", "docs/index.md", "docs/tutorial.md"]
SAME_PROGRAM = {"this, default preset": "DynamicFilter", "this": "DynamicFilter"}
# Rows of the README's table of simulated recordings, and the first cells of their rows in docs/results.md.
SIMULATED = {
    "crowd of 150 people, VLP-16": ["crowd", "vlp16", "150"],
    "hall on two levels, 64 beams": ["hall", "os64", "-"],
    "street, 64 beams": ["street", "os64", "-"],
    "square, VLP-16": ["square", "vlp16", ""],
    "crowd, solid-state sensor": ["crowd", "solid", ""],
    "cars that queue at a traffic light, VLP-16": ["jam", "vlp16", "5"],
}
faults = []


def text_of(page):
    return (ROOT / page).read_text()


def tables_of(text):
    """Lists of rows, the header first; a row is a list of cells."""
    table = []
    for line in text.splitlines() + [""]:
        if line.startswith("|"):
            cells = [cell.strip().replace("`", "") for cell in line.strip().strip("|").split("|")]
            if not all(re.fullmatch(r":?-+:?", cell) for cell in cells):
                table.append(cells)
        elif table:
            yield table
            table = []


def without_spread(cell):
    return re.sub(r" *\(\+-.*\)", "", cell)


def check_programs():
    seen = {}
    for page in ["README.md", *MEASURED]:
        for header, *rows in tables_of(text_of(page)):
            if "DUFOMap" not in header or header[0] != "recording":
                continue
            for row in rows:
                recording = re.match(r"\w+", row[0])[0]
                for program, figure in zip(header[1:], row[1:]):
                    program = SAME_PROGRAM.get(program, program)
                    if program == "scans":
                        continue
                    first_page, first = seen.setdefault((recording, program), (page, figure))
                    if first != figure:
                        faults.append(f"{recording}, {program}: {first} in {first_page}, but {figure} in {page}")
    if len(seen) < 8:
        faults.append("there is hardly a table of programs and recordings; has its form changed?")


def check_simulated():
    measured = {tuple(row[:3]): (header, row) for header, *rows in tables_of(text_of("docs/results.md")) for row in rows
                if len(row) > 3 and "PR [%]" in header}
    found = 0
    for header, *rows in tables_of(text_of("README.md")):
        for row in rows:
            if row[0] not in SIMULATED:
                continue
            found += 1
            its_header, its_row = measured[tuple(SIMULATED[row[0]])]
            for name, figure in zip(header[1:], row[1:]):
                expected = without_spread(its_row[its_header.index(name)])
                if figure != expected:
                    faults.append(f"README.md, {row[0]}, {name}: {figure}, but {expected} in docs/results.md")
    if found != len(SIMULATED):
        faults.append(f"README.md: {found} of the {len(SIMULATED)} rows of simulated recordings were found")


def check_quoted():
    measured = "\n".join(text_of(page) for page in MEASURED)
    for page in QUOTING:
        prose = re.sub(r"```.*?```", "", text_of(page), flags=re.S)
        for figure in sorted(set(re.findall(r"(?<![\w.])(0\.\d{3}|\d{2}\.\d{2}|1\.000)(?![\w.])", prose))):
            if not re.search(rf"(?<![\d.]){re.escape(figure)}(?!\d)", measured):
                faults.append(f"{page}: {figure} stands on no page that measures")


def check_commands():
    for section in re.split(r"^(?=#+ )", text_of("docs/results.md"), flags=re.M):
        measured = any("PR [%]" in header or "F1" in " ".join(header[1:]) for header, *_ in tables_of(section))
        if not measured:
            continue
        commands = re.search(r"script/|build/release/|simulate |dynamicfilter (run|eval)|`settled|RECORDING|source|no command", section)
        if not commands:
            faults.append(f"docs/results.md, '{section.splitlines()[0]}': no command and no source")


check_programs()
check_simulated()
check_quoted()
check_commands()
print("\n".join(faults) or "the figures of all pages agree")
sys.exit(1 if faults else 0)
