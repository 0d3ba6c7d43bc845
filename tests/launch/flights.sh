#!/usr/bin/env bash
# flights.sh NAME: whole flights through the real processes. Environment: TERN_BIN, where the programs are; TERN_NOISE, the program
# that mutates traffic.
set -euo pipefail
# shellcheck source=tests/launch/lib.sh
source "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/lib.sh"

# field FLIGHT KEY...: a value of the flight's summary.
field() {
  local name=$1
  shift
  python3 -c 'import json, sys
value = json.load(open(sys.argv[1]))
for key in sys.argv[2:]:
    value = value[key]
print("null" if value is None else value)' "$work/$name/summary.json" "$@"
}

# holds WHAT EXPRESSION: of numbers, by awk.
holds() { awk "BEGIN { exit !($2) }" || fail "$1: not $2"; }

# replays FLIGHT [LEAST]: every answer in its log, planned again, gives the same bytes; at least so many (30).
replays() {
  local result=0
  "$TERN_BIN/tern-replay" "$work/$1" --json "$work/$1.replay" || result=$?
  [[ $result == 0 ]] || fail "the replay's exit code is $result"
  python3 -c 'import json, sys
replay = json.load(open(sys.argv[1]))
assert replay["answers"] == replay["identical"] and replay["answers"] >= int(sys.argv[2]), replay["answers"]' "$work/$1.replay" "${2:-30}" ||
    fail "not every answer is the same"
}

# reached FLIGHT: it ended by itself, well, and left nobody.
reached() {
  local result=0
  wait "$flight" || result=$?
  cat "$work/$1.out"
  [[ $result == 0 && $(field "$1" outcome) == reached ]] || fail "exit code $result, $(field "$1" outcome)"
  holds "clearance" "$(field "$1" min_clearance_m) >= 0"
  holds "limits" "$(field "$1" limit_violations) == 0"
  nobody_left || fail "left: $(pgrep -af "$work/")"
  replays "$1"
}

# core_ticks: of this machine's cores since its start, how many ticks a hypervisor kept for others, and how many there were.
core_ticks() { awk '$1 == "cpu" { print $9, $2 + $3 + $4 + $5 + $6 + $7 + $8 + $9 }' /proc/stat; }

