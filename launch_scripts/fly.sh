#!/usr/bin/env bash
# fly.sh: one command flies; fly.sh --help.
# shellcheck disable=SC2317  # what the EXIT trap calls is reached
set -euo pipefail
# shellcheck source=launch_scripts/lib.sh
source "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/lib.sh"

usage() {
  cat <<'END'
fly.sh [OPTION...]: installs what is missing, builds, starts Tern's processes, flies a scenario and sums it up.

  --scenario FILE|NAME  what to fly: a file, or a name in scenarios/ (default corridor_demo)
  --seed N              the world's seed (default: the scenario's)
  --count N             the world's number of obstacles (default: the scenario's)
  --goal X,Y,Z          where to fly, metres (default: the scenario's)
  --semantics on|off    whether regions attract and repel
  --set KEY=VALUE       any other value of the scenario, as executor.rate_hz=15; may be given often
  --record DIR          where log, process logs and summary go (default flights/<UTC time>-<scenario>-<seed>)
  --summary FILE        write the summary as JSON there, too
  --lcm-url URL         the LCM network to use (default: this host only, on the first port that no other flight uses)
  --key [FILE]          sign every message: with a new key for this flight, or with that of FILE (mode 600; tern-key new FILE)
  --isolated            fly in a network namespace of its own; enter.sh gives a shell in it
  --view[=ADDRESS]      show the flight in the browser: builds the page (Node 18 or newer), prints its URL and opens it
                        (default 127.0.0.1, on the first free port from 8765)
  --allow-goals         that page may send goals
  --audit               recompute the flight from its log when it has ended (tern-audit); writes audit.txt and audit.json
  --report              draw the flight when it has ended (tern-report); writes report.html
  --no-install          do not look for missing packages
  --help                this

Exit code: 0 reached, 1 collision, 2 not reached in time, 3 the system itself failed, 4 the audit found something broken in a
flight that did not collide, 128 + n ended by signal n (Ctrl-C: 130).
END
}

readonly OTHERS=(tern-simulator tern-predictor tern-mapper tern-planner)
readonly EXIT_BROKEN=4 # the audit's
readonly LOGGER=tern-logger MONITOR=tern-monitor VIEWER=tern-viewer

scenario=corridor_demo seed='' count='' record='' summary='' url='' isolated='' install=yes view='' audit='' report=''
key='' key_file='' # whether messages are signed, and whether by a file's key
viewer_options=()
settings=() # as --set KEY=VALUE ... for every process

set_value() { settings+=(--set "$1"); }

parse() {
  local option value
  while [[ $# -gt 0 ]]; do
    option=$1
    shift
    case $option in
      --isolated) isolated=yes && continue ;;
      --view) view=127.0.0.1 && continue ;;
      --allow-goals) viewer_options+=(--allow-goals) && continue ;;
      --audit) audit=yes && continue ;;
      --report) report=yes && continue ;;
      --no-install) install='' && continue ;;
      --key)
        key=yes
        [[ $# -gt 0 && $1 != -* ]] || continue
        value=$1
        shift
        ;;
      --help | -h) usage && exit 0 ;;
      --*=*) value=${option#*=} option=${option%%=*} ;;
      --scenario | --seed | --count | --goal | --semantics | --set | --record | --summary | --lcm-url)
        [[ $# -gt 0 ]] || die "$option needs a value (--help)"
        value=$1
        shift
        ;;
      *) die "unknown option $option (--help)" ;;
    esac
    case $option in
      --scenario) scenario=$value ;;
      --seed) seed=$value && set_value "seed=$value" ;;
      --count) count=$value && set_value "world.count=$value" ;;
      --goal)
        [[ $value =~ ^[^,]+,[^,]+,[^,]+$ ]] || die "--goal $value: not X,Y,Z"
        set_value "uav.goal=[$value]"
        ;;
      --semantics)
        [[ $value == on || $value == off ]] || die "--semantics $value: neither on nor off"
        set_value "semantics.enabled=$([[ $value == on ]] && echo true || echo false)"
        ;;
      --set) set_value "$value" ;;
      --record) record=$value ;;
      --summary) summary=$value ;;
      --lcm-url) url=$value ;;
      --view) view=$value ;;
      --key)
        [[ -n $value ]] || die "--key: the file's name is empty (--help)"
        key=yes key_file=$value
        ;;
      *) die "unknown option $option (--help)" ;;
    esac
  done
}

