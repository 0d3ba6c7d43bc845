#!/usr/bin/env bash
# tests.sh NAME: runs one test of the launch scripts. Environment: TERN_BIN, where the programs are.
set -euo pipefail
# shellcheck source=tests/launch/lib.sh
source "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/lib.sh"
# shellcheck source=tests/launch/flight_lib.sh
source "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/flight_lib.sh"

# make_mortal CODE: a program that counts its starts and dies immediately with the exit code CODE.
make_mortal() {
  cat >"$work/mortal" <<END
#!/bin/sh
echo start >>"$work/starts"
exit $1
END
  chmod +x "$work/mortal"
}

keep_alive_restarts_with_growing_delays() {
  make_mortal 70
  "$scripts/keep_alive.sh" --log "$work/log" -- "$work/mortal" &
  local keeper=$!
  eventually "9 restarts" has_text "restart 9 in 1000 ms" "$work/log"
  kill -TERM "$keeper"
  wait "$keeper" || fail "exit code $?"
  local delays
  delays=$(grep -oE 'in [0-9]+ ms' "$work/log" | grep -oE '[0-9]+' | head -n 9 | tr '\n' ' ')
  [[ $delays == '10 20 40 80 160 320 640 1000 1000 ' ]] || fail "delays: $delays"
  expect "the log says why" has_text "mortal ended with exit code 70; restart 1 in 10 ms" "$work/log"
}

keep_alive_does_not_repeat_a_mistake() {
  local mistake
  for mistake in 0 2 3; do
    : >"$work/starts"
    make_mortal "$mistake"
    [[ $(code "$scripts/keep_alive.sh" "$work/mortal") == "$mistake" ]] || fail "exit code of $mistake"
    [[ $(wc -l <"$work/starts") == 1 ]] || fail "started again after $mistake"
  done
  [[ $(code "$scripts/keep_alive.sh" "$work/nothing") == 127 ]] || fail "exit code of a program that is not there"
}

keep_alive_passes_the_end_on() {
  cat >"$work/polite" <<END
#!/bin/sh
trap 'echo heard >"$work/heard"; exit 0' TERM
echo ready >"$work/ready"
while :; do read -r _ <"$work/fifo" || true; done
END
  chmod +x "$work/polite"
  mkfifo "$work/fifo"
  "$scripts/keep_alive.sh" "$work/polite" &
  local keeper=$!
  eventually "start" test -e "$work/ready"
  kill -TERM "$keeper"
  wait "$keeper" || fail "exit code $?"
  expect "the child heard it" test -e "$work/heard"
  eventually "nobody is left" nobody_left
}

# Its landing takes 3 s: longer than keep_alive gives other commands.
keep_alive_lets_the_bridge_land() {
  mkdir "$work/bin"
  cat >"$work/bin/tern-mavlink" <<END
#!/bin/sh
trap 'sleep 3; echo landed >"$work/landed"; exit 0' TERM
echo ready >"$work/ready"
while :; do read -r _ <"$work/fifo" || true; done
END
  chmod +x "$work/bin/tern-mavlink"
  mkfifo "$work/fifo"
  local launch=$TERN_BIN/tern-launch
  TERN_BIN=$work/bin "$launch" keep -- "$scripts/mavlink.sh" &
  local keeper=$!
  eventually "start" test -e "$work/ready"
  kill -TERM "$keeper"
  wait "$keeper" || fail "exit code $?"
  expect "it has landed" test -e "$work/landed"
}

# Its pilot flies on: it ends at the second signal only, which comes after the launcher has said what it does.
keep_alive_waits_for_a_pilot_until_it_is_asked_again() {
  mkdir "$work/bin"
  cat >"$work/bin/tern-mavlink" <<END
#!/bin/sh
trap 'echo asked >>"$work/asked"; [ \$(wc -l <"$work/asked") -lt 2 ] || exit 5' TERM
echo ready >"$work/ready"
while :; do read -r _ <"$work/fifo" || true; done
END
  chmod +x "$work/bin/tern-mavlink"
  mkfifo "$work/fifo"
  "$TERN_BIN/tern-launch" keep -- "$work/bin/tern-mavlink" 2>"$work/said" &
  local keeper=$!
  eventually "start" test -e "$work/ready"
  kill -TERM "$keeper"
  eventually "it says what it waits for" has_text "waits until the vehicle is disarmed" "$work/said"
  [[ $(wc -l <"$work/asked") == 1 ]] || fail "asked before the second signal"
  kill -TERM "$keeper"
  wait "$keeper" || fail "exit code $?"
  expect "it says what it leaves" has_text "THE VEHICLE MAY STILL BE ARMED" "$work/said"
}

