#!/bin/sh
# The wheel, in an environment of its own: the README's lines run, and the command is there.
set -eu
source=$1 python=$2
"$python" -c 'import numpy, pip, venv' 2>/dev/null || { echo "skipped: numpy, pip or venv is missing"; exit 77; }
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
command -v patchelf > /dev/null || { echo "skipped: patchelf is missing"; exit 77; }
wheel=$("$source/script/wheel")
"$python" "$source/tests/python/wheel_policy.py" "$source/$wheel"
"$python" -m venv --system-site-packages "$folder/venv"
"$folder/venv/bin/pip" install --quiet --no-index --no-deps "$source/$wheel"
cd "$folder"
venv/bin/dynamicfilter simulate crowd -o demo/recording --frames 20
"$source/script/lib/code_of" python "$source/README.md" > lines.py
[ "$(wc -l < lines.py)" -ge 10 ] || { echo "README.md has too few lines of Python"; exit 1; }
env -u PYTHONPATH venv/bin/python lines.py
