#!/bin/sh
# SPDX-License-Identifier: MIT
# compare.sh WRITER EXTENSION READER...: what READER finds in a file is what WRITER put in it.
set -eu
writer=$1 extension=$2
shift 2
here=$(dirname "$0")
if [ "$1" = node ]; then
    if ! command -v node >/dev/null || [ ! -d "$here/node_modules" ]; then
        echo "SKIPPED: no node, or no tests/peers/node_modules;" \
             "run script/bootstrap tests" >&2
        exit 77
    fi
fi
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
"$writer" "$folder/a.$extension" >"$folder/written"
"$@" "$folder/a.$extension" >"$folder/read"
diff "$folder/written" "$folder/read"
echo "$(wc -l <"$folder/read") lines are the same"