# A program that ends by SIGKILL only; it holds a file named $1 with its pid.
make_stubborn() {
  cat >"$work/stubborn" <<END
#!/bin/bash
trap '' TERM INT HUP
echo \$\$ >"$work/stubborn.pid"
while :; do read -rt 1 <> <(:) || true; done
END
  chmod +x "$work/stubborn"
}

keep_alive_does_not_outlive_its_child_nor_the_other_way_round() {
  make_stubborn
  "$scripts/keep_alive.sh" "$work/stubborn" &
  local keeper=$!
  eventually "start" test -s "$work/stubborn.pid"
  kill -TERM "$keeper"
  wait "$keeper" || fail "exit code $?"
  eventually "the child was killed" is_gone "$(cat "$work/stubborn.pid")"

  rm "$work/stubborn.pid"
  "$scripts/keep_alive.sh" "$work/stubborn" &
  keeper=$!
  eventually "start" test -s "$work/stubborn.pid"
  kill -KILL "$keeper"
  wait "$keeper" || true
  eventually "the kernel killed the child" is_gone "$(cat "$work/stubborn.pid")"
}

fly_refuses_a_bad_scenario_with_file_and_line() {
  printf 'name: bad\nworld:\n  count: -4\n' >"$work/bad.yaml"
  [[ $(code "$scripts/fly.sh" --no-install --scenario "$work/bad.yaml" --record "$work/r") == 3 ]] || fail "exit code"
  expect "file, line, key, value, limit" has_text "$work/bad.yaml:3: world.count: -4 is out of range \[0, " "$work/out"
  [[ $(grep -c 'world.count' "$work/out") == 1 ]] || fail "said more than once"
  expect "nobody is left" nobody_left
}

fly_refuses_a_bad_setting_of_one_process() {
  local setting
  [[ $(code "$scripts/fly.sh" --no-install --set planner.bogus=3 --record "$work/r") == 3 ]] || fail "exit code"
  expect "override, key" has_text "planner.bogus=3: planner.bogus: unknown key" "$work/out"
  expect "a summary" has_text '"outcome": "failed"' "$work/r/summary.json"
  # Nor is a mistake of one that does not fly left unsaid.
  for setting in mavlink.bogus=3 autopilot_sim.bogus=3 mavlink.rate_hz=1; do
    [[ $(code "$scripts/fly.sh" --no-install --set "$setting" --record "$work/$setting") == 3 ]] || fail "exit code of $setting"
    expect "override, key" has_text "--set $setting: ${setting%=*}: " "$work/out"
  done
  [[ $(code "$scripts/fly.sh" --no-install --check --set mavlink.bogus=3) == 2 ]] || fail "exit code of a check"
  expect "key" has_text "mavlink.bogus: unknown key" "$work/out"
  [[ $(code "$TERN_BIN/tern-launch" fly --programs="$TERN_BIN" --config="$scenario" --flights="$work/flights" \
    --set=uav.bogus=3) == 3 ]] || fail "exit code"
  [[ -z $(ls "$work/flights") ]] || fail "a flight that never began left a folder"
}

fly_refuses_bad_options() {
  local options
  for options in "--seed" "--nonsense" "--goal 1,2" "--semantics maybe" "--scenario nowhere" "stray" "--seed one" \
    "--allow-goals" "--record=" "--set=" "--view="; do
    # shellcheck disable=SC2086  # an option and its value
    [[ $(code "$scripts/fly.sh" --no-install --record "$work/$RANDOM" $options) == 3 ]] || fail "exit code of $options"
  done
  [[ $(code "$scripts/fly.sh" --no-install paper_corridor) == 3 ]] || fail "exit code of a name"
  expect "how to fly it" has_text "--scenario paper_corridor" "$work/out"
  [[ $(code "$scripts/fly.sh" --help) == 0 ]] || fail "--help"
}

