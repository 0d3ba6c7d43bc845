# What the benchmark scripts share. Sourced, never run.
# shellcheck shell=bash

ROOT=$(dirname "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")")
readonly ROOT
BUILD=${BUILD:-$ROOT/build/release}
readonly BUILD

# build TARGET...: in a release build with benchmarks.
build() {
  cmake -S "$ROOT" -B "$BUILD" -G Ninja -DCMAKE_BUILD_TYPE=Release -DTERN_BUILD_BENCHMARKS=ON >/dev/null
  ninja -C "$BUILD" "$@" >&2
}

commit() { git -C "$ROOT" describe --always --dirty 2>/dev/null || echo unknown; }
compiler() { "$(sed -n 's/^CMAKE_CXX_COMPILER:[A-Z]*=//p' "$BUILD/CMakeCache.txt")" --version | head -n 1; }
machine() { printf '%s, %s cores\n' "$(sed -n 's/^model name[^:]*: //p' /proc/cpuinfo | head -n 1)" "$(nproc)"; }
