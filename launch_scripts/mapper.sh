#!/usr/bin/env bash
# mapper.sh [OPTION...]: runs tern-mapper alone; the options are its own (--help lists them).
set -euo pipefail
# shellcheck source=launch_scripts/lib.sh
source "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/lib.sh"

exec_process tern-mapper "$@"
