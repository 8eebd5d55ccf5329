#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# `dynamicfilter live` on ROS 2's wire, as a process: what it says to a drive is what `run` says to the bag of it, and
# each mistake that people make is named.
#   live_test.sh COMMAND PLAYER
set -euo pipefail
command=$1 player=$2
work=$(mktemp -d)
live=
trap '[ -z "$live" ] || kill -9 "$live" 2> /dev/null || true; rm -rf "$work"' EXIT
export ROS_DOMAIN_ID=93
unset CYCLONEDDS_URI
fail() { echo "live_test: $1" >&2; cat "$work"/*.err >&2 || true; exit 1; }
cd "$work"

start() { # start NAME OPTION...
    local name=$1
    shift
    "$command" live "$@" > "$name.log" 2> "$name.err" &
    live=$!
    for _ in $(seq 200); do
        grep -q '^listens' "$name.err" && return
        sleep 0.05
    done
    fail "$name does not listen"
}
stop() { # stop SIGNAL
    kill "-$1" "$live"
    local code=0
    wait "$live" || code=$?
    live=
    [ "$code" = 0 ] || fail "ended with $code after $1"
}

"$command" simulate crowd --sensor vlp16 --frames 40 --rate 10 -o recording -q
rm -r recording/labels # so that the bag has a single topic of points
"$command" convert recording drive.mcap > /dev/null 2>&1

# A drive, recorded: instant labels are the library's, and the folder is that of `run --online`.
start drive --record out
"$player" drive.mcap --domain $ROS_DOMAIN_ID --all --check > player.json || fail "labels are missing: $(cat player.json)"
grep -q '"differing": 0' player.json || fail "labels differ: $(cat player.json)"
for topic in static dynamic map removed path; do
    grep -q "\"/dynamicfilter/$topic\"" player.json || fail "nothing on $topic: $(cat player.json)"
done
grep -q '"/diagnostics"' player.json || fail "no diagnostics"
stop INT
grep -q '^input    40 scans received; 40 taken' drive.log || fail "counters: $(cat drive.log)"
"$command" run drive.mcap -o ref -q --refine off --deskew off --online --speed 0 --no-report
diff -r ref/labels out/labels || fail "labels of the folder differ from those of run"
cmp ref/static_map.pcd out/static_map.pcd || fail "maps differ"
[ -s out/report.html ] || fail "no report"

# Two sensors of one vehicle: each scan has the pose of its own, and the recording can be filtered again.
for sensor in 'front 0.3,0,0,0,0,0 0' 'rear -0.3,0,0,0,0,180 0.05'; do
    read -r name mount delay <<< "$sensor"
    "$command" simulate crowd --sensor vlp16 --frames 30 --rate 10 "--mount=$mount" --delay "$delay" -o "$name" -q
    rm -r "$name/labels"
    printf '[[sensor]]\nname = "%s"\nrecording = "%s"\n' "$name" "$name" >> rig.toml
done
"$command" convert rig.toml rig.mcap > /dev/null 2>&1
start rig --record both --set 'input.cloud=/front/points /rear/points'
"$player" rig.mcap --domain $ROS_DOMAIN_ID --topic /front/points > front.json &
"$player" rig.mcap --domain $ROS_DOMAIN_ID --topic /rear/points > rear.json || fail "labels are missing: $(cat rear.json)"
wait $! || fail "labels are missing: $(cat front.json)"
stop INT
grep -q '^input    60 scans received; 60 taken' rig.log || fail "counters of two sensors: $(cat rig.log)"
[ "$(find both/labels -name '*.label' | wc -l)" = 60 ] || fail "scans of two sensors are missing in the recording"
grep -q '2 sensors, which take turns' both/run.log || fail "the recording of two sensors: $(cat both/run.log)"

# SIGTERM ends at once, and the recording is complete.
start term --record gone --set foxglove.serve=true --set foxglove.port=0
for _ in $(seq 100); do grep -q '^foxglove ws://127.0.0.1:' term.err && break; sleep 0.05; done
grep -q '^foxglove ws://127.0.0.1:' term.err || fail "does not say where Foxglove connects"
"$player" drive.mcap --domain $ROS_DOMAIN_ID > /dev/null || fail "labels are missing"
stop TERM
[ -s gone.mcap ] && [ ! -e gone ] || fail "SIGTERM leaves the recording alone"
"$command" info gone.mcap | grep -q '40' || fail "the recording is not complete"

# Asked by a message, the filter saves the map while scans come, and answers; without --map it says why not.
start asked --map asked.pcd
"$player" drive.mcap --domain $ROS_DOMAIN_ID --save > player.json || fail "labels are missing: $(cat player.json)"
stop TERM
python3 - player.json "$PWD/asked.pcd" << 'END' || fail "the answer: $(cat player.json)"
import json, sys
answer = json.load(open(sys.argv[1]))["answer"]
assert answer["saved"] and answer["file"] == sys.argv[2] and answer["points"] > 1000 and answer["bytes"] > 1000, answer
END
grep -q '^input    40 scans received; 40 taken' asked.log || fail "the request lost scans: $(cat asked.log)"
start refused
"$player" drive.mcap --domain $ROS_DOMAIN_ID --save > player.json || fail "labels are missing: $(cat player.json)"
stop TERM
grep -q '"saved":false,"why":"the filter was started without --map FILE"' player.json || fail "the refusal: $(cat player.json)"

# A file of another name beside that of --map; a name that leads elsewhere is refused.
start named --map asked.pcd --overwrite
"$player" drive.mcap --domain $ROS_DOMAIN_ID --save --save-as hall.ply > player.json || fail "labels are missing"
grep -q "\"file\":\"$PWD/hall.ply\"" player.json || fail "the answer: $(cat player.json)"
"$player" drive.mcap --domain $ROS_DOMAIN_ID --save --save-as ../hall.ply > player.json || true
grep -q 'is no name of a file beside' player.json || fail "the refusal: $(cat player.json)"
stop TERM
head -1 hall.ply | grep -q ply && [ ! -e ../hall.ply ] || fail "the map of another name"

# Asked from a shell, without ROS: the answer comes when it is done.
expect() { # expect CODE TEXT OPTION...
    local code=0 wanted=$1 text=$2
    shift 2
    timeout 60 "$command" live "$@" > wrong.log 2> wrong.err || code=$?
    [ "$code" = "$wanted" ] || fail "live $*: code $code instead of $wanted"
    cat wrong.log wrong.err | grep -q -- "$text" || fail "live $*: does not say '$text' but $(cat wrong.log wrong.err)"
}
start shell --map shell.pcd
expect 4 'nothing static is known yet' --ask save
"$player" drive.mcap --domain $ROS_DOMAIN_ID > player.json &
playing=$!
sleep 2
expect 0 "^{\"saved\":true,\"file\":\"$PWD/shell.pcd\",\"points\":[0-9]*,\"bytes\":[0-9]*}$" --ask save
[ "$(stat -c %s shell.pcd)" = "$(grep -o 'bytes":[0-9]*' wrong.log | cut -d: -f2)" ] || fail "the file is not that of the answer"
wait $playing || fail "labels are missing: $(cat player.json)"
expect 0 "\"file\":\"$PWD/shop.ply\"" --ask save=shop.ply
expect 4 'is no name of a file beside' --ask save=../shop.ply
expect 0 '^{"paused":true,"resets":0}$' --ask pause
expect 0 '^{"paused":false,"resets":0}$' --ask resume
expect 0 '^{"paused":false,"resets":1}$' --ask reset
expect 2 'expected save, save=NAME' --ask stop
expect 1 'nobody offers the service /front/save_map' --ask save --set output.prefix=/front
stop TERM
grep -q '^input    40 scans received; 40 taken' shell.log || fail "the requests lost scans: $(cat shell.log)"
head -1 shop.ply | grep -q ply || fail "the map of another name, asked from a shell"

# Asked for a new map, the filter begins one; in a pause it leaves scans out, and goes on after it.
start anew --map anew.pcd
"$player" drive.mcap --domain $ROS_DOMAIN_ID --reset > player.json || fail "labels are missing: $(cat player.json)"
stop TERM
grep -q 'a message asked for a new map' anew.err || fail "no new map: $(cat anew.err)"
start paused
"$player" drive.mcap --domain $ROS_DOMAIN_ID --pause > player.json && fail "scans were judged during a pause"
stop TERM
python3 - player.json paused.log << 'END' || fail "the pause: $(cat player.json paused.log)"
import json, re, sys
labels = json.load(open(sys.argv[1]))["labels"]
assert 25 <= labels <= 35, labels  # of 40, ten come during the pause
assert int(re.search(r"(\d+) left out during pauses", open(sys.argv[2]).read())[1]) == 40 - labels
END

# The map at SIGUSR1, while scans come and after them, and at the end; none before the first scan.
start saved --map map.pcd
kill -USR1 "$live"
for _ in $(seq 100); do grep -q 'nothing static is known yet' saved.err && break; sleep 0.05; done
grep -q '^warning: nothing static is known yet, so no map is saved' saved.err || fail "no answer before the first scan"
[ ! -e map.pcd ] || fail "a map of nothing"
"$player" drive.mcap --domain $ROS_DOMAIN_ID --all --check > player.json &
playing=$!
sleep 2
kill -USR1 "$live"
wait $playing || fail "labels are missing: $(cat player.json)"
for _ in $(seq 100); do grep -q 'saved map.pcd' saved.err && break; sleep 0.05; done
grep -q '^note: saved map.pcd: [0-9]* points, [0-9]* bytes$' saved.err || fail "does not say what it saved"
"$command" info map.pcd | grep -q probability || fail "no map"
stop TERM
grep -q '^input    40 scans received; 40 taken' saved.log || fail "saving lost scans: $(cat saved.log)"
[ "$(tail -1 saved.err)" = "saved map.pcd: $("$command" info map.pcd | sed -n 's/^ *points *//p') points, $(stat -c %s map.pcd) bytes" ] ||
    fail "the map at the end: $(tail -1 saved.err)"

# Wrong settings, and what is there already.
expect 2 "did you mean 'input.cloud'" --set input.clod=/points
expect 2 "did you mean 'input.cloud'" --ros-args -p input.clod:=/points
expect 2 "unknown option '--what'" --ros-args -p input.cloud:=/points -- --what
expect 2 'exists; choose another --record' --record out.mcap
expect 2 'exists; choose another --record' --record out
expect 2 'expected a file of .pcd' --map map.txtt
expect 2 'there is no folder' --map nowhere/map.pcd
expect 2 '--overwrite' --map map.pcd
expect 1 'cannot join DDS domain' --set bus.network=nosuchdevice
expect 4 'nothing is published that could be used' --dry-run --look 1

# A dry run while something is published.
"$player" drive.mcap --domain $ROS_DOMAIN_ID --passes 100 > /dev/null 2>&1 &
player_id=$!
expect 4 'nobody publishes scans on /point; there are: /points; did you mean /points' --dry-run --look 3 --set input.cloud=/point
expect 4 'nothing was received on /odom' --dry-run --look 3 --set input.pose=/odom
expect 0 'fits ' --dry-run --look 4
grep -q "poses    poses of 'lidar' in 'map' from /tf" wrong.log || fail "does not name the poses: $(cat wrong.log)"
expect 0 '^gives    /front/clean/static ' --dry-run --look 4 --ros-args -r __node:=clean -r __ns:=/front -p use_sim_time:=true
kill "$player_id" 2> /dev/null || true
wait "$player_id" 2> /dev/null || true
