# Functions that the tests of whole flights share, in addition to lib.sh. Sourced, never run.
# shellcheck shell=bash disable=SC2154  # of lib.sh: work, flight

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

# holds NAME EXPRESSION: awk finds the expression of numbers true.
holds() { awk "BEGIN { exit !($2) }" || fail "$1: not $2"; }

# replays FLIGHT [MINIMUM]: at least so many answers (default 30), and each gives the same bytes when planned again.
replays() {
  local result=0
  "$TERN_BIN/tern-replay" "$work/$1" --json "$work/$1.replay" || result=$?
  [[ $result == 0 ]] || fail "the replay's exit code is $result"
  python3 -c 'import json, sys
replay = json.load(open(sys.argv[1]))
assert replay["answers"] == replay["identical"] and replay["answers"] >= int(sys.argv[2]), replay["answers"]' "$work/$1.replay" "${2:-30}" ||
    fail "not every answer is the same"
}

# reached FLIGHT: it reached its goal and left no process behind.
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

# A process of this test's flights.
process_of() { pgrep -x -f "[^ ]*/$1 --config $work/.*" | head -n 1; }
processes() { pgrep -f "$work/" || true; }

# says FLIGHT TEXT: the monitor's newest line contains the text.
says() { tail -n 1 "$work/$1.out" | grep -q -- "$2"; }
flies() { grep -qE ' [1-9]\.[0-9]+ m/s' "$work/$1.out"; }
runs() { [[ -n $(process_of "$1") ]]; }
is_larger() { (($(stat -c %s "$1") > $2)); }

# Every key that is made of a master key's file, the master too: in bytes and in digits, a line of hexadecimal each.
all_keys() {
  python3 - "$1" <<'END'
import hashlib, sys
master = bytes.fromhex(open(sys.argv[1]).read())
names = """UAV_STATE SETPOINT VEHICLE_STATUS VEHICLE_TRUTH OBSTACLE_OBSERVATIONS DECLARED_MOTIONS HORIZON_REQUEST OBSTACLE_TRUTH FLIGHT_RESULT PREDICTIONS PLAN
PLAN_TIMING SEARCH_VIEW SEMANTIC_MAP GOAL vehicle predictor planner mapper operator observer executor""".split()
for key in [master] + [hashlib.blake2b(b"tern key 1 " + n.encode(), key=master, digest_size=32).digest() for n in names]:
    print(key.hex())
    print(key.hex().encode().hex())
    print(key.hex().upper().encode().hex())
END
}

# is_without_keys WHAT FILE...: none of all_keys, which are in $work/all_keys, occurs in what these files hold.
is_without_keys() {
  python3 - "$@" <<END || fail "a key is in $1"
import sys
keys = [bytes.fromhex(line) for line in open("$work/all_keys")]
assert len(keys) == 69
for name in sys.argv[2:]:
    try:
        data = open(name, "rb").read()
    except OSError:
        continue  # a process that has ended
    if any(key in data for key in keys):
        sys.exit(f"{name}")
END
}

# How many of the flight's processes hold an open file of keys, by the first program's name on each command line.
key_holders() {
  local pid
  for pid in $(processes); do
    readlink "/proc/$pid"/fd/* 2>/dev/null | grep -q '^/memfd:tern-keys' || continue
    tr '\0' '\n' <"/proc/$pid/cmdline" | grep -m1 -oE 'fly\.sh$|tern-[a-z]+$'
  done | sort | uniq -c | tr -s ' \n' ' '
}

# expect_keys_nowhere: while a flight with the key $work/key flies: in no command line, no environment, and in one process's open file.
expect_keys_nowhere() {
  local pid args=() environments=() holders
  all_keys "$work/key" >"$work/all_keys"
  for pid in $(processes); do args+=("/proc/$pid/cmdline") && environments+=("/proc/$pid/environ"); done
  ((${#args[@]} >= 8)) || fail "only ${#args[@]} processes"
  is_without_keys "a command line" "${args[@]}"
  is_without_keys "an environment" "${environments[@]}"
  holders=$(key_holders)
  [[ $holders == ' 1 tern-launch ' ]] || fail "open keys: $holders"
}

# python_reads_signed_states LOG: the types of lcmtypes in Python decode a log's states, and each has a tag.
python_reads_signed_states() {
  PYTHONPATH=$TERN_BIN/../python python3 - "$1" <<'END' || fail "Python cannot read the log"
import struct, sys, tern_msgs
states = 0
with open(sys.argv[1], "rb") as log:
    while len(head := log.read(28)) == 28:
        _, _, _, channel_bytes, data_bytes = struct.unpack(">IqqII", head)
        channel, data = log.read(channel_bytes).decode(), log.read(data_bytes)
        if channel == "UAV_STATE":
            states += tern_msgs.uav_state_t.decode(data).at_us > 0 and data[-48:-44] == b"TMAC"
assert states > 500, states
END
}

# has_the_speeds_of_its_states FLIGHT: top speed and stops of its summary are those of the velocities in its log.
has_the_speeds_of_its_states() {
  PYTHONPATH=$TERN_BIN/../python python3 - "$work/$1" <<'END' || fail "the summary's speeds are not those of VEHICLE_TRUTH"
import json, math, struct, sys, tern_msgs
speeds = []
with open(sys.argv[1] + "/flight.lcm", "rb") as log:
    while len(head := log.read(28)) == 28:
        _, _, _, channel_bytes, data_bytes = struct.unpack(">IqqII", head)
        channel, data = log.read(channel_bytes).decode(), log.read(data_bytes)
        if channel == "VEHICLE_TRUTH":
            v = tern_msgs.uav_state_t.decode(data).motion.velocity
            speeds.append(math.hypot(v.x, v.y, v.z))
summary = json.load(open(sys.argv[1] + "/summary.json"))
top, rests = max(speeds), sum(a >= 0.1 > b for a, b in zip(speeds, speeds[1:]))
print(f"{len(speeds)} states, at most {top:.3f} m/s, {rests} times at rest; summary: {summary['top_speed_mps']:.3f} m/s, {summary['stops']} stops")
assert len(speeds) > 500 and 0.9 * top < summary["top_speed_mps"] < 1.02 * top and summary["stops"] <= rests
END
}

# expect_log_as_counted FLIGHT: the log holds as many states as the logger counted.
expect_log_as_counted() {
  local counted logged
  counted=$(grep -E 'UAV_STATE .*received' "$work/$1/tern-logger.log" | sed -E 's/.*received +([0-9]+).*/\1/')
  # The head of an event of this channel: its length, 9, the data's length, its name.
  logged=$(LC_ALL=C grep -aoP '\x00\x00\x00\x09\x00\x00..UAV_STATE' "$work/$1/flight.lcm" | grep -ac UAV_STATE)
  [[ $counted -gt 0 && $counted == "$logged" ]] || fail "counted $counted, logged $logged"
}
