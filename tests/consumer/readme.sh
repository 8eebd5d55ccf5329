#!/bin/sh
# The commands of examples/README.md, as they stand there, in a folder and a home of their own.
#   readme.sh SOURCE BUILD
set -eu
work=$2/tests/examples_readme
rm -rf "$work"
mkdir -p "$work/build" "$work/home"
cd "$work"
ln -s "$1/examples" examples
ln -s "$2" build/release
export HOME="$work/home"
"$1/script/lib/code_of" sh examples/README.md > lines
[ "$(wc -l < lines)" -ge 5 ] || { echo "examples/README.md has too few commands"; exit 1; }
sh -eux lines