# had_its_cores SINCE: whether this machine has had at least 99 % of its cores since SINCE (core_ticks). On one that had less, what
# must be there in time tells of the machine's host and not of Tern: it is not asked, and that is said.
had_its_cores() {
  local now taken ticks
  now=$(core_ticks)
  taken=$((${now% *} - ${1% *}))
  ticks=$((${now#* } - ${1#* }))
  ((100 * taken <= ticks)) && return
  echo "not asked: whether all came in time; the host took $taken of $ticks ticks"
  return 1
}

# answers_in_time FLIGHT SHARE: of its requests.
answers_in_time() { holds "in time" "$(field "$1" answered_in_time) >= $2 * $(field "$1" requests)"; }

# nobody_died FLIGHT: no process did, but for a planner that got no core for half a second, and ended itself, and said why.
nobody_died() {
  local by_itself
  by_itself=$(grep -c "has missed two deadlines" "$work/$1/tern-planner.log" || true)
  if grep -h "tern-launch: .* ended with .*; restart" "$work/$1"/tern-*.log | grep -v "tern-planner ended with exit code 70"; then
    fail "a process died"
  fi
  holds "restarts" "$(field "$1" restarts) <= $by_itself"
}

# A process of this test's flights.
process_of() { pgrep -x -f "[^ ]*/$1 --config $work/.*" | head -n 1; }

# says FLIGHT TEXT: the monitor's newest line has it.
says() { tail -n 1 "$work/$1.out" | grep -q -- "$2"; }
flies() { grep -qE ' [1-9]\.[0-9]+ m/s' "$work/$1.out"; }

runs() { [[ -n $(process_of "$1") ]]; }
is_larger() { (($(stat -c %s "$1") > $2)); }

# keep_down PROCESS: kills it and holds the flight's supervisor, so that it stays away until bring_back.
keep_down() {
  supervisor=$(pgrep -P "$flight" -x tern-launch)
  kill -STOP "$supervisor"
  kill -KILL "$(process_of "$1")"
}
bring_back() { kill -CONT "$supervisor"; }

a_flight_reaches_its_goal() {
  local begin
  begin=$(core_ticks)
  start_flight flight
  reached flight
  [[ $(field flight restarts) == 0 ]] || fail "restarts"
  ! had_its_cores "$begin" || answers_in_time flight 1
  [[ $(field flight scenario) == corridor_demo && $(field flight count) == 100 && $(field flight seed) == 1 ]] || fail "names"
  [[ -s $(field flight log) ]] || fail "no log at $(field flight log)"
}

a_killed_planner_comes_back_and_the_vehicle_flies_on() {
  scenario=$root/tests/launch/pillars.yaml
  start_flight flight
  eventually "flies" 30 flies flight
  keep_down tern-planner
  eventually "rests" 15 says flight " 0.00 m/s"
  bring_back
  reached flight
  holds "restarts" "$(field flight restarts) == 1"
  holds "stops" "$(field flight stops) >= 1"
}

a_killed_executor_rests_where_it_was_committed_to_and_flies_on() {
  scenario=$root/tests/launch/pillars.yaml
  start_flight flight
  eventually "flies" 30 flies flight
  keep_down tern-executor
  eventually "rests" 15 says flight " 0.00 m/s"
  bring_back
  reached flight
  holds "restarts" "$(field flight restarts) == 1"
  holds "stops" "$(field flight stops) >= 1"
  holds "limits" "$(field flight limit_violations) == 0"
}

without_predictions_nobody_flies_blind() {
  scenario=$root/tests/launch/pillars.yaml
  start_flight flight
  eventually "flies" 30 flies flight
  keep_down tern-predictor
  eventually "rests" 15 says flight " 0.00 m/s"
  says flight "stale world" || fail "the planner does not say so: $(tail -n 1 "$work/flight.out")"
  bring_back
  reached flight
  holds "restarts" "$(field flight restarts) == 1"
}

noise_on_the_network_passes_and_the_flight_goes_on() {
  local result=0
  scenario=$root/tests/launch/passers.yaml
  start_flight flight
  eventually "flies" 30 flies flight
  (
    # shellcheck source=/dev/null  # written by the flight
    source "$work/flight/env.sh"
    "$TERN_NOISE" 1 1000 3
  )
  wait "$flight" || result=$?
  cat "$work/flight.out"
  [[ $result == 0 && $(field flight outcome) == reached ]] || fail "exit code $result, $(field flight outcome)"
  holds "clearance" "$(field flight min_clearance_m) >= 0"
  nobody_died flight
}

a_killed_mapper_does_not_end_a_flight() {
  start_flight flight
  eventually "flies" 30 flies flight
  kill -KILL "$(process_of tern-mapper)"
  reached flight
  holds "restarts" "$(field flight restarts) == 1"
}

a_planner_that_joins_late_has_the_map() {
  mkdir "$work/bin"
  ln -s "$TERN_BIN"/tern-* "$work/bin"
  rm "$work/bin/tern-planner"
  mkfifo "$work/go"
  printf '#!/bin/sh\nread -r _ <"%s"\nexec "%s" "$@"\n' "$work/go" "$TERN_BIN/tern-planner" >"$work/bin/tern-planner"
  chmod +x "$work/bin/tern-planner"
  TERN_BIN=$work/bin start_flight flight
  eventually "all others wait" 15 says flight "tern-planner (no HEARTBEAT)"
  echo >"$work/go"
  reached flight
}

two_flights_at_once_reach_their_goals() {
  local flight_one
  start_flight one
  flight_one=$flight
  start_flight two --seed 2
  local result=0
  wait "$flight_one" || result=$?
  [[ $result == 0 && $(field one outcome) == reached ]] || fail "one: $(cat "$work/one.out")"
  reached two
}

three_hundred_tracks_arrive_complete() {
  local begin
  begin=$(core_ticks)
  start_flight flight --count 300 --set simulator.min_flight_s=60 --set timeout_s=120
  wait "$flight" || true # what counts here are the messages, not the flight
  cat "$work/flight.out"
  ! had_its_cores "$begin" || holds "sets" "$(field flight messages PREDICTIONS received) > 60 * 20 * 4"
  holds "sets" "$(field flight messages PREDICTIONS received) > 100"
  holds "lost" "$(field flight messages PREDICTIONS lost) == 0 && $(field flight messages PREDICTIONS rejected) == 0"
}

# Sets `busy` to processes that never rest, one for each core.
keep_cores_busy() {
  local core
  busy=()
  for ((core = 0; core < $(nproc); core++)); do
    (while :; do :; done) &
    busy+=($!)
  done
}

busy_cores_leave_the_answers_in_time() {
  local busy begin result=0
  begin=$(core_ticks)
  keep_cores_busy
  start_flight flight
  wait "$flight" || result=$?
  kill "${busy[@]}"
  cat "$work/flight.out"
  if had_its_cores "$begin"; then
    holds "requests" "$(field flight requests) > 100"
    answers_in_time flight 0.999
  fi
  has_text "answered twice 0" "$work/flight/tern-executor.log" || fail "answered twice"
  replays flight
}

every_answer_replays_whoever_died_and_however_busy_the_cores_were() {
  local busy process size
  scenario=$root/tests/launch/passers.yaml
  keep_cores_busy
  start_flight flight
  eventually "flies" 30 flies flight
  for process in tern-planner tern-predictor tern-mapper tern-planner; do
    size=$(stat -c %s "$work/flight/flight.lcm")
    eventually "$process runs" 15 runs "$process"
    kill -KILL "$(process_of "$process")"
    eventually "a second of flight is recorded" 15 is_larger "$work/flight/flight.lcm" $((size + 150000))
  done
  reached flight
  kill "${busy[@]}"
  holds "restarts" "$(field flight restarts) == 4"
}

# All processes start at once: what replay needs is in the log all the same.
twenty_short_flights_beside_busy_cores_replay_whole() {
  local busy k result
  scenario=$root/scenarios/window.yaml
  keep_cores_busy
  for ((k = 1; k <= 20; k++)); do
    start_flight "flight$k" --set "uav.goal=[3, 0, 1]"
    result=0
    wait "$flight" || result=$?
    [[ $result == 0 ]] || fail "flight $k: exit code $result: $(tail -n 40 "$work/flight$k.out")"
    replays "flight$k" 10
    rm -r "$work/flight$k"
  done
  kill "${busy[@]}"
}

# flood PORT CHANNEL: ten seconds of packets that crash the channel's subscribers, in this test's own namespace; sets `stream`.
flood() {
  python3 "$root/tests/launch/fragment_flood.py" 10 5 "$1" "$2" &
  stream=$!
  flights+=("$stream")
}

a_stream_of_packets_that_crash_lcm_ends_a_flight_truthfully() {
  local stream port result=0
  start_flight flight
  eventually "flies" 30 flies flight
  port=$(grep -oE ':[0-9]+' "$work/flight/env.sh" | tail -n 1)
  flood "${port#:}" HEARTBEAT
  wait "$flight" || result=$?
  wait "$stream" || fail "no stream"
  cat "$work/flight.out"
  [[ $result == 3 ]] || fail "exit code $result"
  [[ $(field flight outcome) == failed ]] || fail "outcome $(field flight outcome)"
  nobody_left || fail "left: $(pgrep -af "$work/")"
}

a_stream_of_packets_that_crash_predictor_and_logger_costs_progress_only() {
  local stream port
  scenario=$root/tests/launch/pillars.yaml
  start_flight flight --set timeout_s=60
  port=$(grep -oE ':[0-9]+' "$work/flight/env.sh" | tail -n 1)
  flood "${port#:}" DECLARED_MOTIONS
  local result=0
  wait "$flight" || result=$?
  wait "$stream" || fail "no stream"
  cat "$work/flight.out"
  [[ $result == 0 && $(field flight outcome) == reached ]] || fail "exit code $result, $(field flight outcome)"
  expect "the predictor died" has_text "tern-predictor ended with signal SEGV; restart 3" "$work/flight/tern-predictor.log"
  expect "the logger died" has_text "tern-logger ended with signal SEGV; restart 3" "$work/flight/tern-logger.log"
  nobody_left || fail "left: $(pgrep -af "$work/")"
}

after_a_stream_of_packets_that_crash_lcm_the_processes_fly() {
  local stream process started=() scenario=$root/tests/launch/pillars.yaml
  cp "$scenario" "$work/scenario.yaml"
  flood 7667 HEARTBEAT # which every process hears
  for process in tern-simulator tern-executor tern-planner tern-predictor tern-mapper tern-logger; do
    local options=(--config "$work/scenario.yaml")
    [[ $process != tern-logger ]] || options+=(--record "$work/flight.lcm")
    "$scripts/keep_alive.sh" --log "$work/$process.log" -- "$TERN_BIN/$process" "${options[@]}" &
    started+=($!)
  done
  wait "$stream" || fail "no stream"
  for process in tern-simulator tern-executor tern-planner tern-predictor tern-mapper tern-logger; do
    expect "$process died and was started again" has_text "$process ended with signal SEGV; restart 3" "$work/$process.log"
  done
  "$TERN_BIN/tern-monitor" --config "$work/scenario.yaml" --summary "$work/summary.json" || fail "the monitor's exit code is $?"
  grep -h "ended with" "$work"/tern-*.log | sed 's/; restart.*//' | sort | uniq -c
  kill -TERM "${started[@]}"
  wait
  nobody_left || fail "left: $(pgrep -af "$work/")"
}

# An autopilot's flight is short: its take-off and landing are what takes time.
autopilots=(--autopilot sim --count 10 --goal "12,-1,1")

# landed FLIGHT: the bridge has seen the autopilot disarm on the ground, and the autopilot was asked for nothing since.
landed() {
  expect "it is disarmed on the ground" has_text "info: landed: " "$work/$1/tern-mavlink.log"
  nobody_left || fail "left: $(pgrep -af "$work/")"
}

an_autopilots_flight_reaches_its_goal_and_lands() {
  start_flight sim "${autopilots[@]}"
  local result=0
  wait "$flight" || result=$?
  cat "$work/sim.out"
  [[ $result == 0 && $(field sim outcome) == reached ]] || fail "exit code $result, $(field sim outcome)"
  landed sim
}

ctrl_c_in_an_autopilots_flight_lands_it() {
  start_flight sim "${autopilots[@]}"
  eventually "flies" 90 flies sim
  kill -INT -- "-$flight"
  local result=0
  wait "$flight" || result=$?
  [[ $result == 130 ]] || fail "exit code $result"
  landed sim
  expect "it waited for that" has_text "the autopilot has landed" "$work/sim/tern-mavlink.log"
}

run_test "$1"
