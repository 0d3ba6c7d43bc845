# Functions that the launch scripts share. Sourced, never run.
# shellcheck shell=bash

TERN_ROOT=$(dirname "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")")
readonly TERN_ROOT
# An installation (share/tern of `cmake --install`) has no sources: programs and page exist, and neither is built.
if [[ -e $TERN_ROOT/CMakeLists.txt ]]; then
  # shellcheck disable=SC2034  # for the scripts that source this
  TERN_INSTALLED='' TERN_MADE=$TERN_ROOT/build TERN_FLIGHTS=$TERN_ROOT/flights
else
  TERN_INSTALLED=yes TERN_MADE=${XDG_CACHE_HOME:-$HOME/.cache}/tern TERN_FLIGHTS=$PWD/flights
  : "${TERN_BIN:=$(readlink -m "$TERN_ROOT/../../bin")}" "${TERN_PAGE:=$TERN_ROOT/viewer-page}"
fi
# shellcheck disable=SC2034  # the same
readonly TERN_INSTALLED TERN_MADE TERN_FLIGHTS
# The folder of the programs. If the environment gives it, nothing is built.
TERN_BIN_GIVEN=${TERN_BIN:+yes}
TERN_BIN=${TERN_BIN:-$TERN_ROOT/build/release/bin}
readonly TERN_BIN TERN_BIN_GIVEN
# The built page of tern-viewer.
readonly TERN_PAGE=${TERN_PAGE:-$TERN_ROOT/build/viewer-page}

readonly MANY_STEPS=20 # but for links, of a build that shows its progress
readonly FEW_STEPS=10  # after which the remaining time is shown
readonly FIRST_PORT=7667
readonly LAST_PORT=7766
readonly LCM_GROUP=239.255.76.67
readonly MULTICAST_ON_LO="ip link set lo up && ip route add 224.0.0.0/4 dev lo"

say() { printf '%s\n' "$*"; }

# die TEXT: ends the script with exit code 3 (the system failed). First calls on_death TEXT, if the script defines it.
die() {
  printf '%s: %s\n' "$(basename "$0")" "$*" >&2
  if declare -F on_death >/dev/null; then on_death "$*"; fi
  exit 3
}

# help_if_asked OPTION...: if the first option is --help, prints the comment at the head of the script and ends it.
help_if_asked() {
  [[ ${1:-} == --help || ${1:-} == -h ]] || return 0
  sed -n '2,/^[^#]/s/^# //p' "$0"
  exit 0
}

# lock_build: holds the lock of this tree's builds until the (sub)shell and its children have ended.
lock_build() {
  local lock
  mkdir -p "$TERN_ROOT/build"
  exec {lock}<"$TERN_ROOT/build"
  flock --nonblock "$lock" || { say 'Another build is running, waiting …' >&2 && flock "$lock"; }
}

# configure_build: enters the tree and configures the release preset; prints only errors.
configure_build() {
  local output
  cd "$TERN_ROOT" || return 1
  output=$(cmake --preset release 2>&1) || { printf '%s\n' "$output" >&2 && return 1; }
}

# time_left DONE ALL SECONDS: prints the remaining time of a build that took SECONDS for DONE of its ALL steps.
time_left() {
  local left=$(($3 * ($2 - $1) / $1))
  ((left < 60)) && printf 'less than 1 min left' || printf '%d min left' $(((left + 30) / 60))
}

# show_progress: prints ninja's lines from standard input. Each step's line has the remaining time, estimated from the steps that
# are done. A terminal shows the newest step only, and the compiler's messages.
show_progress() {
  local line text began=$SECONDS clear='' width=80
  [[ ! -t 1 ]] || { clear=$'\r\033[K' && width=$(tput cols 2>/dev/null || echo 80); }
  while IFS= read -r line; do
    text=$line
    if [[ $line =~ ^\[([0-9]+)/([0-9]+)\]\ (.*) ]]; then
      if ((BASH_REMATCH[1] > FEW_STEPS && BASH_REMATCH[1] < BASH_REMATCH[2])); then
        text="[${BASH_REMATCH[1]}/${BASH_REMATCH[2]}] $(time_left "${BASH_REMATCH[@]:1:2}" $((SECONDS - began))): ${BASH_REMATCH[3]}"
      fi
      [[ -z $clear ]] || { printf '%s%s' "$clear" "${text:0:width-1}" && continue; }
    fi
    printf '%s%s\n' "$clear" "$text"
  done
  printf '%s' "$clear"
}

