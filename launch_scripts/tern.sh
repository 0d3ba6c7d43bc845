#!/usr/bin/env bash
# tern COMMAND [OPTION...]: Tern's scripts and programs under one name.
set -euo pipefail
# shellcheck source=launch_scripts/lib.sh
source "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/lib.sh"

if [[ $# == 0 || $1 == --help || $1 == -h ]]; then
  cat <<'TEXT'
tern COMMAND [OPTION...]: Tern's scripts and programs under one name.

Commands:
  fly         flies a scenario, simulated or with an autopilot, and sums it up
  check       describes and draws a scenario without flying it
  view        shows a flight or a log in the browser
  campaign    flies many seeds on virtual time
  spy, enter  LCM's spy; a shell in the network of an isolated flight
  NAME        any other program tern-NAME: audit, report, replay, export, key, planner

tern COMMAND --help lists the options of a command.
TEXT
  exit 0
fi
command=$1
shift
case $command in
  --version) exec_process tern-launch --version ;;
  check) exec "$TERN_ROOT/launch_scripts/fly.sh" --check "$@" ;;
  fly | view | campaign | spy | enter) exec "$TERN_ROOT/launch_scripts/$command.sh" "$@" ;;
esac
[[ $command =~ ^[a-z][a-z0-9-]*$ ]] || die "$command is no command (tern --help)"
[[ -z $TERN_INSTALLED || -x $TERN_BIN/tern-$command ]] || die "there is no program tern-$command (tern --help)"
exec_process "tern-$command" "$@"
