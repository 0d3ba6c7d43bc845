#!/usr/bin/env bash
# fly.sh: one command flies; fly.sh --help. What it starts, and how that ends: launcher/README.md.
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
  --check [FILE|NAME]   do not fly: say and draw what the scenario is, whether its goal can be reached, and what λ buys
  --record DIR          where log, process logs and summary go (default flights/<UTC time>-<scenario>-<seed>)
  --summary FILE        write the summary as JSON there, too
  --lcm-url URL         the LCM network to use (default: this host only, on the first port that no other flight uses)
  --key [FILE]          sign every message: with a new key for this flight, or with that of FILE (mode 600; tern-key new FILE)
  --pace P              so many seconds of flight per second, 0.01 to 1: for a machine that is too slow, or to look closely
  --isolated            fly in a network namespace of its own; enter.sh gives a shell in it
  --view[=ADDRESS]      show the flight in the browser: builds the page (Node 18 or newer), prints its URL and opens it
                        (default 127.0.0.1, on the first free port from 8765)
  --view-wait SECONDS   the flight waits so long for the first page that looks (default 30); when it has ended, the page plays
                        it until Ctrl-C
  --allow-goals         that page may send goals: the vehicle flies from goal to goal until Ctrl-C
  --autopilot URL|sim   the vehicle is an autopilot's, over MAVLink (docs/autopilot.md): udp://127.0.0.1:14540,
                        serial:///dev/ttyACM0:921600; sim: tern-autopilot-sim. It arms, takes off, and lands at the end
  --audit               recompute the flight from its log when it has ended (tern-audit); writes audit.txt and audit.json
  --report              draw the flight when it has ended (tern-report); writes report.html
  --no-install          do not look for missing packages
  --help                this

Exit code: 0 reached, 1 collision, 2 not reached in time, 3 the system itself failed, 4 the audit found something broken in a
flight that did not collide, 128 + n ended by signal n (Ctrl-C: 130). Of --check: 0 the goal can be reached, 1 it cannot.
END
}

typed=$(printf '%q ' "$0" "$@")
typed=${typed% }
scenario=corridor_demo install=$([[ -n $TERN_INSTALLED ]] || echo yes) view='' check='' goals='' url='' isolated='' autopilot=''
flight=("$TERN_BIN/tern-launch" fly --programs="$TERN_BIN") # and its options

# There will be no flight, for this reason: the summary that was asked for says so, too.
on_death() { [[ ! -x ${flight[0]} ]] || "${flight[@]}" --failed="$1" --config="$scenario" || true; }

# parse OPTION...: sets scenario, install, view, url and isolated; the rest becomes options of `flight`.
parse() {
  local option value
  while [[ $# -gt 0 ]]; do
    option=$1
    shift
    case $option in
      --isolated) isolated=yes && continue ;;
      --audit | --report) flight+=("$option") && continue ;;
      --allow-goals)
        goals=yes
        # Before the user's own values, which win.
        flight=("${flight[@]:0:3}" --set=simulator.min_flight_s=100000 --set=timeout_s=1000000 "${flight[@]:3}" "$option")
        continue
        ;;
      --no-install) install='' && continue ;;
      --view) view=127.0.0.1 && continue ;;
      --help | -h) usage && exit 0 ;;
      --check)
        check=yes
        [[ $# -gt 0 && $1 != -* ]] || continue
        option=--scenario value=$1
        shift
        ;;
      --key)
        [[ $# -gt 0 && $1 != -* ]] || { flight+=(--new-key) && continue; }
        value=$1
        shift
        ;;
      --*=*) value=${option#*=} option=${option%%=*} ;;
      --scenario | --seed | --count | --goal | --semantics | --set | --record | --summary | --lcm-url | --pace | --autopilot | --view-wait)
        [[ $# -gt 0 ]] || die "$option needs a value (--help)"
        value=$1
        shift
        ;;
      -*) die "unknown option $option (--help)" ;;
      *) die "what is $option? To fly a scenario: --scenario $option (--help)" ;;
    esac
    [[ -n $value ]] || die "$option: its value is empty (--help)"
    case $option in
      --scenario) scenario=$value ;;
      --view) view=$value ;;
      --lcm-url) url=$value ;;
      --autopilot) autopilot=$value ;;
      --set | --pace | --record | --summary) flight+=("$option=$value") ;;
      --view-wait)
        [[ $value =~ ^[0-9]+$ ]] || die "--view-wait $value: not whole seconds"
        flight+=("--view-wait=$value")
        ;;
      --seed) flight+=("--set=seed=$value") ;;
      --count) flight+=("--set=world.count=$value") ;;
      --goal)
        [[ $value =~ ^[^,]+,[^,]+,[^,]+$ ]] || die "--goal $value: not X,Y,Z"
        flight+=("--set=uav.goal=[$value]")
        ;;
      --semantics)
        [[ $value == on || $value == off ]] || die "--semantics $value: neither on nor off"
        flight+=("--set=semantics.enabled=$([[ $value == on ]] && echo true || echo false)")
        ;;
      --key) flight+=("--key-file=$value") ;;
      *) die "unknown option $option (--help)" ;;
    esac
  done
  [[ -z $goals || -n $view ]] || die "--allow-goals: there is no page that could send them; give --view, too"
}

