#!/usr/bin/env bash
# build.sh [TARGET...]: configures and builds the release preset with Ninja; by default every program (build/release/bin).
set -euo pipefail
# shellcheck source=launch_scripts/lib.sh
source "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/lib.sh"

help_if_asked "$@"
lock_build
configure_build || die "cmake could not configure"
exec cmake --build --preset release --target "${@:-apps}"
