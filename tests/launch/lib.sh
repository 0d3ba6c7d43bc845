# Functions that the tests of the launch scripts share. Sourced, never run. Environment: TERN_BIN, the folder of programs.
# shellcheck shell=bash

root=$(dirname "$(dirname "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")")")
scripts=$root/launch_scripts
work=$(mktemp -d)
flights=() # pids of flights that this test started
cleanup() {
  local pid
  # A failed test may leave a supervisor stopped, which then receives no other signal, or cores busy.
  for pid in "${flights[@]}" $(jobs -p) $(pgrep -f "$work/" || true); do kill -KILL "$pid" 2>/dev/null || true; done
  rm -rf "$work"
}
trap cleanup EXIT

fail() {
  echo "FAILED: $*" >&2
  exit 1
}

# expect CLAIM COMMAND...: the command succeeds.
expect() {
  local what=$1
  shift
  "$@" || fail "$what: $*"
}

readonly PATIENCE_S=180 # for what takes moments on an idle machine: only a test that fails waits so long

# eventually CLAIM COMMAND...: waits until the command succeeds.
eventually() {
  local what=$1 deadline=$((SECONDS + PATIENCE_S))
  shift
  until "$@" >/dev/null 2>&1; do
    if ((SECONDS > deadline)); then
      tail -n 20 "$work"/*.out "$work"/*/tern-*.log >&2
      fail "not within $PATIENCE_S s: $what: $*"
    fi
    read -rt 0.02 <> <(:) || true
  done
}

# code COMMAND...: runs it with its output in $work/out; prints its exit code.
code() {
  local code=0
  "$@" >"$work/out" 2>&1 || code=$?
  echo "$code"
}

# The scenario that start_flight flies: a copy in this test's folder, which every process then has in its command line.
scenario=$root/scenarios/corridor_demo.yaml

nobody_left() { ! pgrep -f "$work/" >/dev/null; }
has_text() { grep -q -- "$1" "$2"; }
is_gone() { ! kill -0 "$1" 2>/dev/null; }

# start_flight NAME OPTION...: in the background as a terminal would run it, SIGINT not ignored; waits until it records. Sets
# `flight` to the process group.
start_flight() {
  local name=$1
  shift
  cp "$scenario" "$work/scenario.yaml"
  env --default-signal=INT setsid "$scripts/fly.sh" --no-install --scenario "$work/scenario.yaml" --record "$work/$name" "$@" \
    >"$work/$name.out" 2>&1 &
  flight=$!
  flights+=("$flight")
  eventually "$name records" test -s "$work/$name/flight.lcm"
}

# Ends a flight as Ctrl-C does, and waits for it.
end_flight() {
  kill -INT -- "-$1"
  wait "$1" || true
}

# run_test NAME: a function of the test script.
run_test() {
  declare -F "$1" >/dev/null || fail "no test $1"
  "$1"
  echo "passed: $1"
}
