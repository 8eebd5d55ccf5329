#!/bin/sh
# Builds a project against what PREFIX holds, and runs the examples with it.
#   build.sh SOURCE PREFIX WORK [LAUNCHER [FLAGS]]
set -eu
source=$1 prefix=$2 work=$3 launcher=${4:-} flags=${5:-}
cmake -S "$source/tests/consumer" -B "$work/build" -G Ninja -DCMAKE_PREFIX_PATH="$prefix" \
    -DCMAKE_CXX_COMPILER_LAUNCHER="$launcher" -DCMAKE_CXX_FLAGS="$flags"
cmake --build "$work/build"

"$prefix/bin/dynamicfilter" simulate crowd -o "$work/recording" --frames 40
cd "$work/build/examples"
../simulate
./scan_by_scan
./clean_folder "$work/recording" "$work/out"
./online "$work/recording"
./own_reader "$work/recording"
./evaluate "$work/recording"

# As the command does it, to the byte.
"$prefix/bin/dynamicfilter" run "$work/recording" -o "$work/run"
diff -r "$work/out/labels" "$work/run/labels"