fly_summarizes_what_it_could_not_fly() {
  local keys
  keys='outcome detail cause why recording scenario seed count settings flight_time_s first_entry_s path_length_m mean_speed_mps top_speed_mps stops'
  keys+=' min_clearance_m min_map_clearance_m limit_violations contacts_moving contacts_at_rest obstacles obstacles_left_out requests answered_in_time second_answers plans confidence left_out passively_safe_share replan_ms exposure messages restarts said beside log command pace version'
  [[ $(code "$scripts/fly.sh" --no-install --scenario nowhere --seed 4 --summary "$work/s.json") == 3 ]] || fail "exit code"
  [[ $(grep -oE '^  "[a-z_]+"' "$work/s.json" | tr -d ' "' | tr '\n' ' ') == "$keys " ]] || fail "keys: $(cat "$work/s.json")"
  expect "the seed" has_text '"seed": 4,' "$work/s.json"
  expect "the reason" has_text '"detail": "no scenario nowhere; there are: ' "$work/s.json"
}

# A folder of programs like TERN_BIN, with a planner that no signal but SIGKILL ends.
with_stubborn_planner() {
  make_stubborn
  mkdir "$work/bin"
  ln -s "$TERN_BIN"/tern-* "$work/bin"
  ln -sf "$work/stubborn" "$work/bin/tern-planner"
  export TERN_BIN=$work/bin
}

an_example_in_python_says_that_there_is_no_multicast_route() {
  export PYTHONPATH=$TERN_BIN/../python
  [[ $(code unshare -Urn python3 "$root/docs/examples/own_detector.py" --empty) == 1 ]] || fail "$(cat "$work/out")"
  expect "the remedy" has_text "this machine has no route for multicast: ip route add" "$work/out"
  ! has_text Traceback "$work/out" || fail "$(cat "$work/out")"
}

ctrl_c_ends_everything() {
  with_stubborn_planner
  start_flight flight --seed 2
  eventually "the planner" test -s "$work/stubborn.pid"
  local began=${EPOCHREALTIME/[.,]/} result=0
  kill -INT -- "-$flight"
  wait "$flight" || result=$?
  echo "ended after $(((${EPOCHREALTIME/[.,]/} - began) / 1000)) ms"
  [[ $result == 130 ]] || fail "exit code $result"
  nobody_left || fail "left: $(pgrep -af "$work/")"
  expect "the logger had the last word" has_text "exits with code 0" "$work/flight/tern-logger.log"
}

ctrl_c_ends_a_long_audit() {
  mkdir "$work/bin"
  ln -s "$TERN_BIN"/tern-* "$work/bin"
  rm "$work/bin/tern-audit"
  printf '#!/bin/sh\ntouch "%s"\nexec sleep 1000\n' "$work/looks" >"$work/bin/tern-audit"
  chmod +x "$work/bin/tern-audit"
  scenario=$root/scenarios/window.yaml
  TERN_BIN=$work/bin start_flight flight --audit
  eventually "the audit has begun" test -e "$work/looks"
  kill -INT -- "-$flight"
  local code=0
  wait "$flight" || code=$?
  expect "the exit code $code" test "$code" = 130
  eventually "nobody is left" nobody_left
}

a_killed_launcher_leaves_no_orphan() {
  with_stubborn_planner
  start_flight flight
  eventually "the planner" test -s "$work/stubborn.pid"
  kill -KILL "$flight"
  eventually "nobody is left" nobody_left
}

a_killed_supervisor_fails_the_flight_and_leaves_no_orphan_of_an_orphan() {
  with_stubborn_planner
  rm "$work/bin/tern-planner"
  printf '#!/bin/sh\n"%s" &\nwait\n' "$work/stubborn" >"$work/bin/tern-planner" # which is not told when its parent dies
  chmod +x "$work/bin/tern-planner"
  start_flight flight --summary "$work/s.json"
  eventually "the planner's child" test -s "$work/stubborn.pid"
  local result=0
  kill -KILL "$(pgrep -P "$flight" -x tern-launch)"
  wait "$flight" || result=$?
  [[ $result == 3 ]] || fail "exit code $result"
  eventually "nobody is left" nobody_left
  expect "a summary says why" has_text '"detail": "tern-launch ended with signal KILL"' "$work/s.json"
}

