#!/usr/bin/env bash
# client.sh BIN: installs Foxglove's client from npm in a temporary folder, and runs client_tests.mjs with it. Without node or
# npm it fails (launch_scripts/test.sh installs them).
set -euo pipefail
here=$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")
for program in node npm; do
  command -v "$program" >/dev/null || { echo "$program is missing: Foxglove's server was not tested" && exit 1; }
done
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cp "$here"/{package.json,package-lock.json,client_tests.mjs} "$work"
cd "$work"
npm ci --silent --no-audit --no-fund
TERN_BIN=$1 "$here/../../support/hermetic.sh" node --test client_tests.mjs
