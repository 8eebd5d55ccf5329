#!/bin/bash
# Runs several recordings by make, and by GNU parallel if there is one: one part is killed in the midst.
# The result must be the bytes of a run in one process.
#   make_test.sh COMMAND MAKEFILE
set -eu
real=$1 makefile=$2
# shellcheck source=tests/support/bytes_of.sh
. "$(dirname "$0")/../support/bytes_of.sh"
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
fail() { echo "$1"; cat said.txt; exit 1; }
is_expected() { bytes_of "$1" report.html > out.md5; cmp expected.md5 out.md5 || fail "$1: other bytes than those of one process"; }

for seed in 1 2; do
    "$real" simulate crowd --frames 24 --pedestrians 20 --seed $seed --rate $((4 + seed)) -o "it's $seed" > /dev/null 2>&1
done
"$real" run "it's 1" "it's 2" --tile-voxels 4000 -o expected > /dev/null 2>&1
bytes_of expected report.html > expected.md5
[ "$(wc -l < expected.md5)" -gt 10 ]

# In place of the command: part 2 is killed after its first tile, the first time.
cat > ./command << END
#!/bin/bash
echo "\$@" >> "$folder/calls"
case \$* in *"--part 2/3 "*) mkdir "$folder/first" 2> /dev/null || exec "$real" "\$@" ;; *) exec "$real" "\$@" ;; esac
"$real" "\$@" &
until find "out's.parts/2-of-3" -name '[0-9]*_*_*' 2> /dev/null | grep -q . || ! kill -0 \$!; do sleep 0.01; done
kill -9 \$!
exit 137
END
chmod +x ./command
run() { make -f "$makefile" -j 2 DYNAMICFILTER=./command OUT="out's" RECORDINGS="\"it's 1\" \"it's 2\"" PARTS=3 OPTIONS="--tile-voxels 4000" "$@" > said.txt 2>&1; }

# The part that fails is tried again at once.
run || fail "make failed"
grep -q "part 2 of 3 failed with code 137, and is tried again" said.txt || fail "part 2 was not repeated"
is_expected "out's"
[ "$(grep -c '^plan ' calls)" -eq 1 ] || fail "planned more than once"

# Without a second try, make fails and merges nothing; the same command again ends well.
rm -rf "out's" "out's.parts" first
code=0
run RETRIES=0 --keep-going || code=$?
[ $code -ne 0 ] || fail "make did not say that a part failed"
[ ! -e "out's" ] || fail "a run that failed was merged"
run RETRIES=0 || fail "make failed when it was called again"
is_expected "out's"

# What no repetition helps fails at once.
: > calls
code=0
run OUT=wrong OPTIONS="--set no.such=1" || code=$?
[ $code -ne 0 ] || fail "a wrong setting was no error"
[ "$(wc -l < calls)" -eq 1 ] || fail "a wrong setting was repeated"
! make -f "$makefile" RECORDINGS=x > said.txt 2>&1 || fail "no output was no error"
grep -q "OUT is missing" said.txt || fail "make does not say what is missing"

# As docs/many-machines.md has it for GNU parallel.
if command -v parallel > /dev/null; then
    mkdir by.parts
    "$real" plan "it's 1" "it's 2" --tile-voxels 4000 -o by.parts/plan > said.txt 2>&1
    seq 3 | parallel --will-cite -j 2 "'$real' run \"it's 1\" \"it's 2\" --tile-voxels 4000 --plan by.parts/plan --part {}/3 -o by.parts/{} --resume" >> said.txt 2>&1 ||
        fail "parallel failed"
    "$real" merge by.parts/1 by.parts/2 by.parts/3 -o by >> said.txt 2>&1 || fail "merge failed"
    is_expected by
fi
