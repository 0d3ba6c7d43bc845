#!/usr/bin/env bash
# arm64.sh WORK [TARGET...]: builds Tern for arm64 on an amd64 machine, and flies one scenario on virtual time by both builds.
# The rows of the two flights must be the same bytes. Build both from the same commit, since a row ends in its name.
#
# WORK gets the libraries of arm64 (a folder, not installed) and the build. Needs, as root: mmdebstrap, g++-aarch64-linux-gnu,
# qemu-user-static, and a release build of tern-campaign for this machine. The default target is tern-campaign.
set -euo pipefail
[[ $# -ge 1 && $1 != --help ]] || { sed -n '2,/^[^#]/s/^# \{0,1\}//p' "$0"; exit 0; }
work=$(readlink -m "$1")
shift
[[ $# -gt 0 ]] || set -- tern-campaign
root=$(dirname "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")")
release=$(sed -n 's/^VERSION_CODENAME=//p' /etc/os-release)
mkdir -p "$work"
export TERN_SYSROOT=$work/sysroot

if [[ ! -e $TERN_SYSROOT/.made ]]; then
  libraries=$(sed -n '/^# Libraries/,/^# Tests/s/^\(lib[a-z0-9.-]*-dev\|coinor-[a-z-]*\|nlohmann-json3-dev\).*/\1/p' "$root/launch_scripts/packages.txt")
  mmdebstrap --architectures=arm64 --variant=extract --include="g++ ${libraries//$'\n'/ }" "$release" "$TERN_SYSROOT"
  # Absolute links lead out of the folder.
  find "$TERN_SYSROOT/usr/lib" -type l -lname '/*' | while read -r link; do
    ln -snf "$(realpath -m --relative-to="$(dirname "$link")" "$TERN_SYSROOT$(readlink "$link")")" "$link"
  done
  for library in blas lapack; do
    for name in "lib$library.so.3" "lib$library.so"; do
      ln -sf "$library/lib$library.so.3" "$TERN_SYSROOT/usr/lib/aarch64-linux-gnu/$name"
    done
  done
  touch "$TERN_SYSROOT/.made"
fi

cmake -S "$root" -B "$work/build" -G Ninja -DCMAKE_BUILD_TYPE=Release -DTERN_BUILD_TESTS=OFF \
  -DCMAKE_TOOLCHAIN_FILE="$root/cmake/arm64.cmake"
cmake --build "$work/build" --target "$@"
[[ $* == *tern-campaign* ]] || exit 0

# fly NAME COMMAND...: flies, and keeps the flight's row of CSV. The row after it has the CPU times.
fly() {
  local name=$1
  shift
  rm -rf "${work:?}/$name"
  "$@" fly-one --world "$root/scenarios/window.yaml" --seed 1 --charge counts --folder "$work/$name" >"$work/$name.rows"
  head -n 1 "$work/$name.rows" >"$work/$name.csv"
}
fly amd64 "$root/build/release/bin/tern-campaign"
fly arm64 qemu-aarch64-static -L "$TERN_SYSROOT" "$work/build/bin/tern-campaign"
cmp "$work/amd64.csv" "$work/arm64.csv"
echo "arm64 flies as amd64: $(wc -c <"$work/arm64.csv") equal bytes"