install_and_build() {
  local lists=("$TERN_ROOT/launch_scripts/packages.txt")
  [[ -z $view ]] || lists+=("$TERN_ROOT/launch_scripts/packages_view.txt")
  [[ -z $install ]] || "$TERN_ROOT/launch_scripts/install.sh" "${lists[@]}" || die "the packages could not be installed"
  build_programs || die "the programs could not be built"
  [[ -z $view ]] || "$TERN_ROOT/launch_scripts/view_page.sh" || die "the page could not be built"
}

# Becomes this script with a listening socket, made before any namespace, so that browsers outside reach the page.
listen_for_browsers() { exec "$TERN_BIN/tern-listen" "$view" "$0" "${arguments[@]}"; }

# Becomes this script with an open file of keys for each process; TERN_KEY_FDS says which ("tern-planner=5 ...").
take_keys() {
  local file=()
  [[ -z $key_file ]] || file=(--key "$key_file")
  # Tried first: a summary says what went wrong, which an exec could not.
  "$TERN_BIN/tern-key" hand "${file[@]}" -- true || die "no key to fly with"
  exec "$TERN_BIN/tern-key" hand "${file[@]}" -- "$0" "${arguments[@]}"
}

# key_fd NAME: the descriptor of a process's keys, if there are keys.
key_fd() {
  [[ " ${TERN_KEY_FDS:-} " =~ \ $1=([0-9]+)\  ]] || return 0
  printf '%s' "${BASH_REMATCH[1]}"
}

