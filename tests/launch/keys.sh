#!/usr/bin/env bash
# keys.sh NAME: flights whose messages are signed. Environment: TERN_BIN, where the programs are.
set -euo pipefail
# shellcheck source=tests/launch/lib.sh
source "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/lib.sh"
# shellcheck source=tests/launch/flight_lib.sh
source "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/flight_lib.sh"

# has_ended FLIGHT: it ended by itself with success and left no process behind.
has_ended() {
  local result=0
  wait "$flight" || result=$?
  cat "$work/$1.out"
  [[ $result == 0 ]] || fail "exit code $result"
  nobody_left || fail "left: $(pgrep -af "$work/")"
}

# summary FLIGHT EXPRESSION: of its summary, a dictionary s.
summary() { python3 -c 'import json, sys
s = json.load(open(sys.argv[1]))
print(eval(sys.argv[2]))' "$work/$1/summary.json" "$2"; }

a_signed_flight_reaches_its_goal_and_its_key_is_nowhere() {
  "$TERN_BIN/tern-key" new "$work/key"
  scenario=$root/tests/launch/passers.yaml # in whose way no vehicle comes to rest that has no planner
  start_flight flight --key "$work/key" --report
  eventually "flies" flies flight
  expect_keys_nowhere
  kill -KILL "$(process_of tern-planner)"
  has_ended flight
  [[ $(summary flight 's["restarts"]') == 1 ]] || fail "the planner did not come back with its keys"
  # Messages of the new planner are refused while the dead one is still the accepted sender.
  ! grep -h 'refused a message: unauthenticated' "$work"/flight/tern-*.log || fail "a true tag was refused"
  expect "the logger reads what it records" has_text 'PLAN .* refused    0' "$work/flight/tern-logger.log"
  is_without_keys "the record" "$work/flight"/* "$work/flight.out"
  expect "messages are signed" has_text 'TMAC' "$work/flight/flight.lcm"
  "$TERN_BIN/tern-audit" "$work/flight/flight.lcm" >"$work/audit" || true # its verdict is of the flight, not of the keys
  expect "the audit reads plans" has_text 'held *certificates *[1-9][0-9]* plans' "$work/audit"
  "$TERN_BIN/tern-replay" "$work/flight" || fail "the replay's exit code is $?"
  "$TERN_BIN/tern-export" "$work/flight/flight.lcm" --csv "$work/csv" || fail "the export's exit code is $?"
  python_reads_signed_states "$work/flight/flight.lcm"
}

who_has_not_the_key_is_not_heard_and_harms_nobody() {
  scenario=$root/tests/launch/passers.yaml
  start_flight flight --key --set simulator.min_flight_s=20
  eventually "flies" flies flight
  local url heard stranger result name seconds
  seconds=$(awk "BEGIN { print 0.7 / ${TERN_PACE:-1} }")
  url=$(env -i bash -c "source $work/flight/env.sh && echo \$LCM_DEFAULT_URL")
  "$TERN_BIN/tern-predictor" --config "$scenario" --lcm-url "$url" >"$work/stranger.out" 2>&1 &
  heard=$!
  eventually "the planner says why" has_text 'PREDICTIONS: refused a message: unauthenticated' "$work/flight/tern-planner.log"
  kill -TERM "$heard" || fail "tern-predictor ended by itself: $(cat "$work/stranger.out")"
  wait "$heard" || fail "tern-predictor ended with $?: $(cat "$work/stranger.out")"
  "$TERN_BIN/tern-key" new "$work/another.key"
  for stranger in '' "--key-file $work/another.key"; do
    for name in tern-predictor tern-planner tern-mapper tern-executor tern-simulator; do
      result=0
      # shellcheck disable=SC2086  # an option and its value, or none
      timeout "$seconds" "$TERN_BIN/$name" --config "$scenario" --lcm-url "$url" $stranger \
        >>"$work/strangers.out" 2>&1 || result=$?
      [[ $result == 124 ]] || fail "$name ended with $result: $(cat "$work/strangers.out")"
    done
  done
  has_ended flight
  [[ $(summary flight 's["restarts"], s["outcome"]') == "(0, 'reached')" ]] || fail "$(cat "$work/flight/summary.json")"
  [[ $(summary flight 's["messages"]["PREDICTIONS"]["rejected"] > 0') == True ]] || fail "nothing was refused"
}

a_signed_flight_in_a_namespace_of_its_own_flies() {
  start_flight flight --isolated --key
  eventually "flies" flies flight
  [[ $(key_holders) == ' 1 tern-launch ' ]] || fail "open keys: $(key_holders)"
  expect "a command runs in its network" "$scripts/enter.sh" "$work/flight" -- true
  end_flight "$flight"
  nobody_left || fail "left: $(pgrep -af "$work/")"
  expect "signed" has_text TMAC "$work/flight/flight.lcm"
  ! grep -h 'unauthenticated' "$work/flight"/tern-*.log || fail "refused"
}

a_program_in_python_signs_what_it_says() {
  export TERN_PACE=0.5 # which the program keeps, too
  "$TERN_BIN/tern-key" new "$work/key"
  "$TERN_BIN/tern-predictor" --key-file "$work/key" --config "$scenario" >"$work/predictor.out" 2>&1 &
  "$TERN_BIN/tern-logger" --key-file "$work/key" --config "$scenario" --record "$work/python.lcm" >"$work/logger.out" 2>&1 &
  eventually "the predictor runs" has_text 'signs and verifies' "$work/predictor.out"
  export PYTHONPATH=$TERN_BIN/../python
  python3 "$root/docs/examples/own_detector.py" "$work/key" >"$work/detector.out" 2>&1 &
  eventually "observations are taken" hears_observations
  ! has_text refused "$work/predictor.out" || fail "$(cat "$work/predictor.out")"
  python3 "$root/docs/examples/own_detector.py" >"$work/detector2.out" 2>&1 &
  eventually "unsigned ones are not" has_text 'OBSTACLE_OBSERVATIONS: refused a message: unauthenticated' "$work/predictor.out"
  # The log holds both, until it is sifted.
  eventually "unsigned ones stay behind" leaves_some
  "$TERN_BIN/tern-key" sift "$work/key" "$work/sifted.lcm" "$work/again.lcm" >"$work/again.out"
  expect "the others all verify" grep -qE '^([0-9]+) of \1 messages verify' "$work/again.out"
  expect "signed ones are there" grep -aq OBSTACLE_OBSERVATIONS "$work/sifted.lcm"
  [[ $(code "$TERN_BIN/tern-key" sift "$work/key" "$work/python.lcm" "$work/sifted.lcm") == 2 ]] || fail "overwritten"
}

# Sifts the log, to which tern-logger adds now and then; whether an unsigned detection stays behind.
leaves_some() {
  rm -f "$work/sifted.lcm"
  "$TERN_BIN/tern-key" sift "$work/key" "$work/python.lcm" "$work/sifted.lcm" >"$work/sift.out"
  has_text 'OBSTACLE_OBSERVATIONS: [1-9][0-9]* do not' "$work/sift.out"
}

# Whether the predictor's heartbeats count observations as received.
hears_observations() {
  python3 - "$work/python.lcm" <<'END'
import struct, sys, tern_msgs
with open(sys.argv[1], "rb") as log:
    while len(head := log.read(28)) == 28:
        _, _, _, channel_bytes, data_bytes = struct.unpack(">IqqII", head)
        channel, data = log.read(channel_bytes).decode(), log.read(data_bytes)
        if channel != "HEARTBEAT":
            continue
        beat = tern_msgs.heartbeat_t.decode(data)
        at = 0
        for counters in beat.channels:
            name, at = beat.channel_text[at : at + counters.name_length].decode(), at + counters.name_length
            if name == "OBSTACLE_OBSERVATIONS" and counters.received > 5:
                sys.exit(0)
sys.exit(1)
END
}

a_key_that_cannot_be_used_is_refused_by_name() {
  "$TERN_BIN/tern-key" new "$work/key"
  chmod 640 "$work/key"
  [[ $(code "$scripts/fly.sh" --no-install --key "$work/key" --record "$work/r" --summary "$work/s.json") == 3 ]] || fail "exit code"
  expect "mode and remedy" has_text "$work/key: mode 640: readable by others than its owner; run chmod 600 $work/key" "$work/out"
  expect "a summary" has_text '"outcome": "failed"' "$work/s.json"
  [[ $(code "$TERN_BIN/tern-planner" --key-file "$work/key") == 2 ]] || fail "exit code of a process"
  expect "mode" has_text "tern-planner: $work/key: mode 640" "$work/out"
  [[ $(code "$scripts/fly.sh" --no-install --key "$work/none" --record "$work/r") == 3 ]] || fail "exit code without a file"
  [[ $(code "$scripts/fly.sh" --no-install --key= --record "$work/r") == 3 ]] || fail "exit code of --key="
  [[ $(code "$scripts/fly.sh" --no-install --key '' --record "$work/r") == 3 ]] || fail "exit code of an empty name"
  [[ $(code timeout 180 "$TERN_BIN/tern-planner" --key-file '') == 2 ]] || fail "a process with an empty name flies without keys"
  [[ $(code "$TERN_BIN/tern-planner" --key-fd 77) == 2 ]] || fail "exit code of a descriptor that is none"
  nobody_left || fail "left: $(pgrep -af "$work/")"
}

tern_key_makes_files_of_mode_600_and_never_overwrites() {
  umask 000
  "$TERN_BIN/tern-key" new "$work/key"
  "$TERN_BIN/tern-key" derive "$work/key" tern-planner "$work/planner.key"
  [[ $(stat -c %a "$work/key" "$work/planner.key" | tr '\n' ' ') == '600 600 ' ]] || fail "$(ls -l "$work")"
  [[ $(code "$TERN_BIN/tern-key" new "$work/key") == 2 ]] || fail "overwritten"
  [[ $(code "$TERN_BIN/tern-key" derive "$work/key" tern-nobody "$work/x") == 2 ]] || fail "a process that is none"
  [[ $(code "$TERN_BIN/tern-predictor" --key-file "$work/planner.key") == 2 ]] || fail "another's ring"
  expect "whose it is" has_text 'holds the keys of the planner, not those of tern-predictor' "$work/out"
  ! grep -qE "^(PREDICTIONS|PLAN|predictor) $(cat "$work/key")" "$work/planner.key" || fail "the master key is in a ring"
}

run_test "$1"
