#!/bin/bash
# Runs several recordings by mpirun: with any number of processes the bytes are those of one process; a
# process that is killed ends all of them, and --resume goes on.
#   mpi_test.sh COMMAND
set -eu
command=$1
# shellcheck source=tests/support/bytes_of.sh
. "$(dirname "$0")/../support/bytes_of.sh"
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
fail() { echo "$1"; cat said.txt; exit 1; }
is_expected() { bytes_of "$1" report.html > out.md5; cmp expected.md5 out.md5 || fail "$1: other bytes than those of one process"; }
by_mpi() {  # PROCESSES OPTION...
    local processes=$1
    shift
    mpirun --oversubscribe --bind-to none -n "$processes" "$command" run "drive 1" "drive 2" --tile-voxels 4000 --threads 1 --mpi "$@" \
        > said.txt 2>&1
}

for seed in 1 2; do
    "$command" simulate crowd --frames 24 --pedestrians 20 --seed $seed --rate $((4 + seed)) -o "drive $seed" > /dev/null 2>&1
done
"$command" run "drive 1" "drive 2" --tile-voxels 4000 -o expected > /dev/null 2>&1
bytes_of expected report.html > expected.md5
[ "$(wc -l < expected.md5)" -gt 10 ]

for processes in 1 2 4; do
    by_mpi $processes -o "out $processes" || fail "$processes processes: exit $?"
    is_expected "out $processes"
done

# One process is killed once it is at work.
by_mpi 3 -o out &
run=$!
until find out -name '[0-9]*_*_*' 2> /dev/null | grep -q .; do
    kill -0 $run 2> /dev/null || fail "ended before a tile was done"
    sleep 0.01
done
mpirun=$run # or the shell that started it
[ "$(cat /proc/$run/comm)" = mpirun ] || mpirun=$(pgrep -P $run)
kill -9 "$(pgrep -P "$mpirun" | tail -1)"
code=0
wait $run || code=$?
[ $code -ne 0 ] || fail "mpirun did not say that a process was killed"
grep -q "exited on signal 9" said.txt || fail "no process was killed"
[ ! -e out/map/index.json ] || fail "half a run was merged"
by_mpi 2 -o out --resume || fail "cannot be resumed: exit $?"
is_expected out
by_mpi 2 -o out --resume || fail "what is complete is no success when it is resumed: exit $?"
is_expected out

# mpirun ends as the command does.
code=0
by_mpi 2 -o wrong --set no.such=1 || code=$?
[ $code -eq 2 ] || fail "a wrong setting: exit $code"
code=0
"$command" run "drive 1" "drive 2" --mpi -o none > said.txt 2>&1 || code=$?
[ $code -eq 2 ] || fail "without mpirun: exit $code"
grep -q "mpirun -n 8 dynamicfilter run" said.txt || fail "the error does not say how to start"
