#!/usr/bin/env bash
# Runs the program tern-NAME alone; NAME.sh is the name under which the script is called. Options are the program's (--help).
set -euo pipefail
# shellcheck source=launch_scripts/lib.sh
source "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/lib.sh"

exec_process "tern-$(basename "$0" .sh)" "$@"
