#!/bin/sh
# SPDX-License-Identifier: MIT
# usage: run.sh VIEWER_HTML: drives the built page in a browser. 77: skipped, since something that it needs is missing.
set -eu
html=${1:?usage: run.sh VIEWER_HTML}
here=$(cd "$(dirname "$0")" && pwd)
skip() {
  echo "SKIPPED: the viewer's tests: $1" >&2
  exit 77
}
command -v node > /dev/null || skip "there is no node"
[ -f "$html" ] || skip "there is no $html (viewer/build.py $html)"
[ -d "$here/../../viewer/node_modules/playwright-core" ] || skip "there is no viewer/node_modules (script/bootstrap tests)"
[ -x "${CHROMIUM:-/usr/bin/chromium}" ] || skip "there is no ${CHROMIUM:-/usr/bin/chromium} (apt-get install --no-install-recommends chromium)"
VIEWER_HTML=$html exec node --test --test-reporter=spec "$here/viewer.test.mjs"
