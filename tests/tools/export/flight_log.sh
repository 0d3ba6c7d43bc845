#!/usr/bin/env bash
# flight_log.sh TERN_EXPORT LOG: exports a recorded flight, and reads the MCAP file with npm's @mcap/core and
# @foxglove/rosmsg2-serialization, against the tables. Without node or npm it fails (launch_scripts/test.sh installs them).
set -euo pipefail
here=$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")
for program in node npm; do
  command -v "$program" >/dev/null || { echo "$program is missing: the export was not tested" && exit 1; }
done
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

"$1" "$2" --csv "$work/tables" --mcap "$work/flight.mcap"

cp "$here"/{package.json,package-lock.json,check_mcap.mjs} "$work"
(cd "$work" && npm ci --silent --no-audit --no-fund && node check_mcap.mjs flight.mcap tables) | tee "$work/topics"

[[ $(head -1 "$work/tables/PLAN.control_points.csv") == 'message,index,x [m],y [m],z [m]' ]] || { echo "the head of a list" && exit 1; }
plans=$(awk '$1 == "/PLAN" {print $3}' "$work/topics")
rows=$(($(wc -l <"$work/tables/PLAN.csv") - 1))
((plans > 0 && rows == plans)) || { echo "$rows rows of $plans plans" && exit 1; }
for drawn in '/odom nav_msgs/msg/Odometry' '/tf tf2_msgs/msg/TFMessage' '/detections vision_msgs/msg/Detection3DArray' \
  '/plan nav_msgs/msg/Path' '/trajectory trajectory_msgs/msg/MultiDOFJointTrajectory' '/goal_pose geometry_msgs/msg/PoseStamped' \
  '/map_cloud sensor_msgs/msg/PointCloud2' '/tern/obstacles foxglove_msgs/msg/SceneUpdate' \
  '/tern/committed foxglove_msgs/msg/SceneUpdate' '/tern/regions foxglove_msgs/msg/SceneUpdate' \
  '/tern/hulls foxglove_msgs/msg/SceneUpdate' '/tern/planes foxglove_msgs/msg/SceneUpdate'; do
  grep -q "^$drawn [1-9]" "$work/topics" || { echo "no $drawn" && exit 1; }
done