# close_keys [NAME]: all descriptors of keys but that process's.
close_keys() {
  local entry fd
  for entry in ${TERN_KEY_FDS:-}; do
    fd=${entry#*=}
    [[ ${entry%=*} == "${1:-}" ]] || exec {fd}<&-
  done
}

# Where the flight's files go; made, with its absolute path in `record`.
make_record() {
  local folder=${TERN_FLY_INSIDE:-$record} name
  name=$(basename "${scenario_file%.yaml}")
  : "${folder:=$TERN_ROOT/flights/$(date -u +%Y%m%dT%H%M%SZ)-$name-${seed:-$(scenario_seed)}}"
  record=''
  mkdir -p "$folder" || die "$folder cannot be made"
  folder=$(readlink -f "$folder")
  [[ ! -e $folder/command ]] || die "$folder holds a flight already"
  record=$folder
}

# For the folder's name only; the processes read the scenario, strictly.
scenario_seed() {
  local line
  line=$(grep -m1 -E '^seed: *[0-9]+' "$scenario_file") || line='seed: 1'
  grep -oE '[0-9]+' <<<"$line" | head -n1
}

# Becomes this script in a network namespace of its own.
enter_namespace() {
  local flags
  flags=$(namespace_flags)
  [[ -n $flags ]] || die "no multicast route on this host (ip route add 224.0.0.0/4 dev lo), and unshare -Urn is refused"
  printf '%s %s\n' "$$" "$flags" >"$record/namespace"
  TERN_FLY_INSIDE=$record exec unshare "$flags" "$0" "${arguments[@]}"
}

choose_network() {
  if [[ -n ${TERN_FLY_INSIDE:-} ]]; then
    { ip link set lo up && ip route add 224.0.0.0/4 dev lo; } || die "no multicast on lo in the flight's namespace"
    isolated=yes
  elif [[ -n $isolated ]] || { [[ -z $url ]] && ! has_multicast_route; }; then
    [[ -n $isolated ]] || say "No multicast route: the flight gets a network namespace of its own."
    enter_namespace
  fi
  [[ -z $url ]] || return 0
  port=$FIRST_PORT
  [[ -n $isolated ]] || lock_port
  url="udpm://$LCM_GROUP:$port?ttl=0"
}

announce() {
  printf "export LCM_DEFAULT_URL='%s'\n" "$url" >"$record/env.sh"
  printf '%q ' "$0" "${arguments[@]}" >"$record/command"
  printf '\n' >>"$record/command"
  say "Flight of $scenario_file"
  say "  record   $record"
  if [[ -n $isolated ]]; then
    say "  network  its own namespace; a shell in it: launch_scripts/enter.sh $record"
  else
    say "  network  export LCM_DEFAULT_URL='$url'"
  fi
  [[ -z $view ]] || say "  view     $TERN_LISTEN_URL"
  [[ -z $key ]] || say "  key      messages are signed"
}

declare -A names=() # of the running children, by pid; each leads a session and process group of its own

# start NAME COMMAND...: with a log file of that name. Ends when this script is gone, however that came.
start() {
  local name=$1
  shift
  printf '%q ' "$@" >>"$record/command"
  printf '\n' >>"$record/command"
  (
    [[ -z ${TERN_LISTEN_FD:-} || $name == "$VIEWER" ]] || exec {TERN_LISTEN_FD}<&-
    close_keys "$name"
    exec setpriv --pdeathsig TERM -- setsid -- "$@" </dev/null
  ) &
  names[$!]=$name
}

# options_for NAME: sets `options` to what every process is given.
options_for() {
  local fd
  options=(--config "$scenario_file" "${settings[@]}" --lcm-url "$url")
  [[ -z $key ]] && return
  fd=$(key_fd "$1")
  options+=(--key-fd "$fd")
}

# start_kept NAME OPTION...: started again when it dies.
start_kept() {
  local name=$1 options
  shift
  options_for "$name"
  start "$name" "$TERN_ROOT/launch_scripts/keep_alive.sh" --log "$record/$name.log" -- "$TERN_BIN/$name" "${options[@]}" "$@"
}

start_all() {
  local name options
  start_kept "$LOGGER" --record "$record/flight.lcm"
  options_for "$MONITOR"
  start "$MONITOR" "$TERN_BIN/$MONITOR" "${options[@]}" --summary "$record/summary.json" \
    --log "$record/flight.lcm" --failure-file "$record/failure" 2>"$record/$MONITOR.log"
  [[ -z $view ]] || start_kept "$VIEWER" --page "$TERN_PAGE" "${viewer_options[@]}"
  for name in "${OTHERS[@]}"; do start_kept "$name"; done
  close_keys
}

# gave_up NAME CODE: a process ended that cannot be started again. Says why, once, and tells the monitor.
gave_up() {
  [[ ! -e $record/failure ]] || return 0
  local why
  why=$(tail -n 1 "$record/$1.log" 2>/dev/null) || why=''
  printf '%s ended with exit code %s: %s\n' "$1" "$2" "$why" >"$record/failure.new"
  mv "$record/failure.new" "$record/failure"
  cat "$record/failure" >&2
}

# Waits for the monitor's judgement; sets `outcome`, the flight's exit code.
watch() {
  local pid code name
  while true; do
    pid='' code=0
    wait -n -p pid "${!names[@]}" || code=$?
    [[ -n $pid ]] || continue
    name=${names[$pid]}
    unset "names[$pid]"
    if [[ $name == "$MONITOR" ]]; then
      outcome=$code
      # Without a summary its exit code is not an outcome.
      [[ -e $record/summary.json ]] && ((code <= EXIT_FAILED)) && return
      outcome=$EXIT_FAILED
      gave_up "$name" "$code"
      return
    fi
    [[ $code == 0 ]] || gave_up "$name" "$code"
  done
}

# await_end TENTHS PID...: whether the groups of these leaders are gone within so many tenths of a second.
await_end() {
  local polls=$(($1 * 4)) poll pid
  shift
  for pid in "$@"; do
    for ((poll = polls; poll > 0; poll--, polls--)); do
      kill -0 -- "-$pid" 2>/dev/null || break
      sleep 0.025
    done
  done
}

# Ends every process, the logger last, so that it hears the others out. Within 2 s, whatever they do.
stop_all() {
  local pid others=() logger=()
  trap '' INT TERM HUP
  trap - EXIT
  for pid in "${!names[@]}"; do
    if [[ ${names[$pid]} == "$LOGGER" ]]; then logger+=("$pid"); else others+=("$pid"); fi
  done
  end_group 10 "${others[@]}"
  end_group 6 "${logger[@]}"
}

end_group() {
  local tenths=$1 pid
  shift
  for pid in "$@"; do kill -TERM "$pid" 2>/dev/null || true; done
  await_end "$tenths" "$@"
  for pid in "$@"; do kill -KILL -- "-$pid" 2>/dev/null || true; done
}

# look_back: what was asked for after the flight, from its log; sets `code`.
look_back() {
  local audited=0
  if [[ -n $audit ]]; then
    "$TERN_BIN/tern-audit" "$record/flight.lcm" --json "$record/audit.json" >"$record/audit.txt" || audited=$?
    say '' && cat "$record/audit.txt"
    case $audited in
      0) ;;
      1) ((code == 1)) || code=$EXIT_BROKEN ;;
      *) code=$EXIT_FAILED ;;
    esac
  fi
  [[ -z $report ]] || { "$TERN_BIN/tern-report" "$record/flight.lcm" -o "$record/report.html" || code=$EXIT_FAILED; }
}

