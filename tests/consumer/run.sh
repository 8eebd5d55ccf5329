#!/bin/sh
# Installs, moves what was installed elsewhere, builds a project against it, and runs the examples.
#   run.sh SOURCE BUILD LAUNCHER [FLAGS]
set -eu
source=$1 build=$2 launcher=$3 flags=${4:-}
work=$build/tests/consumer
rm -rf "$work"
cmake --install "$build" --prefix "$work/elsewhere" > "$work.log"
mv "$work/elsewhere" "$work/prefix"
if grep -r "$source" "$work/prefix/lib/cmake"; then exit 1; fi

cmake -S "$source/tests/consumer" -B "$work/build" -G Ninja -DCMAKE_PREFIX_PATH="$work/prefix" \
    -DCMAKE_CXX_COMPILER_LAUNCHER="$launcher" -DCMAKE_CXX_FLAGS="$flags"
cmake --build "$work/build"

"$work/prefix/bin/dynamicfilter" simulate crowd -o "$work/recording" --frames 40
cd "$work/build/examples"
../simulate
./scan_by_scan
./clean_folder "$work/recording" "$work/out"
./online "$work/recording"
./own_reader "$work/recording"
./evaluate "$work/recording"

# As the command does it, to the byte.
"$work/prefix/bin/dynamicfilter" run "$work/recording" -o "$work/run"
diff -r "$work/out/labels" "$work/run/labels"
