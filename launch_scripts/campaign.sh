#!/usr/bin/env bash
# campaign.sh [OPTION...]: runs tern-campaign; the options are its own (--help lists them).
set -euo pipefail
# shellcheck source=launch_scripts/lib.sh
source "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/lib.sh"

exec_process tern-campaign "$@"
