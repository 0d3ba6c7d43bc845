#!/usr/bin/env bash
# Runs the program tern-NAME alone, by the name NAME.sh under which it is called; the options are the program's own (--help).
set -euo pipefail
# shellcheck source=launch_scripts/lib.sh
source "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/lib.sh"

exec_process "tern-$(basename "$0" .sh)" "$@"
