#!/usr/bin/env bash
# sensor_map.sh --out FOLDER [--seeds N] [--jobs K]: which sensor does a world of fast movers need? The success of
# perception_only against range, noise and latency of its sensor and the movers' slowness, one at a time, the oracle beside each.
# Campaigns, a table map.csv and, where matplotlib is, map.svg are in FOLDER; an ended run goes on where it was.
set -euo pipefail
# shellcheck source=launch_scripts/lib.sh
source "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/lib.sh"

seeds=40 jobs=$(nproc) out=
while (($#)); do
  case $1 in
    --out) out=${2:?} && shift 2 ;;
    --seeds) seeds=${2:?} && shift 2 ;;
    --jobs) jobs=${2:?} && shift 2 ;;
    -h | --help) sed -n '2,4s/^# //p' "$0" && exit ;;
    *) die "no option $1" ;;
  esac
done
[[ -n $out ]] || die "--out FOLDER is required"
build_programs
mkdir -p "$out"

# fly AXIS VALUE KIND OPTION...: a campaign, and its line of the table.
fly() {
  local axis=$1 value=$2 kind=$3 name=$out/$1_$2_$3
  shift 3
  "$TERN_BIN/tern-campaign" --world "$TERN_ROOT/scenarios/perception_only.yaml" --seeds "1:$seeds" --jobs "$jobs" --out "$name.csv" --summary "$name.json" "$@" >&2
  python3 - "$axis" "$value" "$kind" "$name.json" <<'EOF'
import json, sys
s = json.load(open(sys.argv[4]))
low, high = s["success_ci95"] or ("", "")
print(",".join(map(str, [*sys.argv[1:4], s["flights"], s["success"], low, high, s["contacts_moving"], s["contacts_at_rest"]])))
EOF
}

# axis UNIT_NAME KEY VALUE...
axis() {
  local name=$1 key=$2
  shift 2
  for value in "$@"; do
    fly "$name" "$value" perception --set "$key=$value"
    if [[ $key == world.* ]]; then fly "$name" "$value" oracle --set "$key=$value" --oracle; fi
  done
  # What the sensor does changes nothing where motions are declared: one campaign for all its axes.
  if [[ $key != world.* ]]; then
    for value in "$1" "${@: -1}"; do fly_oracle "$name" "$value"; done
  fi
}

fly_oracle() { fly all 0 oracle --oracle | sed "s/^all,0,/$1,$2,/"; }

{
  echo axis,value,kind,flights,success,low,high,contacts_moving,contacts_at_rest
  axis range_m simulator.sensor.range_m 6 8 10 14 20
  axis sigma_m simulator.sensor.sigma_m 0 0.02 0.05 0.1
  axis latency_s simulator.sensor.latency_s 0 0.05 0.1 0.2
  axis slowness world.slowness 1.1 1.6 2.4 4
} >"$out/map.csv.new"
mv "$out/map.csv.new" "$out/map.csv"
echo "$out/map.csv"
if python3 -c 'import matplotlib' 2>/dev/null; then "$TERN_ROOT/docs/results/figures.py" map "$out/map.csv" "$out/map.svg"; fi
