#!/bin/sh
# Kills runs at random moments, and resumes them: what is left must always be readable, and the end
# the same bytes.   kill_test.sh COMMAND [TIMES]
set -eu
command=$1 times=${2:-8}
# shellcheck source=tests/support/bytes_of.sh
. "$(dirname "$0")/../support/bytes_of.sh"
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
"$command" simulate crowd --frames 24 --pedestrians 30 -o data > /dev/null 2>&1
began=$(date +%s%N)
"$command" run data -o expected > /dev/null 2>&1
took=$((($(date +%s%N) - began) / 1000))
bytes_of expected report.html > expected.md5
for i in $(seq "$times"); do
    rm -rf out
    "$command" run data -o out > /dev/null 2>&1 &
    process=$!
    # Multiples of a prime scatter over the run.
    sleep "$(awk "BEGIN { print ($i * 7919 % 1000) / 1000 * 1.1 * $took / 1e6 }")"
    kill -9 "$process" 2> /dev/null || true
    wait "$process" 2> /dev/null || true
    for map in out/*.pcd; do
        [ ! -e "$map" ] || "$command" info "$map" > /dev/null || { echo "kill $i: $map cannot be read"; exit 1; }
    done
    "$command" run data -o out --resume > resume.txt 2>&1 || { echo "kill $i: cannot be resumed"; cat resume.txt; exit 1; }
    bytes_of out report.html > out.md5
    cmp -s expected.md5 out.md5 || { echo "kill $i: other bytes"; diff expected.md5 out.md5; exit 1; }
done
echo "$times kills, every one resumed with the same bytes"
