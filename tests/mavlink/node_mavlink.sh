#!/usr/bin/env bash
# node_mavlink.sh: checks that npm's node-mavlink makes the recorded frames of the tests.
# It fails without node or npm, so that the check cannot be skipped (launch_scripts/test.sh installs them).
set -euo pipefail
here=$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")
for program in node npm; do
  command -v "$program" >/dev/null || { echo "$program is missing: MAVLink's frames were not compared" && exit 1; }
done
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cp "$here"/{package.json,package-lock.json,make_frames.mjs} "$work"
(cd "$work" && npm ci --silent --no-audit --no-fund && node make_frames.mjs) >"$work/frames.txt"
diff "$here/frames.txt" "$work/frames.txt"
