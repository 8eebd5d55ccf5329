#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# The poses of drives that are found on the map of another drive: errors against those of the simulator, and other cities,
# which must be refused (docs/upkeep.md).   bench/onto.sh COMMAND FOLDER
set -euo pipefail
command=$(realpath "$1") folder=$2
root=$(cd "$(dirname "$0")/.." && pwd)
mkdir -p "$folder"
cd "$folder"
cities='7:hdl32:0.3 11:vlp16:0.3 31:vlp16:0.25 32:os64:0.25 99:hdl32:0.2'
for city in $cities; do
    IFS=: read -r seed sensor km <<< "$city"
    [ -d "map_$seed" ] && continue
    "$command" simulate city --km "$km" --drives 3 --seed "$seed" --sensor "$sensor" --rate 5 -o "city_$seed" -q
    "$command" run "city_$seed/drive_1" -o "map_$seed" -q --no-report --no-maps
done
onto() { # onto DRIVE MAP: prints what was said, and the errors of the poses
    local said code=0
    said=$("$command" odometry "$1" --poses none --onto "$2" -o found.txt --overwrite 2>&1) || code=$?
    echo "$1 onto $2: $(grep -E '^placed|does not fit' <<< "$said")"
    [ "$code" = 0 ] || return 0
    python3 "$root/bench/pose_errors.py" "$1/poses.txt" found.txt
}
for city in $cities; do
    seed=${city%%:*}
    for drive in 2 3; do onto "city_$seed/drive_$drive" "map_$seed"; done
done
for pair in 31:32 32:31 99:7 31:11 11:31 7:11; do onto "city_${pair%:*}/drive_2" "map_${pair#*:}"; done
