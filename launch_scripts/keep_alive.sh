#!/usr/bin/env bash
# keep_alive.sh [--log FILE] [--] COMMAND [ARG...]: runs COMMAND, and restarts it when it dies (launcher/README.md).
set -euo pipefail
# shellcheck source=launch_scripts/lib.sh
source "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/lib.sh"

exec_process tern-launch keep "$@"
