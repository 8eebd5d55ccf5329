#!/bin/sh
# Without simulator, live part and viewer, the command builds, says what it has not got, and filters.
#   left_out_test.sh SOURCE BUILD LAUNCHER     BUILD: of the whole program, which simulates
set -eu
source=$1 build=$2 launcher=$3
work=$build/tests/left_out
rm -rf "$work"
mkdir -p "$work"
cd "$work"
git -C "$source" ls-files -z CMakeLists.txt cmake include python ros1 src viewer packaging examples README.md CHANGELOG.md |
    (cd "$source" && xargs -0 tar -c) | tar -x --one-top-level=source  # without viewer/node_modules
cmake -S source -B slim -G Ninja -DCMAKE_CXX_COMPILER_LAUNCHER="$launcher" -DDYNAMIC_FILTER_SIMULATOR=OFF \
    -DDYNAMIC_FILTER_LIVE=OFF -DDYNAMIC_FILTER_PYTHON=OFF -DDYNAMIC_FILTER_TESTS=OFF -DDYNAMIC_FILTER_BENCH=OFF > cmake.log 2>&1
grep -q 'viewer/node_modules is missing' cmake.log
cmake --build slim --target dynamicfilter > build.log || { tail -n 40 build.log; exit 1; }
slim=slim/dynamicfilter

refuses() {  # WORD COMMAND...: exit code 2, and the option that brings it
    word=$1
    shift
    code=0
    "$slim" "$@" > said 2>&1 || code=$?
    [ "$code" -eq 2 ] || { echo "$*: exit code $code"; cat said; exit 1; }
    grep -q "left out .*-DDYNAMIC_FILTER_$word=ON" said || { echo "$*:"; cat said; exit 1; }
}
refuses SIMULATOR simulate crowd -o simulated
refuses SIMULATOR demo -o demo
refuses LIVE live robot.toml --dry-run
[ ! -e simulated ] && [ ! -e demo ]
if ldd "$slim" | grep -E 'embree|ddsc|websockets'; then exit 1; fi

"$build/dynamicfilter" simulate crowd --frames 30 --pedestrians 20 -q -o recording
"$build/dynamicfilter" run recording -q -o whole
"$slim" run recording -q -o out 2> said
diff -r whole/labels out/labels
cmp whole/static_map.pcd out/static_map.pcd
[ ! -e out/report.html ] || { echo "a report without a viewer"; exit 1; }
