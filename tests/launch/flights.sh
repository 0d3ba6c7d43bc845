#!/usr/bin/env bash
# flights.sh NAME: whole flights through the real processes. Environment: TERN_BIN, where the programs are; TERN_NOISE, the program
# that mutates traffic.
set -euo pipefail
# shellcheck source=tests/launch/lib.sh
source "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/lib.sh"
# shellcheck source=tests/launch/flight_lib.sh
source "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/flight_lib.sh"

# nobody_died FLIGHT: no process died, except a planner that had no core for half a second, ended itself and logged it.
nobody_died() {
  local by_itself
  by_itself=$(grep -c "has missed two deadlines" "$work/$1/tern-planner.log" || true)
  if grep -h "tern-launch: .* ended with .*; restart" "$work/$1"/tern-*.log | grep -v "tern-planner ended with exit code 70"; then
    fail "a process died"
  fi
  holds "restarts" "$(field "$1" restarts) <= $by_itself"
}

# keep_down PROCESS: kills it and holds the flight's supervisor, so that it stays away until bring_back.
keep_down() {
  supervisor=$(pgrep -P "$flight" -x tern-launch)
  kill -STOP "$supervisor"
  kill -KILL "$(process_of "$1")"
}
bring_back() { kill -CONT "$supervisor"; }

