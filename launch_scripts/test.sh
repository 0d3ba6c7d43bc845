#!/usr/bin/env bash
# test.sh [--all | --no-flights] [CTEST_OPTION...]: installs missing packages, builds everything (release), and runs the tests.
#     --all         also the tests with the label soak: more cases and more live flights, which take much longer
#     --no-flights  without the live flights
set -euo pipefail
# shellcheck source=launch_scripts/lib.sh
source "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/lib.sh"

help_if_asked "$@"
without=(-LE soak)
case ${1:-} in
  --all) without=() && shift ;;
  --no-flights) without=(-LE 'soak|live') && shift ;;
esac
"$TERN_ROOT/launch_scripts/install.sh" "$TERN_ROOT"/launch_scripts/packages*.txt
"$TERN_ROOT/launch_scripts/build.sh" all
# One more than there are cores: a live flight has time to spare on its core.
exec ctest --test-dir "$TERN_ROOT/build/release" -j"$(($(nproc) + 1))" --output-on-failure --no-tests=error "${without[@]}" "$@"
