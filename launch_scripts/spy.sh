#!/usr/bin/env bash
# spy.sh: every channel of a flight in LCM's own lcm-spy; spy.sh --help.
set -euo pipefail
# shellcheck source=launch_scripts/lib.sh
source "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/lib.sh"

usage() {
  cat <<'END'
spy.sh [OPTION...] [RECORD_DIR]: builds a jar of Tern's message types if they have changed, and starts lcm-spy with it.

  RECORD_DIR    folder of a running flight, whose network is used, isolated or not
                (default: LCM_DEFAULT_URL, else LCM's own default, as for processes started by hand)
  --types       only builds the jar and prints its path; Java programs decode every message with it
  --no-install  does not look for missing packages (packages_spy.txt)
  --help        prints this text
END
}

readonly LCM_JAR=/usr/share/java/lcm.jar
readonly TYPES_JAR=${TERN_TYPES_JAR:-$TERN_MADE/tern_types.jar}

# Builds the jar unless it is newer than every message definition. A subshell, with which lock and folder are released.
build_types() (
  local lock
  exec {lock}<"$TERN_ROOT/lcmtypes"
  flock "$lock"
  [[ -z $(find "$TERN_ROOT/lcmtypes" -name '*.lcm' -newer "$TYPES_JAR" -print -quit 2>&1) ]] && exit 0
  [[ -e $LCM_JAR ]] || die "no $LCM_JAR; launch_scripts/install.sh launch_scripts/packages_spy.txt installs it"
  mkdir -p "$(dirname "$TYPES_JAR")"
  folder=$(mktemp -d "$TYPES_JAR.XXXXXX")
  trap 'rm -rf "$folder"' EXIT
  lcm-gen --java --jpath "$folder/sources" "$TERN_ROOT"/lcmtypes/*.lcm
  javac -nowarn -classpath "$LCM_JAR" -d "$folder/classes" "$folder"/sources/tern_msgs/*.java
  jar --create --file "$folder/types.jar" -C "$folder/classes" tern_msgs
  mv "$folder/types.jar" "$TYPES_JAR"
)

# take_network RECORD_DIR: uses the network of that flight. For an isolated one this process becomes one inside it.
take_network() {
  local record=$1
  [[ -r $record/env.sh ]] || die "$record is not the folder of a flight"
  if [[ -r $record/namespace && -z ${TERN_SPY_INSIDE:-} ]]; then
    TERN_SPY_INSIDE=yes exec "$TERN_ROOT/launch_scripts/enter.sh" "$record" -- "$0" --no-install "$record"
  fi
  # shellcheck source=/dev/null
  source "$record/env.sh"
}

install=$([[ -n $TERN_INSTALLED ]] || echo yes) types_only='' record=''
for argument; do
  case $argument in
    --types) types_only=yes ;;
    --no-install) install='' ;;
    --help | -h) usage && exit 0 ;;
    -*) die "unknown option $argument (--help)" ;;
    *)
      [[ -z $record ]] || die "two flights: $record, $argument (--help)"
      record=$argument
      ;;
  esac
done
[[ -z $install ]] || "$TERN_ROOT/launch_scripts/install.sh" "$TERN_ROOT/launch_scripts/packages_spy.txt" ||
  die "the packages could not be installed"
build_types
if [[ -n $types_only ]]; then
  say "$TYPES_JAR"
  exit 0
fi
[[ -z $record ]] || take_network "$record"
command -v lcm-spy >/dev/null || die "no lcm-spy; launch_scripts/install.sh launch_scripts/packages_spy.txt installs it"
[[ -n ${DISPLAY:-} ]] || die "lcm-spy needs a display, and DISPLAY is not set (over SSH: ssh -X)"

# lcm-spy's script passes an option that newer Java lacks and would fail on. lcm-spy finds message types by CLASSPATH.
export JAVA_TOOL_OPTIONS="-XX:+IgnoreUnrecognizedVMOptions ${JAVA_TOOL_OPTIONS:-}"
export CLASSPATH=$TYPES_JAR${CLASSPATH:+:$CLASSPATH}
exec lcm-spy
