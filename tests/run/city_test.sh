#!/bin/sh
# Several drives, tiles and parts, as a user has them: the parts of any number give the bytes of the
# unbroken run, and wrong input is named.   city_test.sh COMMAND
set -eu
command=$(realpath "$1")
# shellcheck source=tests/support/bytes_of.sh
. "$(dirname "$0")/../support/bytes_of.sh"
# shellcheck source=tests/support/drive_parts.sh
. "$(dirname "$0")/../support/drive_parts.sh"
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"

# Two drives through one world: the first and the second half of a recording.
"$command" simulate crowd --frames 40 --pedestrians 20 --rate 4 -o data > /dev/null 2>&1
part a 0 19
part b 20 39
options="--tile-voxels 20000 --deskew off"

# One recording: the same labels and scores as in memory if it fits into one tile.
"$command" run data -o in_memory > /dev/null 2>&1
"$command" run data --memory 2G -o one_tile > /dev/null 2>&1
for file in labels static_map.pcd dynamic_points.pcd metrics.json; do
    diff -r in_memory/$file one_tile/$file > /dev/null || fail "one tile: $file differs from the run in memory"
done

# Parts of any number, in any order, one of them twice.
"$command" run a b $options -o whole > said 2>&1 || fail "two drives"
[ "$(ls whole/map/*.pcd | wc -l)" -gt 3 ] || fail "too few tiles to test anything"
[ ! -e whole/tiles ] || fail "the tiles stayed"
[ "$(ls whole/drives/a/labels | wc -l)" = 20 ] || fail "labels of the first drive"
bytes_of whole .run > whole.md5
"$command" convert b points.pcd --labels whole/drives/b > said 2>&1 || fail "the labels of a drive"
for parts in 1 2 5; do
    for i in $(seq "$parts"); do
        "$command" run a b $options --part "$i/$parts" --threads 1 -q -o "part$i" > said 2>&1 || fail "part $i"
    done
    # shellcheck disable=SC2046  # the names have no spaces
    "$command" merge $(seq "$parts" -1 1 | sed s/^/part/) part1 -o merged > said 2>&1 || fail "merge of $parts"
    bytes_of merged .run > merged.md5
    cmp -s whole.md5 merged.md5 || fail "$parts parts: $(diff whole.md5 merged.md5)"
    [ "$parts" = 5 ] || rm -r part* merged
done

# A list and a plan.
printf '# both\na\nb\tb/poses.txt\n' > drives.txt
"$command" plan drives.txt $options -o plan.bin --parts 3 > said 2>&1 || fail "plan"
grep -q "^parts    3" said || fail "plan says nothing of parts"
"$command" run drives.txt $options --plan plan.bin -o listed > said 2>&1 || fail "a list and a plan"
bytes_of listed .run recording.json > listed.md5  # which says that the list names the poses
grep -v recording.json whole.md5 > named.md5
cmp -s named.md5 listed.md5 || fail "list and plan: $(diff named.md5 listed.md5)"
"$command" plan a b $options --json -q > plan.json && grep -q '"cost_seconds"' plan.json || fail "plan as JSON"

# Whoever resumes goes on, and only with the same.
"$command" run a b $options -o whole --resume > said 2>&1 && grep -q "^complete" said || fail "resume of a complete run"
expect 2 "was begun with" run a b --tile-voxels 30000 --deskew off -o whole --resume
expect 2 "part 3/5 is missing" merge part1 part2 part4 part5 -o other
expect 3 "holds no part" merge part1 data -o other
"$command" run a $options --part 1/5 -q -o alone > said 2>&1 || fail "a part of one drive"
expect 2 "not parts of the same run" merge part1 alone -o other
for file in "$(ls part2/tiles/*.tile | head -1)" "$(ls part2/tiles/*.pcd | head -1)"; do
    flip "$file"
    expect 2 "part 2/5 is missing" merge part1 part2 part3 part4 part5 -o other
    [ ! -e other ] || fail "a merge that was refused left something"
    "$command" run a b $options --part 2/5 -q --resume -o part2 > said 2>&1 || fail "a spoilt part is not repeated"
done
expect 0 "complete" merge part1 part2 part3 part4 part5 -o merged
expect 2 "is one of the parts" merge part1 part2 part3 part4 part5 -o part1

# A merge that was killed, given again.
rm -r merged
"$command" merge part1 part2 part3 part4 part5 -o merged > said 2>&1 &
until [ -e merged/.run ] || ! kill -0 $!; do sleep 0.01; done
kill -9 $! 2> /dev/null || true
wait $! 2> /dev/null || true
touch merged/.static_map.pcd.tmp.1.1
"$command" merge part1 part2 part3 part4 part5 -o merged > said 2>&1 || fail "a killed merge, given again"
bytes_of merged .run > merged.md5
cmp -s whole.md5 merged.md5 || fail "a killed merge, given again: $(diff whole.md5 merged.md5)"

# Drives whose frames differ: the plan says so, and whoever uses it.
mkdir -p off/b
cp -r b/velodyne b/times.txt off/b
awk '{ $4 += 1; print }' b/poses.txt > off/b/poses.txt
"$command" plan a off/b $options -o off/plan > said 2>&1 && grep -q "warning: the world frames" said || fail "plan does not warn"
expect 4 "warning: the world frames" run a off/b $options --plan off/plan -o off/out
grep -q "warning  the world frames" off/out/run.log || fail "the log has no warning"
expect 2 "another version" run a b $options --plan off/plan -o off/refused
[ ! -e off/refused ] || fail "a refused plan left a folder"

mkdir merged/drives/a/own
touch merged/drives/a/own/notes
"$command" merge part1 part2 part3 part4 part5 -o merged --overwrite > said 2>&1 || fail "merge over a result"
[ -e merged/drives/a/own/notes ] || fail "a file of the user is gone"
rm -r merged/drives/a/own
bytes_of merged .run > merged.md5
cmp -s whole.md5 merged.md5 || fail "overwritten: $(diff whole.md5 merged.md5)"

expect 2 "I from 1 to N" run a --part 3/2 -o other
expect 2 "-o DIR" run a --part 1/2
expect 2 "expected a size" run a --memory lots -o other
expect 2 "give more" run a --memory 101M -o other
expect 2 "expected a size" run a --memory 1.5 -o other
expect 2 "given twice" run a ./a -o other
expect 2 "does not go with" run a --memory 1G --online -o other
expect 2 "default preset" run a --memory 1G --preset paper -o other
expect 3 "has no poses" run a --memory 1G --poses none -o other

# A scan that cannot be read is left out, named and not counted.
printf 123 > b/velodyne/000030.bin
expect 4 "rejected b: 000030" run a b $options -o rejected
tr -d ' \n' < rejected/map/index.json | grep -q '"name":"b","scans":19[^0-9]' || fail "the map counts what was rejected"
rm b/velodyne/000030.bin
expect 3 "" run a b $options -o other
[ ! -e other/labels ] || fail "something was written"
echo "parts, lists, plans and wrong input: all as expected"
