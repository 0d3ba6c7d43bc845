#!/usr/bin/env bash
# two_hosts.sh NAME: flights over two hosts, two network namespaces with a cable between them (a veth pair). Simulator,
# mapper, logger and monitor are on the vehicle, planner and predictor on the ground. Run by hermetic.sh, whose
# namespace is the vehicle. Environment: TERN_BIN, where the programs are.
set -euo pipefail
# shellcheck source=tests/launch/lib.sh
source "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/lib.sh"

# ttl=1: packets leave the host, and pass no router.
export LCM_DEFAULT_URL='udpm://239.255.76.67:7667?ttl=1'
wait_s=15
cable=(lay_cable)
readonly SETTINGS=(--config "$work/scenario.yaml" --set uav.goal='[20,0,1]')

# make_ground: another namespace. Sets `ground` to what runs a command there, `host` to a process that is there.
make_ground() {
  unshare --net tail -f /dev/null &  # holds the namespace
  host=$!
  flights+=("$host")
  ground=(nsenter --net --target "$host" --)
  eventually "a second namespace" another_network "$host"
}

# lay_cable: makes the ground, and a cable to it.
lay_cable() {
  local host
  make_ground
  {
    ip route del 224.0.0.0/4 dev lo &&
      ip link add cable type veth peer name cable netns "$host" &&
      ip address add 10.7.0.1/30 dev cable && ip link set cable up && ip route add 224.0.0.0/4 dev cable &&
      "${ground[@]}" ip link set lo up && "${ground[@]}" ip address add 10.7.0.2/30 dev cable &&
      "${ground[@]}" ip link set cable up && "${ground[@]}" ip route add 224.0.0.0/4 dev cable
  } || refused
}

# lay_slow_cable MS: the same with a delay of MS milliseconds each way, at the flight's pace.
lay_slow_cable() {
  local host delay_ms
  delay_ms=$(awk "BEGIN { print $1 / ${TERN_PACE:-1} }")
  make_ground
  { "${ground[@]}" ip link set lo up && "${ground[@]}" ip route add 224.0.0.0/4 dev lo; } || refused
  mkdir "$work/cable"
  start ground-end "${ground[@]}" python3 "$root/tests/launch/delay_cable.py" "$work/cable" ground vehicle "$delay_ms"
  start vehicle-end python3 "$root/tests/launch/delay_cable.py" "$work/cable" vehicle ground "$delay_ms"
  eventually "both ends" test -S "$work/cable/ground" -a -S "$work/cable/vehicle"
}
another_network() { [[ $(readlink "/proc/$1/ns/net") != "$(readlink /proc/self/ns/net)" ]]; }

# As hermetic.sh where no namespace can be had.
refused() {
  echo "two_hosts.sh: this host refuses a veth pair between network namespaces; not run" >&2
  exit 97
}

# start NAME COMMAND...: in the background, with $work/NAME.out; sets `pid`.
start() {
  local name=$1
  shift
  "$@" >"$work/$name.out" 2>&1 &
  pid=$!
  flights+=("$pid")
}

# start_system PLANNER_OPTION...: every process but the simulator, whose pid is then `flight`; the others' are `planner` and `monitor`.
start_system() {
  cp "$root/tests/launch/pillars.yaml" "$work/scenario.yaml"
  "${cable[@]}"
  start tern-planner "${ground[@]}" "$TERN_BIN/tern-planner" "${SETTINGS[@]}" "$@"
  planner=$pid
  start tern-predictor "${ground[@]}" "$TERN_BIN/tern-predictor" "${SETTINGS[@]}"
  start tern-mapper "$TERN_BIN/tern-mapper" "${SETTINGS[@]}"
  start tern-monitor "$TERN_BIN/tern-monitor" "${SETTINGS[@]}" --summary "$work/summary.json"
  monitor=$pid
  start tern-executor "$TERN_BIN/tern-executor" "${SETTINGS[@]}"
  start tern-simulator "$TERN_BIN/tern-simulator" "${SETTINGS[@]}" --set simulator.wait_s="$wait_s"
  flight=$pid
}

# ends NAME PID CODE: the process ends by itself with this exit code.
ends() {
  local result=0
  wait "$2" || result=$?
  [[ $result == "$3" ]] || fail "$1 ended with $result, not $3: $(tail -n 20 "$work"/*.out)"
}

a_flight_whose_clocks_are_a_little_apart_reaches_its_goal() {
  start_system --clock-offset-us 5000
  ends tern-simulator "$flight" 0
  ends tern-monitor "$monitor" 0
  cat "$work/tern-monitor.out"
  expect "reached" has_text '"outcome": "reached"' "$work/summary.json"
  grep 'clock differences' "$work/tern-simulator.out" || fail "nothing is said of clocks"
  expect "the skew is said" has_text 'clock differences from the vehicle:.*tern-planner +[45]\.[0-9] ms' "$work/tern-simulator.out"
}

a_network_that_takes_its_time_is_not_called_clock_skew() {
  cable=(lay_slow_cable 12)
  start_system
  ends tern-simulator "$flight" 0
  ends tern-monitor "$monitor" 0
  cat "$work/tern-monitor.out"
  expect "reached" has_text '"outcome": "reached"' "$work/summary.json"
  grep 'clock differences' "$work/tern-simulator.out" || fail "nothing is said of clocks"
  expect "the delay is said" has_text 'tern-planner [+-][0-9.]* ms (round trip [0-9]*[2-9][0-9]\.[0-9] ms)' "$work/tern-simulator.out"
}

# refuses OFFSET_US SKEW DIRECTION: the flight does not begin, and all report why. The first report may be of a slow exchange;
# SKEW is the value in the flight's result.
refuses() {
  local end="ms $3 the vehicle's, more than 10 ms and half a round trip of [0-9.]* ms: synchronize the hosts' clocks)"
  wait_s=5
  start_system --clock-offset-us "$1"
  ends tern-simulator "$flight" 3
  ends tern-monitor "$monitor" 3
  cat "$work/tern-monitor.out"
  expect "the vehicle says so" has_text "error: tern-planner (its clock is [0-9.]* $end" "$work/tern-simulator.out"
  expect "the verdict says so" has_text "not ready after $wait_s s: tern-planner (its clock is $2 $end" "$work/tern-simulator.out"
  expect "the monitor says so" has_text "tern-planner (its clock is $2 $end" "$work/tern-monitor.out"
}

a_clock_that_is_far_ahead_is_refused_by_name() { refuses 100000 '\(9[5-9]\|10[0-4]\)\.[0-9]' 'ahead of'; }

a_clock_that_is_far_behind_is_refused_by_name() { refuses -100000 '\(9[5-9]\|10[0-4]\)\.[0-9]' behind; }

says() { tail -n 1 "$work/tern-monitor.out" | grep -q -- "$1"; }

a_clock_that_goes_wrong_in_flight_is_said_and_the_vehicle_rests() {
  local skew="tern-planner (its clock is [0-9.]* ms ahead of the vehicle's"
  start_system
  eventually "flies" says ' [1-9]\.[0-9]* m/s'
  kill -KILL "$planner"
  start tern-planner-anew "${ground[@]}" "$TERN_BIN/tern-planner" "${SETTINGS[@]}" --clock-offset-us 100000
  eventually "the vehicle says so" has_text "error: $skew" "$work/tern-simulator.out"
  eventually "the monitor says so, and rests" says " 0.00 m/s.*waiting for tern-simulator: $skew"
  cat "$work/tern-monitor.out"
}

run_test "$1"
