#!/bin/sh
# How well rigs of two and three sensors are filtered, on simulated scenes: the scans of each sensor, with the labels of a
# run of the sensor alone and with those of the rig. The table of docs/rigs.md. Takes some minutes. usage: bench/rigs.sh [COMMAND]
set -eu
command=$(realpath "${1:-build/release/dynamicfilter}")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"

scores() {  # RECORDING LABELS: F1 and AA
    "$command" eval --truth "$1" --labels "$2" > said 2> /dev/null
    f1=$(awk '$1 == "majority" { print $4 }' said)
    aa=$(sed -n 's/.* AA \([0-9.]*\).*/\1/p' said)
    printf '%s / %s' "$f1" "$aa"
}

filter() { "$command" run "$1" -o "$2" --overwrite --no-report --no-maps -q > /dev/null 2>&1 || [ $? = 4 ]; }

of_labels() {  # scores of each sensor's scans with the labels of the rig
    text=""
    for k in $(seq 0 $((count - 1))); do
        rm -rf one
        mkdir one
        for file in out/labels/s"$k"_*.label; do cp "$file" "one/${file##*_}"; done
        text="$text$(scores "rig/s$k" one), "
    done
    echo "${text%, }"
}

# NAME SCENE SENSOR SEED FRAMES RATE MOUNT...; mounts are X,Y,Z,ROLL,PITCH,YAW
rig() {
    name=$1 scene=$2 sensor=$3 seed=$4 frames=$5 rate=$6
    shift 6
    rm -rf rig
    mkdir rig
    alone="" k=0 count=$#
    for mount; do
        delay=$(awk "BEGIN { print $k / $rate / $count }")
        "$command" simulate "$scene" --sensor "$sensor" --seed "$seed" --frames "$frames" --rate "$rate" \
            "--mount=$mount" --delay "$delay" -o "rig/s$k" -q
        echo "$mount" | awk -F, -v k=$k '{ printf "[[sensor]]\nname = \"s%d\"\nrecording = \"s%d\"\nat = [%s, %s, %s]\n" \
            "turn = [%s, %s, %s]\n", k, k, $1, $2, $3, $4, $5, $6 }' >> rig/rig.toml
        filter "rig/s$k" out
        alone="$alone$(scores "rig/s$k" out/labels), "
        k=$((k + 1))
    done
    filter rig/rig.toml out
    all=$(of_labels)
    for k in $(seq 2 $count); do mv "rig/s$((k - 1))/poses.txt" "poses$k"; done
    filter rig/rig.toml out
    for k in $(seq 2 $count); do mv "poses$k" "rig/s$((k - 1))/poses.txt"; done
    echo "| $name | ${alone%, } | $all | $(of_labels) |"
}

echo '| rig | each sensor, filtered alone: F1 / AA | with the labels of the rig | the same, if only the first sensor has poses |'
echo '|---|---|---|---|'
rig 'street, two with 64 beams, front and rear' street os64 5 100 5 0.8,0,0,0,0,0 -0.8,0,0,0,0,180
rig 'crowd, two VLP-16, one tilted' crowd vlp16 7 150 2.5 0,0,0,0,0,0 0,0.4,-0.3,30,0,90
rig 'square, three VLP-16, two tilted' square vlp16 34 100 5 0,0,0,0,0,0 0.3,0.4,-0.2,25,0,90 0.3,-0.4,-0.2,25,0,-90
rig 'square, three solid state, ahead and to the sides' square solid 3 100 5 0.5,0,0,0,0,0 0,0.4,0,0,0,100 0,-0.4,0,0,0,-100
