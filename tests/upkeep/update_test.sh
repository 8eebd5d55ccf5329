#!/bin/sh
# A map that goes on with other drives, as a user has it: the bytes are those of a run of all drives, whatever was killed,
# damaged or kept, and what does not fit is named.   update_test.sh COMMAND
set -eu
command=$(realpath "$1")
# shellcheck source=tests/support/bytes_of.sh
. "$(dirname "$0")/../support/bytes_of.sh"
# shellcheck source=tests/support/drive_parts.sh
. "$(dirname "$0")/../support/drive_parts.sh"
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
run() { "$command" run "$@" -q > said 2>&1 || fail "exit $?: run $*"; }
same() {  # same ONE OTHER WHAT
    diff -rq "$1" "$2" > said 2>&1 || fail "$3"
}

# Four drives through one world: the parts of a recording. The poses of the last one jump, so its second half is apart.
"$command" simulate crowd --frames 40 --pedestrians 20 --rate 4 -o data > /dev/null 2>&1
part a 0 9
part b 10 19
part c 20 29
part d 30 39
awk 'NR > 5 { $4 += 60 } { print }' d/poses.txt > moved && mv moved d/poses.txt
options="--tile-voxels 8000 --deskew off --no-report"

# Drive by drive, and out of order, with evidence and without.
run a $options --keep-evidence -o of_a
run b --no-report --update of_a -o of_b
run a b $options -o ab
same ab/map of_b/map "the map of two drives is not that of a run of both"
same ab/drives/b of_b/drives/b "the labels of the second drive are not those of a run of both"
same of_a/map of_b/history/1/map "the first map is not given back"
run d --no-report --update of_b -o of_d
run a b d $options -o abd
same abd/map of_d/map "the map of a drive that jumps"
same abd/drives/d of_d/drives/d "the labels of a drive that jumps"
run c --no-report --update of_d -o of_c
run a b d c $options -o abdc
same abdc/map of_c/map "the map after a drive that jumps"
same of_d/map of_c/history/3/map "the third map is not given back"
same ab/map of_c/history/2/map "the second map is not given back"
run b c --no-report --update of_a -o of_two
run a b c $options -o abc
same abc/map of_two/map "two drives at once"
expect 0 "" info of_c
expect 0 "" info of_c/history/2
expect 0 "written old.png" render of_c/history/2 -o old.png --width 320 --height 200
expect 0 "" convert of_c/history/2 old_tiles --to las
expect 2 "which labels the new drives alone" convert of_c cloud.pcd
expect 0 "" convert of_c tiles --to las
expect 0 "seen at both dates" diff of_a of_b -o changes
cp -r ab bare
expect 0 "has no evidence" run c --no-report --update bare -o of_bare
same abc/map of_bare/map "the map of a run without evidence"

# A drive that reaches a part of the map: the other tiles stay as they are.
"$command" simulate city --km 0.3 --drives 2 --rate 1 -o city > /dev/null 2>&1
mkdir -p near/velodyne
for i in 0 1 2 3 4; do cp "city/drive_2/velodyne/00000$i.bin" near/velodyne; done
head -5 city/drive_2/poses.txt > near/poses.txt
head -5 city/drive_2/times.txt > near/times.txt
city_options="--tile-voxels 20000 --deskew off --no-report"
run city/drive_1 $city_options --keep-evidence -o far
run near --no-report --update far -o of_near
run city/drive_1 near $city_options -o both
same both/map of_near/map "the map of a drive that reaches a part of it"
[ "$(find of_near/map -name '*.pcd' -links +2 | wc -l)" -gt 3 ] || fail "no tile stayed as it was"

# Poses that are off are found in the world of the map, also of one that was updated; a drive that is not there is refused.
awk '{ $4 += 1.2; $8 -= 0.7; print }' near/poses.txt > off.txt
expect 0 "places lie on the map" odometry near --poses off.txt --onto of_near -o found.txt
paste -d ' ' near/poses.txt found.txt | awk '($4 - $16)^2 + ($8 - $20)^2 + ($12 - $24)^2 > 0.01 { exit 1 }' || fail "poses on the map"
run near --poses found.txt --no-report --update far -o of_found
expect 2 "the map in of_near: no place looks like its own" odometry c --onto of_near -o refused.txt
[ ! -e refused.txt ] || fail "poses of a drive that was refused"
expect 3 "does not exist" odometry near --onto nothing -o refused.txt

# A run in memory, and a recording in the way of the earlier run.
"$command" run a --no-report -o memory > said 2>&1 || fail "a run in memory"
run b --no-report --update memory -o of_memory
[ -e of_memory/history/1/static_map.pcd ] || fail "the map of a run in memory is not given back"

# Poses that a run refined, or that are given by name, go with the map, wherever it is moved to.
run a --no-report --refine on -o refined
run b --no-report --update refined -o moving
mv moving moved
rm -r refined
run c --no-report --update moved -o of_moved
[ -e of_moved/evidence/poses_1.txt ] || fail "the refined poses are gone"
mv b/poses.txt named.txt
run b $options --poses named.txt --keep-evidence -o of_named
echo spoilt > named.txt
run c --no-report --update of_named -o of_named_c
cp of_named/evidence/poses_1.txt b/poses.txt
run b c $options -o bc
same bc/map of_named_c/map "poses that were given by name"

