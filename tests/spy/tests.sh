#!/usr/bin/env bash
# tests.sh NAME: lcm-spy as spy.sh starts it, on a display without a screen. Environment: TERN_BIN, where the programs are;
# TERN_SPY_PICTURE: where the picture of its window is left (default: nowhere).
set -euo pipefail
# shellcheck source=tests/launch/lib.sh
source "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/../launch/lib.sh"

export TERN_TYPES_JAR=$work/types.jar
readonly JARS=/usr/share/java/lcm.jar:/usr/share/java/jchart2d.jar

# Sets DISPLAY to one of this test's own.
open_display() {
  mkfifo "$work/display"
  Xvfb -displayfd 3 -screen 0 1280x800x24 -nolisten tcp 3>"$work/display" >"$work/xvfb.out" 2>&1 &
  flights+=("$!")
  read -rt 30 number <"$work/display" || fail "no display: $(cat "$work/xvfb.out")"
  export DISPLAY=:$number
}

# start_spied_flight OPTION...: sets `flight`, and `spy` that watches it.
start_spied_flight() {
  open_display
  mkdir "$work/classes"
  javac -classpath "$JARS" -d "$work/classes" "$root"/tests/spy/*.java
  expect "the jar is built" test "$("$scripts/spy.sh" --no-install --types)" = "$TERN_TYPES_JAR"
  scenario=$root/tests/launch/pillars.yaml
  start_flight flight --goal 12,0,1 "$@"
  "$scripts/spy.sh" --no-install "$work/flight" >"$work/spy.out" 2>&1 &
  spy=$!
  flights+=("$spy")
}

# expect_end CODE: the flight ends with it, and lcm-spy stays up.
expect_end() {
  local result=0
  wait "$flight" || result=$?
  [[ $result == "$1" ]] || fail "the flight ended with exit code $result: $(cat "$work/flight.out")"
  ! is_gone "$spy" || fail "lcm-spy ended: $(cat "$work/spy.out")"
  kill -TERM "$spy"
}

lcm_spy_shows_every_channel() {
  local rows=16 # 15 channels and the table's head
  start_spied_flight --set simulator.min_flight_s=600 # until the picture is taken
  timeout 180 java -classpath "$work/classes" PhotographScreen "$work/spy.png" "$rows" ||
    fail "no $rows rows; lcm-spy: $(cat "$work/spy.out") flight: $(tail -n 5 "$work/flight.out")"
  kill -INT -- "-$flight"
  expect_end 130
  [[ -z ${TERN_SPY_PICTURE:-} ]] || cp "$work/spy.png" "$TERN_SPY_PICTURE"
}

lcm_spy_stays_up_and_every_message_of_a_flight_decodes() {
  local types
  start_spied_flight --set simulator.min_flight_s=6
  expect_end 0
  types=$(cd "$root/lcmtypes" && printf '%s ' *.lcm)
  # shellcheck disable=SC2086  # one word per type
  java -classpath "$TERN_TYPES_JAR:$JARS:$work/classes" ResolveTypes "$work/flight/flight.lcm" ${types//.lcm/} >"$work/decoded"
  cat "$work/decoded"
  for type in uav_state observation_set track_set map_chunk goal horizon_request plan plan_timing heartbeat configuration \
    obstacle_truth flight_result; do
    expect "some ${type}_t decode" has_text " ${type}_t [1-9]" "$work/decoded"
  done
}

what_is_missing_is_said() {
  [[ $(code env -u DISPLAY "$scripts/spy.sh" --no-install) == 3 ]] || fail "exit code without a display"
  expect "it says so" has_text "DISPLAY is not set" "$work/out"
  [[ $(code "$scripts/spy.sh" --no-install "$work") == 3 ]] || fail "exit code without a flight"
  expect "it says so" has_text "is not the folder of a flight" "$work/out"
  [[ $(code "$scripts/spy.sh" --isolated) == 3 ]] || fail "exit code of an unknown option"
}

run_test "$1"
