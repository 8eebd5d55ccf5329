#!/bin/sh
# `diff` on two drives through a city whose parked cars come and go.   diff_test.sh COMMAND PYTHON
set -eu
command=$(realpath "$1")
python=$2
bench=$(realpath "$(dirname "$0")/../../bench/changes.py")
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
fail() { echo "$1"; [ ! -e said ] || cat said; exit 1; }
refuses() { # refuses TEXT ARGUMENT...
    text=$1
    shift
    ! "$command" diff "$@" > said 2>&1 || fail "did not fail: $*"
    grep -qF -- "$text" said || fail "did not say '$text': $*"
    [ -z "$(ls -d none* 2> /dev/null)" ] || fail "left an output: $*"
}
run() { "$command" run "$@" -q --no-report --no-maps > said 2>&1 || fail "run $*"; }

"$command" simulate city --km 0.08 --drives 2 -o city -q
run city/drive_1 -o monday
run city/drive_2 -o tuesday
"$command" diff monday tuesday -o changes > said 2>&1 || fail "diff"
grep -q "went, .* came; seen at both dates: [1-9]" said || fail "no summary"
[ ! -e changes.together ] || fail "left files beside the output"
ls changes > files
printf '%s\n' came.pcd changes.csv changes.json index.html new.png old.png unseen.pcd went.pcd | cmp -s - files ||
    fail "other files: $(cat files)"
"$python" - "$bench" << 'PYTHON'
import json, subprocess, sys
changes = json.load(open("changes/changes.json"))
assert changes["went"] + changes["came"] >= 3, changes
assert len(open("changes/changes.csv").readlines()) == 1 + len(changes["changes"])
table = subprocess.run([sys.executable, sys.argv[1], "city/drive_1", "city/drive_2", "changes"], capture_output=True,
                       text=True, check=True).stdout.splitlines()[2:]
for row in table:
    cells = [cell.strip() for cell in row.strip("|").split("|")]
    visible, found, count, right = int(cells[2]), float(cells[4]), int(cells[5]), float(cells[6])
    assert visible == 0 or found >= 90.0, row
    assert count == 0 or right >= 80.0, row
PYTHON

# Killed while it filters: the next call goes on, with the same bytes.
"$command" diff monday tuesday -o again > said 2>&1 &
victim=$!
for _ in $(seq 200); do [ -e again.together/.run ] && break; sleep 0.05; done
kill -9 $victim
wait $victim 2> /dev/null || true
[ ! -e again ] || [ -z "$(ls again)" ] || fail "half a comparison"
"$command" diff monday tuesday -o again --threads 1 > said 2>&1 || fail "after a kill"
diff -r changes again > said || fail "other bytes after a kill"

mkdir mine.together && touch mine.together/precious
"$command" diff monday tuesday -o mine > said 2>&1 && fail "took a folder of somebody else"
[ -e mine.together/precious ] && [ ! -e mine ] || fail "removed a folder of somebody else"
rm -r mine.together
refuses "is a drive of both runs" monday monday -o none
refuses "is not the whole output folder of a run" city tuesday -o none
refuses "--overwrite" monday tuesday -o changes
"$command" simulate crowd --frames 8 -o elsewhere -q
run elsewhere -o wednesday --pose-fix lidar
refuses "was read with other options than" monday wednesday -o none
run city/drive_2 -o saturday --poses none
refuses "its own odometry" monday saturday -o none
cp -r tuesday sunday && sed -i '/^complete$/d' sunday/.run
refuses "is not complete" monday sunday -o none
run elsewhere -o friday --set map.voxel_size=0.3
refuses "were made with other settings" monday friday -o none
awk '{$4 += 5000; print}' elsewhere/poses.txt > moved && mv moved elsewhere/poses.txt
run elsewhere -o thursday
refuses "have no place in common" monday thursday -o none
mv city/drive_2 city/drive_3
refuses "is not there any more" monday tuesday -o none
