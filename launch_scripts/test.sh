#!/usr/bin/env bash
# test.sh [CTEST_OPTION...]: installs what is missing, builds everything (release), and runs every test.
set -euo pipefail
# shellcheck source=launch_scripts/lib.sh
source "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/lib.sh"

help_if_asked "$@"
"$TERN_ROOT/launch_scripts/install.sh" "$TERN_ROOT"/launch_scripts/packages*.txt
"$TERN_ROOT/launch_scripts/build.sh" all
exec ctest --test-dir "$TERN_ROOT/build/release" -j2 --output-on-failure --no-tests=error "$@"
