#!/usr/bin/env bash
# node_mavlink.sh BIN: a ground station of npm's node-mavlink uploads missions and fences to tern-mission over UDP. Fails without node
# or npm, so that the check cannot be skipped (launch_scripts/test.sh installs them).
set -euo pipefail
here=$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")
readonly PORT=14550
if [[ ${2:-} != inside ]]; then
  for program in node npm; do
    command -v "$program" >/dev/null || { echo "$program is missing: uploads were not tested" && exit 1; }
  done
  work=$(mktemp -d)
  trap 'rm -rf "$work"' EXIT
  cp "$here"/../mavlink/{package.json,package-lock.json} "$here/ground_station.mjs" "$work"
  (cd "$work" && npm ci --silent --no-audit --no-fund)
  "$here/../support/hermetic.sh" "${BASH_SOURCE[0]}" "$1" inside "$work"
  exit
fi
scenario=$here/../../docs/examples/fenced_field.yaml
"$1/tern-mapper" --config "$scenario" --set mission.fence_uploads=true &
"$1/tern-mission" --config "$scenario" --set mission.fence_uploads=true --record "$3" --connect "udpout://127.0.0.1:$PORT" &
trap 'kill $(jobs -p)' EXIT
node "$3/ground_station.mjs" "$PORT"