# Becomes a look at the scenario. What only a flight has is refused.
check_scenario() {
  local setting options=() drawing
  drawing=$(basename "$scenario_file" .yaml).svg
  [[ -z $view$url$isolated$autopilot ]] || die "--check does not fly: --view, --lcm-url, --isolated and --autopilot have no effect on it"
  for setting in "${flight[@]:3}"; do
    case $setting in
      --set=seed=*) options+=(--seed "${setting#--set=seed=}") ;;
      --set=*) options+=(--set "${setting#--set=}") ;;
      *) die "--check does not fly: ${setting%%=*} has no effect on it" ;;
    esac
  done
  exec "$TERN_BIN/tern-campaign" check --world "$scenario_file" --out "$drawing" "${options[@]}"
}

# Sets `url`, and `flags`: those of unshare, if the flight gets a network namespace of its own.
choose_network() {
  flags='' port=$FIRST_PORT
  if [[ -z $isolated$url ]] && ! has_multicast_route; then
    say "No multicast route: the flight gets a network namespace of its own."
    isolated=yes
  fi
  if [[ -n $isolated ]]; then
    flags=$(namespace_flags)
    [[ -n $flags ]] || die "no multicast route on this host (ip route add 224.0.0.0/4 dev lo), and unshare -Urn is refused"
  elif [[ -z $url ]]; then
    lock_port
  fi
  : "${url:=udpm://$LCM_GROUP:$port?ttl=0}"
}

parse "$@"
scenario_file=$(find_scenario "$scenario")
lists=("$TERN_ROOT/launch_scripts/packages.txt" ${view:+"$TERN_ROOT/launch_scripts/packages_view.txt"})
[[ -z $install ]] || "$TERN_ROOT/launch_scripts/install.sh" "${lists[@]}" || die "the packages could not be installed"
build_programs || die "the programs could not be built"
[[ -z $check ]] || check_scenario
[[ -z $view || -n $TERN_INSTALLED ]] || "$TERN_ROOT/launch_scripts/view_page.sh" || die "the page could not be built"
[[ -x ${flight[0]} ]] || die "${flight[0]} is not there"
choose_network
[[ -z $flags || $autopilot != udp* ]] ||
  say "This flight has a network of its own: start the autopilot in it (enter.sh), or give the host a multicast route and fly without --isolated."
[[ $autopilot != sim ]] || { autopilot=udp://127.0.0.1:$((port + 14540 - FIRST_PORT)) && flight+=(--autopilot-sim); }
flight+=(${autopilot:+--autopilot="$autopilot"})
flight+=(--config="$scenario_file" --lcm-url="$url" ${flags:+--namespace="$flags"} --flights="$TERN_FLIGHTS" --typed="$typed")

# Programs that become the next one, the outermost last. The page's socket is opened outside the namespace: browsers reach it.
# shellcheck disable=SC2016  # the inner shells expand it
{
  [[ -z $flags ]] || flight=(unshare "$flags" sh -c "$MULTICAST_ON_LO"' && exec "$0" "$@"' "${flight[@]}")
  [[ -z $view ]] || flight=("$TERN_BIN/tern-listen" "$view" bash -c 'source "$0"; open_page "$TERN_LISTEN_URL"
    exec "$@" --page="$TERN_PAGE" --view-fd="$TERN_LISTEN_FD" --view-url="$TERN_LISTEN_URL"' "$TERN_ROOT/launch_scripts/lib.sh" "${flight[@]}")
}
exec "${flight[@]}"
