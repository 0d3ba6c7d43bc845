#!/usr/bin/env bash
# endings.sh NAME: runs one test of how tern-launch begins and ends a flight, with stand-ins for its programs.
# Environment: TERN_BIN, where tern-launch is.
set -euo pipefail
# shellcheck source=tests/launch/lib.sh
source "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/lib.sh"

# make_stand_ins: programs that wait until they are ended. The logger then ends with the code in $work/logger_code. The monitor writes
# a summary, runs $work/at_end and ends with 0: the vehicle has reached its goal.
make_stand_ins() {
  local name
  mkdir "$work/bin"
  echo 0 >"$work/logger_code"
  : >"$work/at_end"
  for name in simulator executor predictor mapper planner; do
    printf '#!/bin/sh\nexec sleep 1000\n' >"$work/bin/tern-$name"
  done
  cat >"$work/bin/tern-logger" <<END
#!/usr/bin/env bash
trap 'exit "\$(cat "$work/logger_code")"' TERM
while [[ \$# -gt 0 ]]; do
  [[ \$1 != --listens-fd ]] || printf '!' >&"\$2"
  shift
done
while :; do read -rt 1 <> <(:) || true; done
END
  cat >"$work/bin/tern-monitor" <<END
#!/usr/bin/env bash
while [[ \$# -gt 0 ]]; do
  [[ \$1 != --summary ]] || echo '{}' >"\$2"
  shift
done
. "$work/at_end"
END
  chmod +x "$work"/bin/*
}

# launch OPTION...: flies the stand-ins with its output in $work/out; prints the exit code.
launch() {
  code "$TERN_BIN/tern-launch" fly --programs="$work/bin" --config="$scenario" --flights="$work/flights" \
    --lcm-url='udpm://239.255.76.67:7800?ttl=0' "$@"
}

a_flight_whose_logger_fails_at_its_end_is_incomplete() {
  make_stand_ins
  [[ $(launch --record="$work/whole") == 0 ]] || fail "a whole recording: $(cat "$work/out")"
  echo 5 >"$work/logger_code"
  [[ $(launch --record="$work/part") == 5 ]] || fail "exit code: $(cat "$work/out")"
  expect "the reason" has_text "tern-logger ended with exit code 5: the recording may lack its last messages" "$work/out"
}

flights_of_one_second_have_folders_of_their_own() {
  make_stand_ins
  local now second folder
  now=$(date +%s)
  for ((second = now; second < now + 300; second++)); do
    mkdir -p "$work/flights/$(date -u -d "@$second" +%Y%m%dT%H%M%SZ)-corridor_demo-7"
  done
  for folder in 2 3; do
    [[ $(launch --set=seed=7) == 0 ]] || fail "exit code: $(cat "$work/out")"
  done
  for folder in "$work"/flights/*-7; do [[ -z $(ls "$folder") ]] || fail "flown in $folder, which was there"; done
  [[ $(find "$work/flights" -path '*-7-2/command' | wc -l) -ge 1 ]] || fail "no folder for it: $(ls "$work/flights")"
}

a_folder_with_a_flight_or_a_log_is_refused() {
  make_stand_ins
  mkdir "$work/log" "$work/held"
  echo old >"$work/log/flight.lcm"
  [[ $(launch --record="$work/log") == 3 ]] || fail "flown beside a log"
  expect "the reason" has_text "$work/log already holds a flight" "$work/out"
  [[ $(ls "$work/log") == flight.lcm ]] || fail "written: $(ls "$work/log")"
  exec {held}<"$work/held"
  flock "$held"
  [[ $(launch --record="$work/held") == 3 ]] || fail "flown in the folder of a flight that begins"
  exec {held}<&-
  [[ $(launch --record="$work/held") == 0 ]] || fail "exit code: $(cat "$work/out")"
  [[ $(launch --record="$work/held") == 3 ]] || fail "flown in the folder of a flight"
}

a_requested_summary_is_written_or_its_lack_is_told() {
  make_stand_ins
  [[ $(launch --record=/sys --summary="$work/s.json") == 3 ]] || fail "exit code of a folder that cannot be written"
  expect "the reason" has_text '"detail": "/sys cannot be written"' "$work/s.json"
  [[ $(launch --summary="$work/no/s.json") == 3 ]] || fail "exit code of a file that cannot be written"
  expect "the file" has_text "$work/no/s.json: the summary cannot be written" "$work/out"
  [[ ! -e $work/flights ]] || fail "it has flown all the same"
  mkdir "$work/gone"
  echo "rmdir '$work/gone'" >"$work/at_end"
  [[ $(launch --summary="$work/gone/s.json") == 5 ]] || fail "exit code of a lost summary: $(cat "$work/out")"
  expect "the file" has_text "$work/gone/s.json: the summary cannot be written" "$work/out"
  : >"$work/at_end"
  [[ $(launch --summary="$work/s.json") == 0 ]] || fail "exit code: $(cat "$work/out")"
  [[ $(cat "$work/s.json") == '{}' ]] || fail "not copied: $(cat "$work/s.json")"
}

# The monitor, which waits, cannot learn that the flight has failed.
a_flight_whose_folder_is_lost_ends_with_a_summary() {
  make_stand_ins
  echo 'while :; do read -rt 1 <> <(:) || true; done' >"$work/at_end"
  printf '#!/bin/sh\nrm -r "%s"\nexit 2\n' "$work/lost" >"$work/bin/tern-planner"
  [[ $(launch --record="$work/lost" --summary="$work/s.json") == 3 ]] || fail "exit code: $(cat "$work/out")"
  expect "the reason" has_text "tern-planner ended with exit code 2" "$work/out"
  expect "a summary" has_text "\"detail\": \"$work/lost: the reason could not be written\"" "$work/s.json"
}

a_process_that_refuses_is_quoted_by_its_words_before_its_exit() {
  make_stand_ins
  # shellcheck disable=SC2028  # printf's format
  echo "printf 'info: started\\n00:00 tern-planner error: step 4 is in fence\\n00:00 tern-planner info: exits with code 2\\n'; exit 2" \
    >>"$work/refusal"
  { echo '#!/bin/sh' && cat "$work/refusal"; } >"$work/bin/tern-planner"
  echo "until [[ -e '$work/refused/failure' ]]; do read -rt 0.1 <> <(:) || true; done; exit 3" >"$work/at_end"
  [[ $(launch --record="$work/refused") == 3 ]] || fail "exit code: $(cat "$work/out")"
  expect "its error" has_text "tern-planner ended with exit code 2: 00:00 tern-planner error: step 4 is in fence" \
    "$work/refused/failure"
}

# It is asked to end while the bridge waits for a restart, or is about to crash again.
a_bridge_that_has_crashed_leaves_a_warning() {
  mkdir "$work/bin"
  printf '#!/bin/sh\nexit 70\n' >"$work/bin/tern-mavlink"
  chmod +x "$work/bin/tern-mavlink"
  "$TERN_BIN/tern-launch" keep -- "$work/bin/tern-mavlink" 2>"$work/said" &
  local keeper=$!
  eventually "restarts" has_text "restart 4 in" "$work/said"
  kill -TERM "$keeper"
  wait "$keeper" || fail "exit code $?"
  expect "it says what it leaves" has_text "THE VEHICLE MAY STILL BE ARMED" "$work/said"
  printf '#!/bin/sh\nexit 2\n' >"$work/bin/tern-mavlink"
  [[ $(code "$TERN_BIN/tern-launch" keep -- "$work/bin/tern-mavlink") == 2 ]] || fail "exit code of a mistake"
  ! has_text "ARMED" "$work/out" || fail "a bridge that never began has armed nothing"
}

a_browser_gets_no_descriptor_of_a_flight() {
  mkdir "$work/path"
  # shellcheck disable=SC2016  # the stand-in expands it
  printf '#!/bin/sh\nls /proc/$$/fd >"%s"\nmv "%s" "%s"\n' "$work/fds" "$work/fds" "$work/opened" >"$work/path/xdg-open"
  chmod +x "$work/path/xdg-open"
  # shellcheck disable=SC2016  # the inner shell expands it
  DISPLAY=:0 PATH=$work/path:$PATH bash -c 'exec 5</dev/null 77</dev/null; source "$0"; open_page url' "$scripts/lib.sh"
  eventually "it was opened" test -e "$work/opened"
  ! grep -xE '5|77' "$work/opened" || fail "it holds the flight's descriptors"
}

# A copy of the scripts without the sources, as an installation has them, builds no page.
a_viewer_that_ends_at_once_leaves_no_process_with_its_output() {
  mkdir -p "$work/bin" "$work/installed/launch_scripts"
  cp "$scripts/lib.sh" "$scripts/view.sh" "$work/installed/launch_scripts"
  printf '#!/bin/sh\necho refused\nexit 2\n' >"$work/bin/tern-viewer"
  chmod +x "$work/bin/tern-viewer"
  # Whoever reads the output waits until its last writer has ended.
  TERN_BIN=$work/bin timeout 60 "$work/installed/launch_scripts/view.sh" | timeout 60 cat >"$work/out" ||
    [[ ${PIPESTATUS[1]} == 0 ]] || fail "the output stays open"
  expect "what the viewer said" has_text refused "$work/out"
  eventually "nobody is left" nobody_left
}

a_stranger_with_the_pid_of_a_flight_is_not_entered() {
  mkdir "$work/flight"
  echo "$$ -n" >"$work/flight/namespace"
  echo 'export LCM_DEFAULT_URL=x' >"$work/flight/env.sh"
  [[ $(code "$scripts/enter.sh" "$work/flight" -- true) == 3 ]] || fail "entered: $(cat "$work/out")"
  expect "the reason" has_text "no isolated flight is running there" "$work/out"
}

run_test "$1"
