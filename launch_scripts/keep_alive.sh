#!/usr/bin/env bash
# keep_alive.sh [--log FILE] [--] COMMAND [ARG...]: runs COMMAND, and runs it again when it dies.
#
# It waits 10 ms before the first restart and twice as long before each further one, up to 1 s; a run of 5 s or more starts anew at
# 10 ms. Exit codes that another run cannot mend end it, with that code: 0 (done), 2 (bad configuration), 3 (no network, nobody
# ready), 126 and 127 (cannot be run). SIGTERM is passed on to COMMAND, which has 1.2 s to end before it is killed; then the exit
# code is 0. Should keep_alive.sh itself be killed, COMMAND is killed by the kernel.
set -euo pipefail

readonly FIRST_DELAY_MS=10 LAST_DELAY_MS=1000 LONG_RUN_MS=5000
readonly POLLS=60 POLL_S=0.02

log=''
while [[ ${1:-} == --* ]]; do
  case $1 in
    --log) log=$2 && shift 2 ;;
    --) shift && break ;;
    *) echo "keep_alive.sh: unknown option $1" >&2 && exit 2 ;;
  esac
done
[[ $# -gt 0 ]] || { echo "keep_alive.sh [--log FILE] [--] COMMAND [ARG...]" >&2 && exit 2; }
[[ -z $log ]] || exec >>"$log" 2>&1

# A message that asks for absurd memory shall end the process, not the machine.
memory_kb=${TERN_MEMORY_LIMIT_KB:-4000000}
[[ $memory_kb == 0 ]] || ulimit -v "$memory_kb"

child='' stopping=''
stop() {
  stopping=yes
  [[ -z $child ]] || kill -TERM "$child" 2>/dev/null || true
}
trap stop TERM INT HUP

end_child() {
  local poll
  for ((poll = 0; poll < POLLS; poll++)); do
    kill -0 "$child" 2>/dev/null || return 0
    sleep "$POLL_S"
  done
  kill -KILL "$child" 2>/dev/null || true
}

now_ms() { printf '%s' "$((${EPOCHREALTIME/[.,]/} / 1000))"; }

name=$(basename "$1")
restarts=0
delay_ms=$FIRST_DELAY_MS
while [[ -z $stopping ]]; do
  started_ms=$(now_ms)
  setpriv --pdeathsig KILL -- "$@" </dev/null &
  child=$!
  [[ -z $stopping ]] || kill -TERM "$child" || true # asked to stop before the child had a name
  code=0
  wait "$child" || code=$?
  if [[ -n $stopping ]]; then
    end_child
    exit 0
  fi
  case $code in 0 | 2 | 3 | 126 | 127) exit "$code" ;; esac

  (($(now_ms) - started_ms < LONG_RUN_MS)) || delay_ms=$FIRST_DELAY_MS
  restarts=$((restarts + 1))
  if ((code > 128)); then cause="signal $(kill -l "$code")"; else cause="exit code $code"; fi
  echo "keep_alive.sh: $name ended with $cause; restart $restarts in $delay_ms ms"
  sleep "$(printf '%d.%03d' $((delay_ms / 1000)) $((delay_ms % 1000)))" &
  child=$!
  wait "$child" || true
  delay_ms=$((delay_ms * 2 > LAST_DELAY_MS ? LAST_DELAY_MS : delay_ms * 2))
done
