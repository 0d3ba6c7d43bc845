#!/usr/bin/env bash
# enter.sh [RECORD_DIR] [-- COMMAND...]: opens a shell, or runs COMMAND, in the network namespace of a running isolated flight.
# The default is the newest one in flights/. LCM_DEFAULT_URL is set there.
set -euo pipefail
# shellcheck source=launch_scripts/lib.sh
source "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/lib.sh"

help_if_asked "$@"

# running RECORD_DIR: whether its flight runs in a namespace; sets pid and flags. A killed flight leaves its file, and its pid may
# be another process's.
running() {
  [[ -r $1/namespace ]] && read -r pid flags <"$1/namespace" && [[ $(readlink "/proc/$pid/exe") == */tern-launch* ]]
}

record=''
if [[ $# -gt 0 && $1 != -- ]]; then
  record=$1
  shift
  running "$record" || die "$record: no isolated flight is running there"
else
  for folder in "$TERN_FLIGHTS"/*/; do
    if running "$folder"; then record=$folder; fi
  done
  [[ -n $record ]] || die "no isolated flight is running"
  running "$record"
fi
[[ ${1:-} != -- ]] || shift
[[ $# -gt 0 ]] || set -- "${SHELL:-/bin/bash}"

# shellcheck source=/dev/null
source "$record/env.sh"
enter=(--net)
[[ $flags != -Urn ]] || enter=(--user --net --preserve-credentials)
exec nsenter "${enter[@]}" --target "$pid" -- "$@"