# However this script ends: everything is stopped, and a summary is where it was asked for.
finish() {
  local code=$? written=''
  stop_all
  ((code >= EXIT_FAILED)) || [[ ! -e ${record:-}/flight.lcm ]] || look_back
  ((code < 128)) || say $'\n'"Ended by a signal; what was recorded: ${record:-nothing}"
  if [[ -n $record && -e $record/summary.json ]]; then
    written=$record/summary.json
    [[ -z $summary ]] || cp "$written" "$summary"
  elif [[ $code == "$EXIT_FAILED" ]]; then
    for written in ${record:+"$record/summary.json"} ${summary:+"$summary"}; do
      write_failed_summary "$written" "$(basename "${scenario%.yaml}")" "$seed" "$count" || true
    done
  fi
  exit "$code"
}

arguments=("$@")
parse "$@"
[[ -z $summary ]] || summary=$(realpath -m "$summary")
trap finish EXIT
trap 'exit 130' INT
trap 'exit 143' TERM
trap 'exit 129' HUP
scenario_file=$(find_scenario "$scenario")
if [[ -z ${TERN_FLY_INSIDE:-}${TERN_LISTEN_FD:-}${TERN_KEY_FDS:-} ]]; then
  install_and_build
  [[ -z $view ]] || listen_for_browsers
fi
if [[ -z ${TERN_FLY_INSIDE:-}${TERN_KEY_FDS:-} ]]; then
  # No browser inherits a key.
  [[ -z $view ]] || open_page "$TERN_LISTEN_URL"
  [[ -z $key ]] || take_keys
fi
for program in "$LOGGER" "$MONITOR" "${OTHERS[@]}" ${audit:+tern-audit} ${report:+tern-report}; do
  [[ -x $TERN_BIN/$program ]] || die "$TERN_BIN/$program is not there"
done
make_record
choose_network
announce
outcome=$EXIT_FAILED
export -n TERN_KEY_FDS
start_all
watch
[[ -z $view ]] || say "  see it again: launch_scripts/view.sh --log $record/flight.lcm"
exit "$outcome"
