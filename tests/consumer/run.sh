#!/bin/sh
# Installs, moves what was installed elsewhere, and builds a project against it.
#   run.sh SOURCE BUILD LAUNCHER [FLAGS]
set -eu
source=$1 build=$2 launcher=$3 flags=${4:-}
work=$build/tests/consumer
rm -rf "$work"
cmake --install "$build" --prefix "$work/elsewhere" > "$work.log"
mv "$work/elsewhere" "$work/prefix"
if grep -r "$source" "$work/prefix/lib/cmake"; then exit 1; fi
"$source/tests/consumer/build.sh" "$source" "$work/prefix" "$work" "$launcher" "$flags"
