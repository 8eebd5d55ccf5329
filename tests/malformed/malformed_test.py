# SPDX-License-Identifier: MIT
"""malformed_test.py DYNAMICFILTER [GIGABYTES]: each bad file is one error that names the file and a
reason, with exit code 3; each valid one is read exactly."""
import sys
import tempfile

from case_list import CASES
from reader import ERROR, READ, outcome, run


def complaint(case, status, said, points):
    expected = READ if case.valid else ERROR
    found = outcome(case, status, said, points)
    if found != expected:
        return f"{found} ({status}), expected {expected}: {said} {points}"
    if not case.valid and (status != 3 or said.count("\n") != 1 or case.file not in said):
        return f"exit {status}, expected 3 and a line that names the file: {said}"
    return ""


def main(program, gigabytes=0):
    complaints = 0
    with tempfile.TemporaryDirectory() as folder:
        for case in CASES:
            said = complaint(case, *run([program, "convert"], case, folder, int(gigabytes)))
            complaints += said != ""
            if said:
                print(f"{case.name}: {said}")
    print(f"{len(CASES)} files, {complaints} not as expected")
    return complaints != 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
