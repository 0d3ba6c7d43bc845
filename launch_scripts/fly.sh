#!/usr/bin/env bash
# fly.sh: one command flies; fly.sh --help. The processes that it starts, and their end: launcher/README.md.
set -euo pipefail
# shellcheck source=launch_scripts/lib.sh
source "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/lib.sh"

typed=$(printf '%q ' "$0" "$@")
typed=${typed% }
scenario=corridor_demo install=$([[ -n $TERN_INSTALLED ]] || echo yes) view='' check='' goals=() url='' isolated='' autopilot='' mission=''
flight=("$TERN_BIN/tern-launch" fly --programs="$TERN_BIN") # and its options
programs=(flight)                                           # CMake targets to build; `flight` is needed by every flight

# on_death REASON: writes the requested summary of a flight that cannot begin.
on_death() { [[ ! -x ${flight[0]} ]] || "${flight[@]}" --failed="$1" --config="$scenario" || true; }

# parse OPTION...: sets scenario, install, view, url and isolated, and adds to programs; the rest becomes options of `flight`.
parse() {
  local option value
  while [[ $# -gt 0 ]]; do
    option=$1
    shift
    case $option in
      --isolated) isolated=yes && continue ;;
      --audit | --report) flight+=("$option") && programs+=("tern-${option#--}") && continue ;;
      --allow-goals) goals=(--set=simulator.min_flight_s=100000 --set=timeout_s=1000000 --allow-goals) && continue ;;
      --no-install) install='' && continue ;;
      --view) view=127.0.0.1 && continue ;;
      --help | -h) cat "$TERN_ROOT/launch_scripts/fly.txt" && exit 0 ;;
      --check)
        check=yes
        [[ $# -gt 0 && $1 != -* ]] || continue
        option=--scenario value=$1
        shift
        ;;
      --key)
        programs+=(tern-key)
        [[ $# -gt 0 && $1 != -* ]] || { flight+=(--new-key) && continue; }
        value=$1
        shift
        ;;
      --*=*) value=${option#*=} option=${option%%=*} ;;
      --scenario | --seed | --count | --goal | --semantics | --set | --record | --summary | --lcm-url | --pace | --autopilot | --odometry | --mission | --view-wait)
        [[ $# -gt 0 ]] || die "$option needs a value (--help)"
        value=$1
        shift
        ;;
      -*) die "unknown option $option (--help)" ;;
      *) die "unexpected argument $option; to fly a scenario use --scenario $option (--help)" ;;
    esac
    [[ -n $value ]] || die "$option: its value is empty (--help)"
    case $option in
      --scenario) scenario=$value ;;
      --view) view=$value ;;
      --lcm-url) url=$value ;;
      --autopilot) autopilot=$value ;;
      --mission) mission=$value ;;
      --set | --pace | --record | --summary | --odometry) flight+=("$option=$value") ;;
      --view-wait)
        [[ $value =~ ^[0-9]+$ ]] || die "--view-wait $value: must be whole seconds"
        flight+=("--view-wait=$value")
        ;;
      --seed) flight+=("--set=seed=$value") ;;
      --count) flight+=("--set=world.count=$value") ;;
      --goal)
        [[ $value =~ ^[^,]+,[^,]+,[^,]+$ ]] || die "--goal $value: must be X,Y,Z"
        flight+=("--set=uav.goal=[$value]")
        ;;
      --semantics)
        [[ $value == on || $value == off ]] || die "--semantics $value: must be on or off"
        flight+=("--set=semantics.enabled=$([[ $value == on ]] && echo true || echo false)")
        ;;
      --key) flight+=("--key-file=$value") ;;
      *) die "unknown option $option (--help)" ;;
    esac
  done
  [[ ${#goals[@]} == 0 || -n $view ]] || die "--allow-goals needs a page that sends goals; add --view"
  flight=("${flight[@]:0:3}" "${goals[@]}" "${flight[@]:3}") # before the user's own values, which win
}

# gives SECTION: whether scenario or settings may hold this section. Then its process checks it, even if it does not fly.
gives() { grep -q "$1" "$scenario_file" || [[ ${flight[*]} == *" --set=$1"* ]]; }

# flies_on_estimate: whether scenario or settings ask for tern-estimator.
flies_on_estimate() {
  [[ ${flight[*]} == *"simulator.estimation=vio"* ]] || grep -Eq '\bestimation: *"?vio' "$scenario_file"
}

# Adds the remaining programs.
choose_programs() {
  if [[ -n $check ]]; then
    programs=(tern-campaign)
    return
  fi
  [[ -z $view ]] || programs+=(tern-viewer tern-listen)
  ! gives detector || programs+=(tern-detector)
  ! gives estimator && ! flies_on_estimate || programs+=(tern-estimator)
  [[ -z $autopilot ]] && ! gives mavlink || programs+=(tern-mavlink)
  [[ -z $mission ]] && ! gives mission || programs+=(tern-mission)
  [[ $autopilot != sim ]] && ! gives autopilot_sim || programs+=(tern-autopilot-sim)
}

# Becomes tern-campaign check. Options that only a flight has are refused.
check_scenario() {
  local setting options=() drawing
  drawing=$(basename "$scenario_file" .yaml).svg
  [[ -z $view$url$isolated$autopilot$mission ]] || die "--check does not fly: --view, --lcm-url, --isolated, --autopilot and --mission have no effect on it"
  for setting in "${flight[@]:3}"; do
    case $setting in
      --set=seed=*) options+=(--seed "${setting#--set=seed=}") ;;
      --set=*) options+=(--set "${setting#--set=}") ;;
      *) die "--check does not fly: ${setting%%=*} has no effect on it" ;;
    esac
  done
  exec "$TERN_BIN/tern-campaign" check --world "$scenario_file" --out "$drawing" "${options[@]}"
}

parse "$@"
scenario_file=$(find_scenario "$scenario")
[[ -z $mission || $mission == *://* || -f $mission ]] || die "--mission $mission: no such file"
[[ -z $mission || $mission == *://* ]] || mission=$(readlink -f "$mission")
flight+=(${mission:+--mission="$mission"})
lists=("$TERN_ROOT/launch_scripts/packages.txt" ${view:+"$TERN_ROOT/launch_scripts/packages_view.txt"} ${mission:+"$TERN_ROOT/launch_scripts/packages_mission.txt"})
[[ -z $install ]] || "$TERN_ROOT/launch_scripts/install.sh" "${lists[@]}" || die "the packages could not be installed"
choose_programs
build_programs "${programs[@]}" || die "the programs could not be built"
[[ -z $check ]] || check_scenario
[[ -z $view || -n $TERN_INSTALLED ]] || "$TERN_ROOT/launch_scripts/view_page.sh" || die "the page could not be built"
[[ -x ${flight[0]} ]] || die "${flight[0]} does not exist; build it with launch_scripts/build.sh, or correct TERN_BIN"
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
