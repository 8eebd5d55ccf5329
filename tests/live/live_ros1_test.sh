#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# The ROS 1 node as a process, with Debian's master and `rosbag play` of a bag that we wrote, in the bag's time: the
# folder of a drive is that of `run`; bags that begin anew, a master that dies, and parameters.
#   live_ros1_test.sh COMMAND NODE MESSAGES
# MESSAGES is the folder of dynamicfilter_msgs.
set -euo pipefail
command=$1 node=$2 messages=$3
work=$(mktemp -d)
processes=
clean_up() {
    local process
    for process in $processes; do kill -9 "$process" 2> /dev/null || true; done
    rm -rf "$work"
}
trap clean_up EXIT
fail() { echo "live_ros1_test: $1" >&2; tail -n 20 "$work"/*.err >&2 || true; exit 1; }
cd "$work"
port=$(python3 -c 'import socket; s = socket.socket(); s.bind(("127.0.0.1", 0)); print(s.getsockname()[1])')
export ROS_MASTER_URI=http://127.0.0.1:$port ROS_IP=127.0.0.1 ROS_HOME=$work/ros ROS_LOG_DIR=$work/ros
unset ROS_HOSTNAME

start_master() {
    rosmaster --core -p "$port" > master.log 2>&1 &
    master=$!
    processes="$processes $master"
    for _ in $(seq 200); do
        ros 'm.getPid("/test")' > /dev/null 2>&1 && break
        sleep 0.1
    done
    ros 'm.setParam("/test", "/use_sim_time", True)' > /dev/null
}
ros() { /usr/bin/python3 -c "import os, xmlrpc.client; m = xmlrpc.client.ServerProxy(os.environ['ROS_MASTER_URI']); print($1)"; }
start() { # start NAME OPTION...
    local name=$1
    shift
    "$node" "$@" > "$name.log" 2> "$name.err" &
    filter=$!
    processes="$processes $filter"
    wait_for "$name.err" '^listens'
}
wait_for() { # wait_for FILE TEXT
    for _ in $(seq 300); do
        grep -q -- "$2" "$1" && return
        sleep 0.1
    done
    fail "$1 does not say '$2'"
}
stop() { # stop SIGNAL
    kill "-$1" "$filter"
    local code=0
    wait "$filter" || code=$?
    [ "$code" = 0 ] || fail "ended with $code after $1"
}
play() { timeout 60 rosbag play --quiet --clock --wait-for-subscribers drive.bag > play.log 2>&1 || fail "rosbag: $(cat play.log)"; }

"$command" simulate crowd --sensor vlp16 --frames 31 --rate 10 -o recording -q
rm -r recording/labels # so that the bag has a single topic of points
"$command" convert recording drive.bag --first 1 > /dev/null 2>&1 # rosbag leaves out what has the time 0
start_master

# A drive in the bag's time; then the bag begins anew, and a parameter changes.
start drive --record out __name:=filter
play
sleep 1
play
ros 'm.setParam("/test", "/filter/output/map_rate", 2.0)' > /dev/null
wait_for drive.err 'output.map_rate is 2'
ros 'm.getTopicTypes("/test")' | grep -q "/dynamicfilter/labels', 'sensor_msgs/PointCloud2'" || fail "labels are not announced"
sleep 1
stop INT
grep -q '^input    60 scans received; 60 taken' drive.log || fail "counters: $(cat drive.log)"
grep -q 'went back' drive.err || fail "the clock that was set back is not named"
grep -q 'a new map begins' drive.err || fail "no new map"
for folder in out out-2; do # a recording has one time, so the second pass has its own
    [ -s $folder.bag ] && [ -s $folder/report.html ] || fail "no recording"
done
diff -r out/labels out-2/labels || fail "the passes differ"

# The first pass alone is what `run` makes of the bag.
start once --record first
play
sleep 1
stop INT
"$command" run drive.bag -o ref -q --refine off --deskew off --online --speed 0 --no-report
diff -r ref/labels first/labels || fail "labels differ from those of run"
cmp ref/static_map.pcd first/static_map.pcd || fail "maps differ"

# Asked by a message, the node saves the map and answers.
start asked --map asked.pcd
play
timeout 60 /usr/bin/python3 - > answer.json 2> answer.err << 'END' || fail "no answer: $(cat answer.err)"
import time
import rospy
import json
from std_msgs.msg import Bool, Empty, String
rospy.init_node("asker", disable_signals=True)
answers = []
rospy.Subscriber("/dynamicfilter/saved_map", String, lambda message: answers.append(message.data))
asks = rospy.Publisher("/dynamicfilter/save_map", Empty, queue_size=1)
while not asks.get_num_connections():
    time.sleep(0.05)
asks.publish(Empty())
while not answers:
    time.sleep(0.05)
print(answers[0])
states = []
rospy.Subscriber("/dynamicfilter/state", String, lambda message: states.append(json.loads(message.data)))
pause, reset = rospy.Publisher("/dynamicfilter/pause", Bool, queue_size=1), rospy.Publisher("/dynamicfilter/reset", Empty, queue_size=1)
def until(state):
    while not states or states[-1] != state:
        time.sleep(0.05)
until({"paused": False, "resets": 0})
while not (pause.get_num_connections() and reset.get_num_connections()):
    time.sleep(0.05)
pause.publish(Bool(True))
until({"paused": True, "resets": 0})
pause.publish(Bool(False))
reset.publish(Empty())
until({"paused": False, "resets": 1})
END
grep -q "^{\"saved\":true,\"file\":\"$PWD/asked.pcd\",\"points\":[0-9]*,\"bytes\":[0-9]*}$" answer.json || fail "the answer: $(cat answer.json)"
stop INT

# The same by services, while scans come: none is lost, and the answers come from what was done.
start called --map called.pcd
play &
playing=$!
wait_for called.err '^note: poses from'
sleep 1
asks() { # rosservice breaks lines
    timeout 60 rosservice call "$@" > call.txt 2>&1 || fail "rosservice call $*: $(cat call.txt)"
    tr -d "\\\\\n " < call.txt > answer.txt
}
asks /dynamicfilter/save_map
grep -q "^success:True" answer.txt || fail "the map is not saved: $(cat answer.txt)"
bytes=$(grep -o 'bytes[^0-9]*[0-9]*' answer.txt | grep -o '[0-9]*$')
[ "$(wc -c < called.pcd)" = "$bytes" ] || fail "the file is not the one of the answer: $(cat answer.txt)"
package=$work/python/dynamicfilter_msgs/srv
mkdir -p "$package"
/usr/bin/python3 /usr/lib/genpy/gensrv_py.py -p dynamicfilter_msgs -o "$package" "$messages/srv/SaveMap.srv"
/usr/bin/python3 /usr/lib/genpy/gensrv_py.py --initpy -o "$package"
export PYTHONPATH=$work/python${PYTHONPATH:+:$PYTHONPATH}
asks /dynamicfilter/save_map_as '{path: hall, format: ply}'
grep -q "^success:True.*path:.$PWD/hall.ply.points:[0-9]*bytes:$(wc -c < hall.ply)$" answer.txt || fail "the map of another name: $(cat answer.txt)"
asks /dynamicfilter/save_map_as '{path: ../hall.ply, format: ""}'
grep -q '^success:False.*isnonameofafilebeside' answer.txt || fail "a name that leads elsewhere: $(cat answer.txt)"
wait "$playing"
sleep 1
asks /dynamicfilter/pause true
grep -q 'paused[^a-z]*true' answer.txt || fail "no pause: $(cat answer.txt)"
asks /dynamicfilter/pause false
asks /dynamicfilter/reset
grep -q 'resets[^0-9]*1' answer.txt || fail "no reset: $(cat answer.txt)"
wait_for called.err 'asked for a new map'
stop INT
grep -q '^input    30 scans received; 30 taken' called.log || fail "scans were lost while the map was saved: $(cat called.log)"

# A master that dies and comes back.
start survivor
play
kill -9 "$master"
wait "$master" 2> /dev/null || true
wait_for survivor.err 'does not answer'
start_master
wait_for survivor.err 'is back'
play
sleep 1
timeout 60 rosservice call /dynamicfilter/save_map > answer.txt 2>&1 || fail "the service is not back: $(cat answer.txt)"
grep -q 'without --map FILE' answer.txt || fail "a filter without --map: $(cat answer.txt)"
stop TERM
grep -q '^input    60 scans received' survivor.log || fail "scans after the master came back: $(cat survivor.log)"

# Without a master.
kill -9 "$master"
code=0
timeout 60 "$node" --dry-run > wrong.log 2> wrong.err || code=$?
[ "$code" = 1 ] && grep -q 'start roscore, or set ROS_MASTER_URI' wrong.err || fail "without a master: code $code, $(cat wrong.err)"