# Many claims in one live flight: keys, forged messages, restarts, orphans, counters, audit, replay, report, export.
a_signed_flight_whose_processes_die_reaches_its_goal_and_is_told_whole() {
  local stranger process size result=0
  "$TERN_BIN/tern-key" new "$work/key"
  scenario=$root/tests/launch/passers.yaml # in whose way no vehicle comes to rest that has no planner
  start_flight flight --key "$work/key" --report
  eventually "flies" flies flight
  expect_keys_nowhere
  # Unsigned messages are refused.
  (
    # shellcheck source=/dev/null  # written by the flight
    source "$work/flight/env.sh"
    exec "$TERN_BIN/tern-predictor" --config "$scenario" --lcm-url "$LCM_DEFAULT_URL" >"$work/stranger.out" 2>&1
  ) &
  stranger=$!
  eventually "the planner says why" has_text 'PREDICTIONS: refused a message: unauthenticated' "$work/flight/tern-planner.log"
  kill -TERM "$stranger" || fail "tern-predictor ended by itself: $(cat "$work/stranger.out")"
  wait "$stranger" || fail "tern-predictor ended with $?: $(cat "$work/stranger.out")"
  for process in tern-planner tern-predictor tern-mapper; do
    size=$(stat -c %s "$work/flight/flight.lcm")
    eventually "$process runs" runs "$process"
    kill -KILL "$(process_of "$process")"
    eventually "a second of flight is recorded" is_larger "$work/flight/flight.lcm" $((size + 150000))
  done
  reached flight
  holds "restarts" "$(field flight restarts) == 3"
  holds "answers" "$(field flight answered_in_time) > 0 && $(field flight second_answers) == 0"
  holds "refused" "$(field flight messages PREDICTIONS rejected) > 0"
  [[ $(field flight scenario) == passers && $(field flight seed) == 1 && -s $(field flight log) ]] || fail "names"
  expect_log_as_counted flight
  expect "a report" test -s "$work/flight/report.html"
  is_without_keys "the record" "$work/flight"/* "$work/flight.out"
  expect "messages are signed" has_text 'TMAC' "$work/flight/flight.lcm"
  expect "the logger reads what it records" has_text 'PLAN .* refused    0' "$work/flight/tern-logger.log"
  "$TERN_BIN/tern-audit" "$work/flight" >"$work/audit" || true # its verdict is of the flight among kills
  expect "the audit reads plans" has_text 'held *certificates *[1-9][0-9]* plans' "$work/audit"
  ! grep BROKEN "$work/audit" | grep -vE '^BROKEN|BROKEN *answers' || fail "the audit: $(cat "$work/audit")"
  "$TERN_BIN/tern-export" "$work/flight/flight.lcm" --csv "$work/csv" || result=$?
  [[ $result == 0 ]] || fail "the export's exit code is $result"
  python_reads_signed_states "$work/flight/flight.lcm"
}

a_flight_reaches_its_goal() {
  start_flight flight
  reached flight
  [[ $(field flight restarts) == 0 ]] || fail "restarts"
  [[ $(field flight scenario) == corridor_demo && $(field flight count) == 100 && $(field flight seed) == 1 ]] || fail "names"
  [[ -s $(field flight log) ]] || fail "no log at $(field flight log)"
}

a_killed_planner_comes_back_and_the_vehicle_flies_on() {
  scenario=$root/tests/launch/pillars.yaml
  start_flight flight
  eventually "flies" flies flight
  keep_down tern-planner
  eventually "rests" says flight " 0.00 m/s"
  bring_back
  reached flight
  holds "restarts" "$(field flight restarts) == 1"
  holds "stops" "$(field flight stops) >= 1"
}

a_killed_executor_rests_where_it_was_committed_to_and_flies_on() {
  scenario=$root/tests/launch/pillars.yaml
  start_flight flight
  eventually "flies" flies flight
  keep_down tern-executor
  eventually "rests" says flight " 0.00 m/s"
  bring_back
  reached flight
  holds "restarts" "$(field flight restarts) == 1"
  holds "stops" "$(field flight stops) >= 1"
  holds "limits" "$(field flight limit_violations) == 0"
}

without_predictions_nobody_flies_blind() {
  scenario=$root/tests/launch/pillars.yaml
  start_flight flight
  eventually "flies" flies flight
  keep_down tern-predictor
  eventually "rests" says flight " 0.00 m/s"
  says flight "stale world" || fail "the planner does not say so: $(tail -n 1 "$work/flight.out")"
  bring_back
  reached flight
  holds "restarts" "$(field flight restarts) == 1"
}

noise_on_the_network_passes_and_the_flight_goes_on() {
  local result=0
  scenario=$root/tests/launch/passers.yaml
  start_flight flight
  eventually "flies" flies flight
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
  eventually "flies" flies flight
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
  eventually "all others wait" says flight "tern-planner (no HEARTBEAT)"
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

# A minute in soak runs (TERN_EFFORT). How many sets there are in a second: tests/system/many_tracks_test.cpp.
three_hundred_tracks_arrive_complete() {
  local seconds=$((${TERN_EFFORT:-1} < 10 ? 8 : 60))
  start_flight flight --count 300 --set simulator.min_flight_s="$seconds" --set timeout_s=$((2 * seconds))
  wait "$flight" || true # what counts here are the messages, not the flight
  cat "$work/flight.out"
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

# How many are in time: benchmarks/answers_in_time.sh.
beside_busy_cores_no_request_is_answered_twice_and_every_answer_replays() {
  local busy result=0
  keep_cores_busy
  start_flight flight
  wait "$flight" || result=$?
  kill "${busy[@]}"
  cat "$work/flight.out"
  holds "requests" "$(field flight requests) > 100"
  has_text "answered twice 0" "$work/flight/tern-executor.log" || fail "answered twice"
  replays flight
}

every_answer_replays_whoever_died_and_however_busy_the_cores_were() {
  local busy process size
  scenario=$root/tests/launch/passers.yaml
  keep_cores_busy
  start_flight flight
  eventually "flies" flies flight
  for process in tern-planner tern-predictor tern-mapper tern-planner; do
    size=$(stat -c %s "$work/flight/flight.lcm")
    eventually "$process runs" runs "$process"
    kill -KILL "$(process_of "$process")"
    eventually "a second of flight is recorded" is_larger "$work/flight/flight.lcm" $((size + 150000))
  done
  reached flight
  kill "${busy[@]}"
  holds "restarts" "$(field flight restarts) == 4"
}

# All processes start at the same time, and the log still holds everything that a replay needs. Twenty flights in soak runs
# (TERN_EFFORT).
short_flights_beside_busy_cores_replay_whole() {
  local busy k result count=$((${TERN_EFFORT:-1} < 10 ? 2 : 20))
  scenario=$root/scenarios/window.yaml
  keep_cores_busy
  for ((k = 1; k <= count; k++)); do
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
  eventually "flies" flies flight
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
  local result=0 told=0
  wait "$flight" || result=$?
  wait "$stream" || fail "no stream"
  cat "$work/flight.out"
  [[ $(field flight recording) == complete ]] || told=5 # the logger died after the first request
  [[ $result == "$told" && $(field flight outcome) == reached ]] || fail "exit code $result, $(field flight outcome)"
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

# The file system of the record fills up in flight: a tmpfs of 1 MB, in mounts of this test's own.
a_flight_whose_file_system_fills_up_is_told_as_incomplete() {
  if [[ -z ${TERN_OWN_MOUNTS:-} ]]; then
    TERN_OWN_MOUNTS=yes unshare -m bash "$root/tests/launch/flights.sh" "${FUNCNAME[0]}"
    return
  fi
  local flown=0 audited=0
  mkdir "$work/small"
  mount -t tmpfs -o size=1m tmpfs "$work/small"
  start_flight small/flight --count 10 --goal "20,-1,1"
  wait "$flight" || flown=$?
  cat "$work/small/flight.out"
  "$TERN_BIN/tern-audit" "$work/small/flight" >"$work/audit" || audited=$?
  cat "$work/audit"
  # Whether the summary's file still had room depends on the last message that the log took; so the page is read.
  [[ $flown == 5 ]] || fail "exit code $flown"
  expect "it reached its goal" has_text '^reached$' "$work/small/flight.out"
  expect "the page says so" has_text '^ *recording *incomplete: .* messages are not in the log' "$work/small/flight.out"
  expect "and why" has_text 'No space left on device' "$work/small/flight.out"
  [[ $audited == 3 ]] || fail "the audit's exit code is $audited"
  # It names the flight's length as well if the summary had room.
  expect "the audit says from when to when" has_text '^INCOMPLETE: .* it reaches from .* to .* s' "$work/audit"
  nobody_left || fail "left: $(pgrep -af "$work/")"
  umount "$work/small"
}

# An autopilot's flight is short, because take-off and landing take most of the time.
autopilots=(--autopilot sim --count 10 --goal "12,-1,1")

# landed FLIGHT: the bridge saw the autopilot disarm on the ground and sent it no command afterwards.
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
  has_the_speeds_of_its_states sim
  landed sim
}

ctrl_c_in_an_autopilots_flight_lands_it() {
  start_flight sim "${autopilots[@]}"
  eventually "flies" flies sim
  kill -INT -- "-$flight"
  local result=0
  wait "$flight" || result=$?
  [[ $result == 130 ]] || fail "exit code $result"
  landed sim
  expect "it waited for that" has_text "the autopilot has landed" "$work/sim/tern-mavlink.log"
}

run_test "$1"
