#!/usr/bin/env bash
# record_golden.sh: flies the golden flights of tests/replay anew, on virtual time, and reports how they differ from the stored
# ones. Commit them if the difference was intended. Environment: TERN_BIN, the folder of the programs.
set -euo pipefail
# shellcheck source=launch_scripts/lib.sh
source "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/lib.sh"

help_if_asked "$@"
[[ $# == 0 ]] || die "takes no options (--help)"
[[ -n $TERN_BIN_GIVEN ]] || "$TERN_ROOT/launch_scripts/build.sh" record_golden tern-replay
golden=$TERN_ROOT/tests/replay/golden
fresh=$(mktemp -d)
trap 'rm -rf "$fresh"' EXIT

say "How this planner answers in the old golden flights:"
for file in "$golden"/*.lcm.xz; do
  [[ -e $file ]] || continue
  old=$fresh/old.lcm
  xz -dc "$file" >"$old"
  say "--- $(basename "$file" .lcm.xz)"
  "$TERN_BIN/tern-replay" "$old" 2>&1 | grep -v '^Promised' | tail -n +2 || true
done

say "The new ones:"
"$TERN_BIN/record_golden" "$fresh/" 2>/dev/null
mkdir -p "$golden"
for log in "$fresh"/*.lcm; do
  name=$(basename "$log" .lcm)
  [[ $name != old ]] || continue
  "$TERN_BIN/tern-replay" "$log" >/dev/null || die "$name does not replay by itself"
  xz -9e "$log"
  if cmp -s "$log.xz" "$golden/$name.lcm.xz"; then
    say "$name: unchanged"
  else
    mv "$log.xz" "$golden/$name.lcm.xz"
    say "$name: renewed"
  fi
done
bytes=$(cat "$golden"/*.lcm.xz | wc -c)
say "$bytes bytes together, at most 1000000"
((bytes <= 1000000))
