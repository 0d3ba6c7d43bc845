#!/usr/bin/env bash
# flight_log.sh TERN_EXPORT LOG: exports a recorded flight, and reads the MCAP file with npm's @mcap/core and the heads of
# the tables. Without node or npm it fails (launch_scripts/test.sh installs them).
set -euo pipefail
here=$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")
for program in node npm; do
  command -v "$program" >/dev/null || { echo "$program is missing: the export was not tested" && exit 1; }
done
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

"$1" "$2" --csv "$work/tables" --mcap "$work/flight.mcap"

cp "$here"/{package.json,package-lock.json,check_mcap.mjs} "$work"
(cd "$work" && npm ci --silent --no-audit --no-fund && node check_mcap.mjs flight.mcap) | tee "$work/topics"

[[ $(head -1 "$work/tables/PLAN.control_points.csv") == 'message,index,x [m],y [m],z [m]' ]] || { echo "the head of a list" && exit 1; }
plans=$(awk '$1 == "/PLAN" {print $3}' "$work/topics")
rows=$(($(wc -l <"$work/tables/PLAN.csv") - 1))
((plans > 0 && rows == plans)) || { echo "$rows rows of $plans plans" && exit 1; }
for drawn in '/tern/uav foxglove.PoseInFrame' '/tern/obstacles foxglove.SceneUpdate' '/tern/committed foxglove.SceneUpdate' \
  '/tern/regions foxglove.SceneUpdate' '/tern/hulls foxglove.SceneUpdate' '/tern/planes foxglove.SceneUpdate'; do
  grep -q "^$drawn [1-9]" "$work/topics" || { echo "no $drawn" && exit 1; }
done