two_flights_take_two_ports() {
  start_flight one --set name=flight_of_one
  start_flight two --set name=flight_of_two
  local url_one url_two
  url_one=$(env -i bash -c "source $work/one/env.sh && echo \$LCM_DEFAULT_URL")
  url_two=$(env -i bash -c "source $work/two/env.sh && echo \$LCM_DEFAULT_URL")
  [[ $url_one == udpm://239.255.76.67:*ttl=0 && $url_two == udpm://239.255.76.67:*ttl=0 ]] || fail "$url_one, $url_two"
  [[ $url_one != "$url_two" ]] || fail "both on $url_one"
  # Configurations, repeated every 5 s, name their flight.
  local flight other
  for flight in one two; do eventually "$flight hears itself" has_text "flight_of_$flight" "$work/$flight/flight.lcm"; done
  kill -INT "${flights[@]}"
  wait "${flights[0]}" "${flights[1]}" || true
  for flight in one two; do
    other=$([[ $flight == one ]] && echo two || echo one)
    ! has_text "flight_of_$other" "$work/$flight/flight.lcm" || fail "$flight heard $other"
  done
  nobody_left || fail "left: $(pgrep -af "$work/")"
}

an_isolated_flight_can_be_entered() {
  start_flight flight --isolated
  local outside inside
  outside=$(readlink /proc/self/ns/net)
  inside=$("$scripts/enter.sh" "$work/flight" -- readlink /proc/self/ns/net)
  [[ -n $inside && $inside != "$outside" ]] || fail "inside $inside, outside $outside"
  # shellcheck disable=SC2016  # the inner shell expands it
  [[ $("$scripts/enter.sh" "$work/flight" -- sh -c 'echo $LCM_DEFAULT_URL') == udpm://* ]] || fail "no LCM_DEFAULT_URL"
  end_flight "$flight"
  nobody_left || fail "left: $(pgrep -af "$work/")"
  [[ ! -e $work/flight/namespace ]] || fail "its namespace is still named"
  [[ $(code "$scripts/enter.sh" "$work/flight") == 3 ]] || fail "entered a flight that has ended"
}

the_log_holds_what_the_logger_counted() {
  start_flight flight
  eventually "states" has_text UAV_STATE "$work/flight/flight.lcm"
  end_flight "$flight"
  expect_log_as_counted flight
}

a_logger_that_is_slow_to_start_misses_nothing() {
  mkdir "$work/bin"
  ln -s "$TERN_BIN"/tern-* "$work/bin"
  rm "$work/bin/tern-logger"
  printf '#!/bin/sh\nsleep 1\nexec "%s/tern-logger" "$@"\n' "$TERN_BIN" >"$work/bin/tern-logger"
  chmod +x "$work/bin/tern-logger"
  local audit=$TERN_BIN/tern-audit
  TERN_BIN=$work/bin start_flight flight
  eventually "states" has_text UAV_STATE "$work/flight/flight.lcm"
  end_flight "$flight"
  "$audit" "$work/flight/flight.lcm" >"$work/audit.txt" || true
  ! grep "lacks the first" "$work/audit.txt" || fail "the log lacks what was said first"
}

every_program_starts_alone() {
  local name pid
  for name in simulator executor predictor mapper planner logger monitor; do
    [[ $(code "$scripts/$name.sh" --help) == 0 ]] || fail "$name --help"
    [[ $(code "$scripts/$name.sh" --version) == 0 ]] || fail "$name --version"
    expect "$name --version" has_text "tern-$name 0" "$work/out"
    [[ $(code "$scripts/$name.sh" --config "$work/nowhere.yaml") == 2 ]] || fail "$name --config nowhere"
  done
  cd "$work"
  for name in simulator executor predictor mapper planner logger monitor; do
    "$scripts/$name.sh" >"$work/$name.out" 2>&1 &
    pid=$!
    eventually "$name runs" has_text "started" "$work/$name.out"
    kill -TERM "$pid"
    wait "$pid" || fail "$name ends with $?"
  done
}

# Programs that would install, build or fetch: here they only leave a trace.
with_nothing_to_do() {
  local name
  mkdir "$work/path"
  for name in apt-get cmake ctest npm npx; do
    printf '#!/bin/sh\necho "%s $*" >>"%s/done"\n' "$name" "$work" >"$work/path/$name"
    chmod +x "$work/path/$name"
  done
  export PATH=$work/path:$PATH
}

asked_for_help_scripts_say_what_they_do_and_do_nothing() {
  local script name
  with_nothing_to_do
  for script in "$scripts"/*.sh "$TERN_BIN/tern-listen"; do
    name=$(basename "$script" .sh)
    [[ $name != lib && $name != run ]] || continue # the one is sourced, the other called by other names
    [[ $(code "$script" --help) == 0 ]] || fail "$name --help: $(cat "$work/out")"
    expect "$name says what it is" has_text "${name%%_*}" "$work/out"
    [[ ! -e $work/done ]] || fail "$name --help did something: $(cat "$work/done")"
  done
}

install_refuses_a_list_that_cannot_be_read() {
  local list
  with_nothing_to_do
  for list in "$work/nowhere.txt" "$work" --nonsense; do
    [[ $(code "$scripts/install.sh" "$list") == 2 ]] || fail "exit code of $list"
    expect "it is named" has_text "$list" "$work/out"
  done
  [[ ! -e $work/done ]] || fail "something was done: $(cat "$work/done")"
}

# make_tree STEPS COMMAND: makes a tree with these scripts whose build has STEPS steps, each of them COMMAND; sets `tree`.
make_tree() {
  tree=$work/tree
  mkdir "$tree"
  cp -r "$scripts" "$tree"
  cat >"$tree/CMakePresets.json" <<'END'
{"version": 3,
 "configurePresets": [{"name": "release", "generator": "Ninja", "binaryDir": "${sourceDir}/build/release"}],
 "buildPresets": [{"name": "release", "configurePreset": "release"}]}
END
  cat >"$tree/CMakeLists.txt" <<END
cmake_minimum_required(VERSION 3.22)
project(tree NONE)
foreach(k RANGE 1 $1)
  add_custom_command(OUTPUT \${k} COMMAND $2 COMMAND \${CMAKE_COMMAND} -E touch \${k} VERBATIM)
  list(APPEND steps \${k})
endforeach()
add_custom_target(first DEPENDS 1)
add_custom_target(apps DEPENDS \${steps})
END
  unset TERN_BIN
}

two_builds_of_one_tree_wait_for_each_other() {
  printf '#!/bin/sh\necho begins >>"%s/steps"\nread -r _ <"%s/fifo"\necho ends >>"%s/steps"\n' "$work" "$work" "$work" >"$work/step"
  chmod +x "$work/step"
  mkfifo "$work/fifo"
  make_tree 1 "$work/step"
  "$tree/launch_scripts/build.sh" >"$work/one.out" 2>&1 &
  local one=$!
  eventually "the first one builds" test -s "$work/steps"
  "$tree/launch_scripts/build.sh" >"$work/two.out" 2>&1 &
  local two=$!
  eventually "the second one says that it waits" has_text "Another build is running, waiting" "$work/two.out"
  echo >"$work/fifo"
  wait "$one" || fail "the first one: $(cat "$work/one.out")"
  wait "$two" || fail "the second one: $(cat "$work/two.out")"
  [[ $(tr '\n' ' ' <"$work/steps") == 'begins ends ' ]] || fail "steps: $(cat "$work/steps")"
}

a_build_shows_its_progress_while_much_is_left() {
  make_tree 40 true
  # shellcheck disable=SC2016  # the inner shell expands it
  local build=(bash -c 'source "$0" && build_programs' "$tree/launch_scripts/lib.sh")
  # A build that ended early, when the program that starts flights was there.
  expect "a part is built" "$tree/launch_scripts/build.sh" first
  mkdir "$tree/build/release/bin"
  touch "$tree/build/release/bin/tern-launch"
  [[ $(code "${build[@]}") == 0 ]] || fail "exit code: $(cat "$work/out")"
  expect "how much" has_text "programs, [0-9]* steps" "$work/out"
  expect "ninja's progress" has_text "^\[39/39\] [^:]*$" "$work/out"
  expect "how long" has_text "^\[20/39\] less than 1 min left: " "$work/out"
  rm "$tree/build/release/7"
  [[ $(code "${build[@]}") == 0 ]] || fail "exit code: $(cat "$work/out")"
  [[ ! -s $work/out ]] || fail "little was left, and it said: $(cat "$work/out")"
  expect "it is built" test -e "$tree/build/release/7"
}

a_build_that_fails_says_why_and_fails() {
  make_tree 40 true
  cat >>"$tree/CMakeLists.txt" <<'END'
add_custom_target(wrong COMMAND sh -c "echo a mistake; exit 1" VERBATIM)
add_dependencies(wrong apps)
END
  # shellcheck disable=SC2016  # the inner shell expands it
  [[ $(code bash -c 'source "$0" && build_programs wrong' "$tree/launch_scripts/lib.sh") == 1 ]] || fail "exit code"
  expect "the steps before" has_text "^\[30/" "$work/out"
  expect "the compiler's words" has_text "^a mistake" "$work/out"
}

the_time_left_is_measured() {
  # shellcheck disable=SC2016  # the inner shell expands it
  local left=(bash -c 'source "$0" && time_left "$@"' "$scripts/lib.sh")
  [[ $("${left[@]}" 20 220 20) == '3 min left' ]] || fail "$("${left[@]}" 20 220 20)"
  [[ $("${left[@]}" 20 220 5) == 'less than 1 min left' ]] || fail "$("${left[@]}" 20 220 5)"
}

# fly.sh OPTION... builds these targets and no other: $1, options: $2...
expect_built() {
  local targets=$1
  shift
  rm -f "$tree"/build/release/built-*
  [[ $(code "$tree/launch_scripts/fly.sh" --no-install --scenario "$work/$fly_scenario" "$@") != 0 ]] || fail "nothing was there to fly"
  local built
  built=$(cd "$tree/build/release" && printf '%s ' built-*)
  [[ ${built//built-/} == "$targets " ]] || fail "fly.sh $*: built $built: $(cat "$work/out")"
}

fly_builds_what_flies_and_an_option_adds_its_programs() {
  local name fly_scenario=plain.yaml
  make_tree 1 true
  for name in flight tern-{audit,autopilot-sim,campaign,detector,estimator,key,listen,mavlink,mission,report,viewer}; do
    # shellcheck disable=SC2016  # cmake expands it
    printf 'add_custom_target(%s COMMAND ${CMAKE_COMMAND} -E touch built-%s VERBATIM)\n' "$name" "$name" >>"$tree/CMakeLists.txt"
  done
  echo 'name: plain' >"$work/plain.yaml"
  printf 'mavlink:\n  rate_hz: 50\n' >"$work/bridged.yaml"
  expect_built 'flight'
  expect_built 'flight tern-audit' --audit
  expect_built 'flight tern-audit tern-report' --report --audit
  expect_built 'flight tern-key' --key
  expect_built 'flight tern-listen tern-viewer' --view
  expect_built 'flight tern-mavlink' --autopilot udp://127.0.0.1:14540
  expect_built 'flight tern-autopilot-sim tern-mavlink' --autopilot sim
  expect_built 'flight tern-mavlink' --set mavlink.rate_hz=50
  expect_built 'flight tern-detector' --set detector.ground=false
  expect_built 'flight tern-estimator' --set estimator.clones=8
  expect_built 'flight tern-estimator' --set simulator.estimation=vio
  expect_built 'flight tern-mission' --mission "$work/plain.yaml"
  expect_built 'tern-campaign' --check
  fly_scenario=bridged.yaml
  expect_built 'flight tern-mavlink'
}

a_program_that_is_not_there_is_built_alone() {
  make_tree 1 true
  ln -s run.sh "$tree/launch_scripts/one.sh"
  cat >>"$tree/CMakeLists.txt" <<'END'
add_custom_target(tern-one COMMAND sh -c "mkdir -p bin && printf '#!/bin/sh\\necho here' >bin/tern-one && chmod +x bin/tern-one"
  VERBATIM)
END
  [[ $(code "$tree/launch_scripts/one.sh") == 0 ]] || fail "exit code: $(cat "$work/out")"
  expect "it runs" has_text "^here$" "$work/out"
  [[ ! -e $tree/build/release/1 ]] || fail "all programs were built"
}

programs_that_need_not_be_linked_anew_are_no_build_to_speak_of() {
  make_tree 1 true
  cat >>"$tree/CMakeLists.txt" <<'END'
add_custom_command(OUTPUT always BYPRODUCTS version COMMAND sh -c "test -e version || touch version" VERBATIM)
foreach(k RANGE 1 30)
  add_custom_command(OUTPUT program${k} DEPENDS version COMMENT "Linking CXX executable program${k}"
    COMMAND ${CMAKE_COMMAND} -E touch program${k} VERBATIM)
  list(APPEND programs program${k})
endforeach()
add_custom_target(versions DEPENDS always)
add_custom_target(programs DEPENDS ${programs})
add_dependencies(apps versions programs)
END
  # shellcheck disable=SC2016  # the inner shell expands it
  local build=(bash -c 'source "$0" && build_programs' "$tree/launch_scripts/lib.sh")
  expect "it is built" "$tree/launch_scripts/build.sh"
  (($(ninja -C "$tree/build/release" -n apps | grep -c Linking) == 30)) || fail "ninja -n knows that nothing changes"
  [[ $(code "${build[@]}") == 0 ]] || fail "exit code: $(cat "$work/out")"
  [[ ! -s $work/out ]] || fail "nothing was left, and it said: $(cat "$work/out")"
}

run_test "$1"
