# Functions that the launch scripts share. Sourced, never run.
# shellcheck shell=bash

TERN_ROOT=$(dirname "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")")
readonly TERN_ROOT
# What `cmake --install` has put into share/tern has no sources: programs and page are beside it, nothing is built or fetched.
if [[ -e $TERN_ROOT/CMakeLists.txt ]]; then
  # shellcheck disable=SC2034  # for the scripts that source this
  TERN_INSTALLED='' TERN_MADE=$TERN_ROOT/build TERN_FLIGHTS=$TERN_ROOT/flights
else
  TERN_INSTALLED=yes TERN_MADE=${XDG_CACHE_HOME:-$HOME/.cache}/tern TERN_FLIGHTS=$PWD/flights
  : "${TERN_BIN:=$(readlink -m "$TERN_ROOT/../../bin")}" "${TERN_PAGE:=$TERN_ROOT/viewer-page}"
fi
# shellcheck disable=SC2034  # the same
readonly TERN_INSTALLED TERN_MADE TERN_FLIGHTS
# Where the programs are. Set in the environment: they are taken from there, and nothing is built.
TERN_BIN_GIVEN=${TERN_BIN:+yes}
TERN_BIN=${TERN_BIN:-$TERN_ROOT/build/release/bin}
readonly TERN_BIN TERN_BIN_GIVEN
# The built page of tern-viewer.
readonly TERN_PAGE=${TERN_PAGE:-$TERN_ROOT/build/viewer-page}

readonly FIRST_PORT=7667
readonly LAST_PORT=7766
readonly LCM_GROUP=239.255.76.67
readonly MULTICAST_ON_LO="ip link set lo up && ip route add 224.0.0.0/4 dev lo"

say() { printf '%s\n' "$*"; }

# die TEXT: ends the script with exit code 3: the system itself failed. Calls on_death TEXT before, where a script has one.
die() {
  printf '%s: %s\n' "$(basename "$0")" "$*" >&2
  if declare -F on_death >/dev/null; then on_death "$*"; fi
  exit 3
}

# help_if_asked OPTION...: prints the comment at the head of the script and ends it, if the first option is --help.
help_if_asked() {
  [[ ${1:-} == --help || ${1:-} == -h ]] || return 0
  sed -n '2,/^[^#]/s/^# //p' "$0"
  exit 0
}

# Builds the programs unless the environment says where they are. The first time it says how long that takes and shows
# ninja's progress. Later it shows one line, gone when it is done, and what fails.
build_programs() {
  [[ -z $TERN_BIN_GIVEN ]] || return 0
  local cores said failed=''
  if [[ ! -e $TERN_BIN/tern-launch ]]; then
    cores=$(nproc)
    say "Building Tern's programs, this once: up to $(((10 + cores - 1) / cores)) minutes on $cores cores. Later only what has changed."
    "$TERN_ROOT/launch_scripts/build.sh"
    return
  fi
  [[ ! -t 2 ]] || printf 'Building what has changed …' >&2
  said=$("$TERN_ROOT/launch_scripts/build.sh" 2>&1) || failed=yes
  [[ ! -t 2 ]] || printf '\r\033[K' >&2
  [[ -z $failed ]] || { printf '%s\n' "$said" >&2 && return 1; }
}

# exec_process NAME ARG...: becomes the program, which is built first if it is not there.
exec_process() {
  local name=$1
  shift
  [[ -x $TERN_BIN/$name ]] || build_programs >&2
  [[ -x $TERN_BIN/$name ]] || die "$TERN_BIN/$name is not there"
  exec "$TERN_BIN/$name" "$@"
}

# find_scenario FILE_OR_NAME: prints the file's path.
find_scenario() {
  local wanted=$1 file
  for file in "$wanted" "$TERN_ROOT/scenarios/$wanted.yaml" "$TERN_ROOT/scenarios/$wanted"; do
    if [[ -f $file ]]; then
      readlink -f "$file"
      return
    fi
  done
  local names
  names=$(cd "$TERN_ROOT/scenarios" 2>/dev/null && printf '%s ' *.yaml)
  die "no scenario $wanted; there are: ${names//.yaml/}"
}

# What a plain user or root may make a network namespace with: prints unshare's flags, or nothing.
namespace_flags() {
  local flags
  for flags in -Urn -n; do
    if unshare "$flags" sh -c "$MULTICAST_ON_LO" 2>/dev/null; then
      printf '%s' "$flags"
      return
    fi
  done
}

has_multicast_route() { ip -4 route get "$LCM_GROUP" >/dev/null 2>&1; }

# lock_port: sets `port` to the first one that no other flight holds, and holds it by a lock on an open descriptor. This
# shell's children inherit it, so the port is free again when the last of them has ended.
lock_port() {
  local file
  for ((port = FIRST_PORT; port <= LAST_PORT; port++)); do
    file=/tmp/tern-lcm-port-$port.lock
    # Opened for reading only, and never created through an existing name: the file may be another user's.
    [[ -e $file ]] || (set -o noclobber && umask 022 && : >"$file") 2>/dev/null || true
    { exec {port_lock}<"$file"; } 2>/dev/null || continue
    flock --nonblock "$port_lock" && return
    exec {port_lock}<&-
  done
  die "all ports from $FIRST_PORT to $LAST_PORT are taken by flights"
}

# open_page URL: in the user's browser, where there is a display. The browser is no child of this script.
open_page() {
  [[ -n ${DISPLAY:-}${WAYLAND_DISPLAY:-} ]] && command -v xdg-open >/dev/null || return 0
  (setsid xdg-open "$1" </dev/null >/dev/null 2>&1 &)
}