# Evidence that is damaged or missing is found anew; a map that is damaged is not taken over.
for spoil in 'flip spoilt/evidence/plan' 'rm spoilt/evidence/plan' 'for f in spoilt/evidence/*.evidence; do flip "$f"; done'; do
    rm -rf spoilt of_spoilt
    cp -r of_d spoilt
    eval "$spoil"
    run c --no-report --update spoilt -o of_spoilt
    same abdc/map of_spoilt/map "after: $spoil"
done

spoilt() {  # spoilt CODE TEXT COMMAND: an update of a map that was spoilt so
    rm -rf spoilt
    cp -r of_d spoilt
    eval "$3"
    expect "$1" "$2" run c --update spoilt -o refused
    rm -rf refused
}
spoilt 3 "is not the file that its run wrote" 'for f in spoilt/map/*.pcd; do flip "$f"; done'
spoilt 3 "is missing" 'rm "$(ls spoilt/map/*.pcd | head -1)"'
spoilt 3 "index.json" 'rm spoilt/map/index.json'
spoilt 2 "are not those of its run any more" 'sed -i "s/voxel_size = .*/voxel_size = 0.3/" spoilt/config.toml'
for number in 99 -1 x; do spoilt 3 "is damaged" "sed -i 's/^update of .*/update of $number/' spoilt/.run"; done

# Ten updates in a row, each of them killed at a random moment and given again: the bytes of an unbroken series, of which
# each map is given back, and no update changes the map that it began with.
for i in $(seq 0 10); do part "part$i" $((3 * i)) $((3 * i + 2)); done
run part0 $options --keep-evidence -o unbroken0
cp -r unbroken0 broken0
for i in $(seq 10); do
    last=$((i - 1))
    bytes_of "broken$last" > before.md5
    began=$(date +%s%N)
    run "part$i" --no-report --update "unbroken$last" -o "unbroken$i"
    took=$((($(date +%s%N) - began) / 1000))
    "$command" run "part$i" --no-report --update "broken$last" -q -o "broken$i" > /dev/null 2>&1 &
    process=$!
    # Multiples of a prime scatter over the run.
    sleep "$(awk "BEGIN { print ($i * 7919 % 1000) / 1000 * 1.1 * $took / 1e6 }")"
    kill -9 "$process" 2> /dev/null || true
    wait "$process" 2> /dev/null || true
    run "part$i" --no-report --update "broken$last" -o "broken$i" --resume
    for what in map evidence history drives; do
        same "broken$i/$what" "unbroken$i/$what" "kill $i: other files in $what"
    done
    bytes_of "broken$last" > after.md5
    cmp -s before.md5 after.md5 || fail "update $i changed the map that it began with"
done
run part0 part1 part2 part3 part4 part5 part6 part7 part8 part9 part10 $options -o all_parts
same all_parts/map broken10/map "the map after ten updates is not that of a run of all"
for i in $(seq 10); do same "unbroken$((i - 1))/map" "broken10/history/$i/map" "the map of session $i is not given back"; done
run c --no-report --update of_d -o broken10 --overwrite
same broken10/map of_c/map "overwritten"
[ ! -e broken10/history/4 ] || fail "the history of the result before stayed"

# What does not fit is refused before anything is written.
mkdir other
cp -r c other/c
awk '{ $4 += 1; print }' c/poses.txt > other/c/poses.txt
expect 2 "add (-1.00, 0.00, 0.00) m" run other/c --update of_b -o refused
expect 4 "warning: the world frames" run other/c --update of_b --trust-poses -o trusted
awk '{ $4 += 500; print }' c/poses.txt > other/c/poses.txt
expect 2 "passes no place of the map" run other/c --update of_b -o refused
cp b/poses.txt other/c/poses.txt
expect 2 "have the same poses" run other/c --update of_b -o refused
expect 2 "b is a drive of the map" run b --update of_b -o refused
expect 2 "is the map to update" run c --update of_b -o of_b
expect 2 "within the map to update" run c --update of_b -o of_b/map/sub
expect 2 "does not go with --part" run c --keep-evidence --part 1/2 -o refused
expect 3 "does not exist" run c --update nowhere -o refused
expect 3 "is not the whole output folder" run c --update data -o refused
expect 2 "the settings of an update" run c --update of_b --set map.voxel_size=0.3 -o refused
expect 2 "the recordings are read as" run c --update of_b --point-unit cm -o refused
expect 2 "leave --tile-voxels out" run c --update of_b --tile-voxels 9000 -o refused
expect 2 "does not go with" run c --update of_b --part 1/2 -o refused
expect 2 "does not go with" run c --update of_b --online -o refused
expect 3 "has no poses" run c --update of_b --poses none -o refused
sed -i /complete/d ab/.run
expect 3 "is not complete" run c --update ab -o refused
rm -r of_b/evidence
expect 3 "nothing tells how" run c --update of_b -o refused
mv a gone
expect 2 "does not exist" run c --update of_d -o refused
[ ! -e refused ] || fail "an update that was refused left something"
echo "updates, history, kills and wrong input: all as expected"
