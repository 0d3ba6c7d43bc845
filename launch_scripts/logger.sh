#!/usr/bin/env bash
# logger.sh [OPTION...]: runs tern-logger alone; the options are its own (--help lists them).
set -euo pipefail
# shellcheck source=launch_scripts/lib.sh
source "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/lib.sh"

exec_process tern-logger "$@"
