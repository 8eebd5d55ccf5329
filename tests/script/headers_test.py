# SPDX-License-Identifier: MIT
"""Do the installed headers say what their users need? usage: headers_test.py

Every declaration has a comment (doxygen tells), every number of type float or double a unit, and every
header says in its first comment what holds for all of it: shapes, units, frames, ownership, threads and
errors, as far as its declarations have to do with them.
"""
import re
import shutil
import subprocess
import sys
import tempfile
import xml.etree.ElementTree as ET
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "docs/_ext"))
from headers import installed  # noqa: E402

UNIT = r"\[(m|km|rad|s|ns|deg|Hz|bytes)\]|-?[01]\.\.1|in unit|file's unit"
CONTRACT = {  # what a header's first comment must name, if its code has this
    "Shapes": r"\b(vector|span|Points?|Labels)\b",
    "Units": r"\b(double|float|Points?|Pose)\b",
    "Frames": r"\b(Points?|Pose|Isometry3[df])\b",
    "Ownership": r"\b(span|string_view|path|unique_ptr|shared_ptr|function)\b|\w&[ ,)]",
    "Threads": r"\)( const| noexcept|;)",
    "Errors": r"\)( const| noexcept|;)",
}
SETTING = re.compile(r"of struct dynamic_filter::\w*Config\b")  # visit() says what it is, and a test that it does
PLAIN = "Plain data."  # a header of which there is no more to say


def xml_of(headers, folder):
    """What doxygen says of them, and what it misses."""
    settings = ["INPUT = " + " ".join(f'"{h}"' for h in headers), f'OUTPUT_DIRECTORY = "{folder}"', "GENERATE_HTML = NO",
                "GENERATE_LATEX = NO", "GENERATE_XML = YES", "XML_PROGRAMLISTING = NO", "QUIET = YES",
                "JAVADOC_AUTOBRIEF = YES", "WARN_FORMAT = $file:$line: $text"]
    done = subprocess.run(["doxygen", "-"], input="\n".join(settings), text=True, capture_output=True, check=True)
    return [ET.parse(file).getroot() for file in Path(folder, "xml").glob("*.xml")], done.stderr.splitlines()


def text(node, *names):
    return " ".join("".join(found.itertext()) for name in names for found in node.findall(name)).strip()


def without_units(roots):
    """Functions and fields with a float or double whose comment has no unit."""
    for root in roots:
        for member in root.iter("memberdef"):
            types = text(member, "type") + " " + " ".join(text(p, "type") for p in member.findall("param"))
            name = text(member, "qualifiedname") or text(member, "name")
            if member.get("prot") != "public" or re.search(r"::\w*Config::", name) or not re.search(r"\b(double|float)\b", types):
                continue
            if not re.search(UNIT, text(member, "briefdescription", "detaileddescription")):
                yield f"{member.find('location').get('file')}: {name}: a number without a unit"


def without_contract(header):
    source = header.read_text()
    comment = "\n".join(re.findall(r"^///(.*)$", source.split("#pragma once")[0], re.M))
    code = re.sub(r"//.*", "", re.sub(r"^(#|inline|using).*$", "", source, flags=re.M))
    if PLAIN in comment: return
    for name, occasion in CONTRACT.items():
        if re.search(occasion, code) and not re.search(rf"\b{name}( and \w+)?:", comment):
            yield f"{header}: the first comment does not say: {name}"


def main():
    if not shutil.which("doxygen"):
        print("skipped: doxygen is missing (script/bootstrap tests)")
        sys.exit(77)
    headers = installed()
    with tempfile.TemporaryDirectory() as folder:
        roots, warnings = xml_of(headers, folder)
        functions = sum(len(list(root.iter("memberdef"))) for root in roots)
        missing = [line for line in warnings if line.strip() and not SETTING.search(line)]
        missing += without_units(roots)
    missing += [fault for header in headers for fault in without_contract(header)]
    print("\n".join(missing) or f"{len(headers)} headers, {functions} members, all documented")
    sys.exit(bool(missing))


if __name__ == "__main__":
    main()
