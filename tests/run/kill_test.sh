#!/bin/sh
# Kills a run over tiles, or one of its parts, at random moments, and repeats it: the end must be the
# same bytes.   kill_test.sh COMMAND [TIMES]
set -eu
command=$(realpath "$1") times=${2:-8}
# shellcheck source=tests/support/bytes_of.sh
. "$(dirname "$0")/../support/bytes_of.sh"
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
"$command" simulate crowd --frames 30 --pedestrians 30 --rate 3 -o data > /dev/null 2>&1
run="$command run data --tile-voxels 20000 --memory 2G --no-report"
$run -o expected > /dev/null 2>&1
bytes_of expected .run > expected.md5
began=$(date +%s%N)
$run --part 1/2 -o timed > /dev/null 2>&1
took=$((($(date +%s%N) - began) / 1000))
$run --part 2/2 -o part2 > /dev/null 2>&1
for i in $(seq "$times"); do
    rm -rf part1 merged
    $run --part 1/2 -o part1 > /dev/null 2>&1 &
    process=$!
    # Multiples of a prime scatter over the run.
    sleep "$(awk "BEGIN { print ($i * 7919 % 1000) / 1000 * 1.1 * $took / 1e6 }")"
    kill -9 "$process" 2> /dev/null || true
    wait "$process" 2> /dev/null || true
    $run --part 1/2 -o part1 --resume > resume.txt 2>&1 || { echo "kill $i: cannot be repeated"; cat resume.txt; exit 1; }
    "$command" merge part1 part2 -o merged > merge.txt 2>&1 || { echo "kill $i: cannot be merged"; cat merge.txt; exit 1; }
    bytes_of merged .run > merged.md5
    cmp -s expected.md5 merged.md5 || { echo "kill $i: other bytes"; diff expected.md5 merged.md5; exit 1; }
done
echo "$times kills, every part repeated, and the same bytes"
