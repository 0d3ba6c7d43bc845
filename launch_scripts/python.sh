#!/usr/bin/env bash
# python.sh [--test | ARGUMENT...]: builds the Python package tern and runs Debian's python3 with it.
#     python.sh                                        an interactive Python
#     python.sh docs/examples/read_a_log.py flights/…  a script
#     python.sh --test                                 the package's tests
# The first build compiles what the package shares with the programs, in build/release, and takes some minutes.
set -euo pipefail
# shellcheck source=launch_scripts/lib.sh
source "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/lib.sh"

help_if_asked "$@"
[[ -z $TERN_INSTALLED ]] || die "an installation has no sources; python3 imports tern if it was installed with it"
target=python
[[ ${1:-} != --test ]] || target=python_tests
"$TERN_ROOT/launch_scripts/install.sh" "$TERN_ROOT"/{launch_scripts,python}/packages.txt >&2
(
  lock_build
  cd "$TERN_ROOT"
  output=$(cmake --preset python 2>&1) || { printf '%s\n' "$output" >&2 && die "cmake could not configure"; }
  cmake --build --preset python --target "$target" >&2
)
[[ ${1:-} != --test ]] || exec ctest --test-dir "$TERN_ROOT/build/release" -L python --output-on-failure --no-tests=error "${@:2}"
export PYTHONPATH="$TERN_ROOT/build/release/python${PYTHONPATH:+:$PYTHONPATH}"
exec /usr/bin/python3 "$@"
