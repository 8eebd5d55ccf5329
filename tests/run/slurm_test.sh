#!/bin/bash
# Runs several recordings as jobs of a small cluster of Slurm: one task is killed in the midst, and the
# node of another one is lost. The result must be the bytes of a run in one process.
#   slurm_test.sh COMMAND SCRIPT
set -eu
real=$1 script=$2
# shellcheck source=tests/run/small_cluster.sh
. "$(dirname "$0")/small_cluster.sh"
# shellcheck source=tests/support/bytes_of.sh
. "$(dirname "$0")/../support/bytes_of.sh"
folder=$(mktemp -d)
trap 'stop_cluster; rm -rf "$folder"' EXIT
cd "$folder"
fail() { echo "$1"; shift; tail -n +1 -- "$@" out*.parts/*.log; exit 1; }

# Names that a shell would change if it read them again.
for seed in 1 2; do
    "$real" simulate crowd --frames 24 --pedestrians 20 --seed $seed --rate $((4 + seed)) -o "drive '$seed' %a" > /dev/null 2>&1
done
recordings=("drive '1' %a" "drive '2' %a")
"$real" run "${recordings[@]}" --tile-voxels 4000 -o expected > /dev/null 2>&1
bytes_of expected report.html > expected.md5
[ "$(wc -l < expected.md5)" -gt 10 ]

# In place of the command: its part 4 is killed after its first tile, and so is part 3, whose node
# then hangs until the test takes it away. Later tries are left alone.
cat > ./command << END
#!/bin/bash
has_tile() { find "\$1" -name '[0-9]*_*_*' 2> /dev/null | grep -q .; }
case \$* in
    *"--part 3/4 "*) part=3 ;;
    *"--part 4/4 "*) part=4 ;;
    *) exec "$real" "\$@" ;;
esac
mkdir "$folder/first-\$part" 2> /dev/null || exec "$real" "\$@"
"$real" "\$@" &
until has_tile "out %a.parts/\$part-of-4" || ! kill -0 \$!; do sleep 0.01; done
kill -9 \$!
if [ \$part = 3 ]; then
    echo "\$SLURMD_NODENAME" > "$folder/lost.new"
    mv "$folder/lost.new" "$folder/lost"
    sleep 600
fi
exit 137
END
chmod +x ./command

start_cluster "$folder/cluster"
"$script" --parts 4 --tile-voxels 4000 -o "out %a" --command ./command --wait -- "${recordings[@]}" > said.txt 2>&1 &
submitted=$!
until [ -e lost ]; do
    kill -0 $submitted || fail "ended early" said.txt
    sleep 0.2
done
lost=$(cat lost)
kill_node "$lost"
code=0
wait $submitted || code=$?
[ $code -eq 0 ] || fail "exit $code" said.txt
bytes_of "out %a" report.html > out.md5
cmp expected.md5 out.md5 || fail "other bytes than those of one process" said.txt
grep -q "starts again: exit code 137" "out %a.parts/4-of-4.log" || fail "part 4 was not repeated" said.txt
for part in 3 4; do
    nodes=$(sed -n "s/^part $part of 4 on \(n[123]\), try.*/\1/p" "out %a.parts/$part-of-4.log")
    [ "$(echo "$nodes" | sort -u | wc -l)" -eq 2 ] || fail "part $part had: $nodes" said.txt
done
# Slurm gives the number of the whole array to its last task, too; the others must not start again with it.
for part in 1 2; do
    [ "$(grep -c ", try " "out %a.parts/$part-of-4.log")" -eq 1 ] || fail "part $part was repeated" said.txt
done
echo "the same bytes, though a task was killed and node $lost was lost"

# The same again: all parts are there, so only the merge remains, which needs leave to overwrite.
"$script" --parts 4 --tile-voxels 4000 -o "out %a" --command ./command --wait --overwrite -- "${recordings[@]}" > said.txt 2>&1 ||
    fail "exit $? when all parts were there" said.txt
bytes_of "out %a" report.html > out.md5
cmp expected.md5 out.md5 || fail "other bytes after the second merge" said.txt

# Any number of parts.
for parts in 1 2 8; do
    "$script" --parts $parts --tile-voxels 4000 -o "out $parts" --command "$real" --wait -- "${recordings[@]}" > said.txt 2>&1 ||
        fail "exit $? of $parts parts" said.txt
    bytes_of "out $parts" report.html > out.md5
    cmp expected.md5 out.md5 || fail "$parts parts: other bytes than those of one process" said.txt
done
echo "the same bytes of 1, 2 and 8 parts"

# What no repetition helps fails at once, and nothing stays in the queue.
code=0
"$script" --parts 2 -o wrong --command ./command --set no.such=1 --wait -- "${recordings[@]}" > said.txt 2>&1 || code=$?
[ $code -ne 0 ] || fail "a wrong setting was no error" said.txt wrong.parts/*.log
sleep 1
[ -z "$(squeue -h)" ] || fail "jobs stay in the queue: $(squeue)" said.txt wrong.parts/*.log
[ ! -e wrong ] || fail "a run that failed was merged" said.txt
echo "a wrong setting ends all its jobs"
