#!/usr/bin/env bash
# results.sh [OPTION...] [NAME...]: flies the campaigns of docs/results.md, or those named. It can be stopped and started again:
# flights that exist are skipped.
#     --share S     share of the seeds; 1, the default, is all 6000 flights. That is 1000 of each of three hard worlds and of the
#                   quadrotor's corridor, and 200 of each other one. The quadrotor's flights are audited.
#     --first K     first seed (default 1)
#     --out DIR     folder for the results
#     --perception  instead the worlds without declared motions, 200 flights each, and the same with all motions declared
#     --cameras     instead the worlds by simulated cameras and lidars, 200 flights each, and ablations of sensors and headings
#     --sensors     instead perception_only with other ranges, noise, latencies and obstacle speeds, one at a time
set -euo pipefail
# shellcheck source=launch_scripts/lib.sh
source "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/lib.sh"

bin=${TERN_BIN#"$TERN_ROOT/"} # a summary holds the command: no path of this machine

# name, scenario, obstacles, seeds, further settings
campaigns="
paper_corridor_300 paper_corridor 300 1000
mader_own_limits_250 mader_corridor_own_limits 250 1000
sando_forest_200 sando_forest 200 1000
paper_corridor_50 paper_corridor 50 200
paper_corridor_100 paper_corridor 100 200
paper_corridor_200 paper_corridor 200 200
mader_corridor_50 mader_corridor 50 200
mader_corridor_150 mader_corridor 150 200
mader_corridor_250 mader_corridor 250 200
mader_own_limits_140 mader_corridor_own_limits 140 200
sando_forest_50 sando_forest 50 200
sando_forest_100 sando_forest 100 200
quadrotor_corridor_100 quadrotor_corridor 100 1000 --charge counts --audit $bin/tern-audit
quadrotor_forest_200 quadrotor_forest 200 200 --charge counts --audit $bin/tern-audit
"
perception=""
for world in perception_only,100 mader_perception_only,100 sando_perception,200 people_hermes_050,0 people_hermes_090,0 \
  people_hermes_120,0 people_eth,0 people_hotel,0 drones,0 crowd,0 crowd_eth,0; do
  seen="${world%,*} ${world#*,} 200 --charge counts"
  perception+="${world%,*} $seen"$'\n'"${world%,*}_oracle $seen --oracle"$'\n'
done
sensors="perception_only perception_only 100 200 --charge counts"$'\n'
for other in range_m=6 range_m=12 range_m=20 sigma_m=0 sigma_m=0.02 sigma_m=0.1 latency_s=0 latency_s=0.1 latency_s=0.2; do
  sensors+="${other/=/_} perception_only 100 200 --charge counts --set simulator.sensor.$other"$'\n'
done
for slowness in 1.1 2 3 4; do
  slow="perception_only 100 200 --charge counts --set world.slowness=$slowness"
  sensors+="slowness_$slowness $slow"$'\n'"slowness_${slowness}_oracle $slow --oracle"$'\n'
done
# Settings have no spaces: JSON, which is YAML.
camera='{"type":"camera"}' lidar='{"type":"lidar"}' set="200 --charge counts --set"
both="simulator.sensors=[$camera,$lidar]"
cameras=""
for count in 50 100 200; do
  cameras+="sando_camera_lidar_$count sando_camera_lidar $count 200 --charge counts"$'\n'
  cameras+="sando_camera_$count sando_camera $count 200 --charge counts"$'\n'
done
cameras+="
corridor_two_cameras corridor_two_cameras 100 200 --charge counts
corridor_camera_lidar corridor_two_cameras 100 $set $both --set uav.heading.view=85.2
mader_two_cameras mader_two_cameras 100 200 --charge counts
mader_camera_lidar mader_two_cameras 100 $set $both --set uav.heading.view=85.2
blind_corner_camera_lidar blind_corner 4 $set $both
blind_corner_passive blind_corner 4 $set $both --set planner.unseen=passive
sando_camera_along sando_camera 200 $set planner.heading=along
sando_camera_lidar_along sando_camera_lidar 200 $set planner.heading=along
sando_camera_front_rear sando_camera 200 $set simulator.sensors=[$camera,{\"type\":\"camera\",\"yaw_deg\":180}]
sando_camera_lidar_blocks sando_camera_lidar 200 $set simulator.sensors=[{\"type\":\"camera\",\"noise_block\":5},$lidar]
sando_camera_lidar_body sando_camera_lidar 200 $set simulator.sensors=[{\"type\":\"camera\",\"mount\":\"body\"},$lidar]
"
for world in people_hermes_050 people_hermes_090 people_hermes_120 people_eth people_hotel; do
  cameras+="${world}_camera_lidar $world 0 $set $both"$'\n'
done

share=1 first=1 out=$TERN_ROOT/build/results only=" " coverage=()
while (($#)); do
  case $1 in
    --share) share=${2:?} && shift 2 ;;
    --first) first=${2:?} && shift 2 ;;
    --out) out=$(realpath -m "${2:?}") && shift 2 ;;
    --perception) campaigns=$perception coverage=(--coverage "$bin/tern-audit") && shift ;;
    --cameras) campaigns=$cameras && shift ;;
    --sensors) campaigns=$sensors && shift ;;
    -h | --help) help_if_asked --help ;;
    -*) die "no option $1" ;;
    *) only+="$1 " && shift ;;
  esac
done

for name in $only; do grep -q "^$name " <<<"$campaigns" || die "no campaign $name"; done
build_programs tern-campaign tern-audit
mkdir -p "$out"
cd "$TERN_ROOT"
out=${out#"$TERN_ROOT/"}
while read -r name scenario count seeds settings; do
  [[ -n $name ]] || continue
  [[ $only == " " || $only == *" $name "* ]] || continue
  last=$(awk -v n="$seeds" -v s="$share" -v first="$first" 'BEGIN { k = int(n * s); print first + (k < 1 ? 1 : k) - 1 }')
  say "== $name: seeds $first to $last"
  # shellcheck disable=SC2086  # settings are words
  "$bin/tern-campaign" --world "scenarios/$scenario.yaml" --count "$count" --seeds "$first:$last" $settings \
    "${coverage[@]}" --out "$out/$name.csv" --summary "$out/$name.json"
done <<<"$campaigns"
if ((${#coverage[@]})); then
  "$TERN_ROOT/docs/results/perception.py" "$out"
  "$TERN_ROOT/docs/results/perception.py" --short "$out"
else
  "$TERN_ROOT/docs/results/table.py" "$out"/*.json
fi