# build_programs [TARGET...]: builds the targets (default: every program) unless the environment gives TERN_BIN. If much is left
# to do, it shows each step and the remaining time. Otherwise it shows one line, which disappears at the end, and errors. A
# subshell, with which the lock ends.
build_programs() (
  [[ -z $TERN_BIN_GIVEN ]] || exit 0
  lock_build
  build=(cmake --build --preset release --target "${@:-apps}") failed=''
  [[ ! -t 2 ]] || printf 'Building what has changed …' >&2
  configure_build || exit 1
  left=$("${build[@]}" -- -n 2>/dev/null)
  steps=$(wc -l <<<"$left")
  # ninja -n counts every program as one to link again: it cannot know that the version, which is always checked, is unchanged.
  long=$(grep -cv 'Linking ' <<<"$left" || true)
  ((long > MANY_STEPS)) || output=$("${build[@]}" 2>&1) || failed=yes
  [[ ! -t 2 ]] || printf '\r\033[K' >&2
  [[ -z $failed ]] || { printf '%s\n' "$output" >&2 && exit 1; }
  ((long > MANY_STEPS)) || exit 0
  set -o pipefail
  say "Building Tern's programs, $steps steps. Later only what has changed."
  "${build[@]}" 2>&1 | show_progress
)

# exec_process NAME ARG...: becomes the program; if it is missing, it is built first.
exec_process() {
  local name=$1
  shift
  [[ -x $TERN_BIN/$name ]] || build_programs "$name" >&2
  [[ -x $TERN_BIN/$name ]] || die "$TERN_BIN/$name does not exist; build it with launch_scripts/build.sh, or correct TERN_BIN"
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

# namespace_flags: prints the flags of unshare with which this user can make a network namespace, or nothing.
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

# lock_port: sets `port` to the first one that no other flight holds, and locks it by an open descriptor. This shell's children
# inherit the descriptor, so the port is free when the last of them has ended.
lock_port() {
  local file
  for ((port = FIRST_PORT; port <= LAST_PORT; port++)); do
    file=/tmp/tern-lcm-port-$port.lock
    # Opened for reading only, and created only if the name is free: the file may belong to another user.
    [[ -e $file ]] || (set -o noclobber && umask 022 && : >"$file") 2>/dev/null || true
    { exec {port_lock}<"$file"; } 2>/dev/null || continue
    flock --nonblock "$port_lock" && return
    exec {port_lock}<&-
  done
  die "all ports from $FIRST_PORT to $LAST_PORT are used by flights; end one of them"
}

# choose_network: sets `port`, and `url` unless it is given. Sets `flags` to unshare's if the flight gets a network namespace of
# its own, which `isolated` or a missing multicast route demands.
choose_network() {
  flags='' port=$FIRST_PORT
  if [[ -z $isolated$url ]] && ! has_multicast_route; then
    say "No multicast route: the flight gets a network namespace of its own."
    isolated=yes
  fi
  if [[ -n $isolated ]]; then
    flags=$(namespace_flags)
    [[ -n $flags ]] || die "no multicast route on this host (ip route add 224.0.0.0/4 dev lo), and unshare -Urn is refused"
  elif [[ -z $url ]]; then
    lock_port
  fi
  : "${url:=udpm://$LCM_GROUP:$port?ttl=0}"
}

# open_page URL: opens it in the user's browser if there is a display. The browser is not a child of this script, and gets none
# of its descriptors: it may outlive the flight, which holds its port and the page's socket by them.
open_page() {
  [[ -n ${DISPLAY:-}${WAYLAND_DISPLAY:-} ]] && command -v xdg-open >/dev/null || return 0
  (
    for fd in /proc/"$BASHPID"/fd/*; do
      fd=${fd##*/}
      ((fd <= 2)) || exec {fd}>&-
    done
    setsid xdg-open "$1" </dev/null >/dev/null 2>&1 &
  )
}
