#!/bin/sh
# Interrupts a run while it filters: what is filtered so far is written, and --resume ends with the bytes
# of an unbroken run.   interrupt_test.sh COMMAND
set -eu
command=$1
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
"$command" simulate crowd --frames 24 --pedestrians 30 -o data > /dev/null 2>&1
"$command" run data -o expected > /dev/null 2>&1
fail() { echo "$1"; cat said.txt; exit 1; }
for signal in INT TERM; do
    rm -rf out said.txt
    # As slow as an old sensor, so that the signal comes in the midst of it.
    "$command" run data -o out --online --speed 1 > said.txt 2>&1 &
    process=$!
    until grep -qs "filter 6/24" said.txt; do
        kill -0 "$process" || fail "ended before it filtered"
        sleep 0.02
    done
    kill -s "$signal" "$process"
    code=0
    wait "$process" || code=$?
    [ "$code" = 130 ] || fail "exit code $code"
    grep -q '^interrupted' out/run.log || fail "the log does not say it"
    grep -q '^interrupted: .* of 24 scans are written to out; .*--resume goes on' said.txt || fail "it does not say how to go on"
    "$command" info out/static_map.pcd > /dev/null || fail "the map cannot be read"
    labels=$(ls out/labels | wc -l)
    [ "$labels" -ge 6 ] && [ "$labels" -lt 24 ] || fail "$labels label files"
    "$command" run data -o out --resume > said.txt 2>&1 || fail "cannot be resumed"
    for file in static_map.pcd dynamic_points.pcd labels metrics.json; do
        diff -r "expected/$file" "out/$file" || fail "$file differs"
    done
done

# In the first moment, too, it says that it was interrupted, and leaves no lock behind.
"$command" run data -o early > said.txt 2>&1 &
process=$!
until [ -e early ]; do
    kill -0 "$process" || fail "ended before it made its folder"
done
kill -s INT "$process"
code=0
wait "$process" || code=$?
[ "$code" = 130 ] || fail "exit code $code in the first moment"
grep -q '^interrupted' said.txt || fail "it does not say that it was interrupted"
[ -z "$(find . -name '*.lock')" ] || fail "a lock is left"

# A simulation that looks through its recording once more leaves the recording, and nothing of what it counts.
"$command" simulate crowd --frames 200 --pedestrians 10 --knowable -o known > said.txt 2>&1 &
process=$!
until grep -qs "look through" said.txt; do
    kill -0 "$process" || fail "ended before it looked through the recording"
    sleep 0.02
done
kill -s INT "$process"
code=0
wait "$process" || code=$?
[ "$code" = 130 ] || fail "exit code $code while it looked through the recording"
[ "$(ls known/velodyne | wc -l)" = 200 ] || fail "scans are missing"
[ ! -e known/knowable ] || fail "a part of what could be known is left"

# Whoever reads what it says may go away: the run goes on to its end.
(
    code=0
    "$command" run data -o unheard 2>&1 || code=$?
    echo $code > unheard.code
) | head -n 1 > said.txt
until [ -s unheard.code ]; do sleep 0.1; done
[ "$(cat unheard.code)" = 0 ] || fail "ended with $(cat unheard.code) when its reader went away"
diff -r expected/labels unheard/labels || fail "labels of a run without a reader differ"
