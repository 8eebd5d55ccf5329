#!/bin/sh
# SPDX-License-Identifier: MIT
# foxglove.sh SERVER ENCODING: what Foxglove's client receives from SERVER is what SERVER sends.
set -eu
here=$(dirname "$0")
if ! command -v node >/dev/null || [ ! -d "$here/node_modules/@foxglove/ws-protocol" ]; then
    echo "SKIPPED: no node, or no tests/peers/node_modules; run script/bootstrap tests" >&2
    exit 77
fi
exec node "$here/read_foxglove.mjs" "$@"
