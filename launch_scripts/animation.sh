#!/usr/bin/env bash
# animation.sh [LOG]: makes the README's animation, docs/images/flight.webp, from LOG or from a new flight of the demo.
# Needs Chromium and ffmpeg. Without a GPU a picture takes up to a second.
set -euo pipefail
# shellcheck source=launch_scripts/lib.sh
source "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/lib.sh"

readonly MOST_BYTES=3000000
animation=$TERN_ROOT/docs/images/flight.webp
log=${1:-}
help_if_asked "$@"
[[ $log != -* ]] || { say "animation.sh: no option $log (--help)" >&2 && exit 2; }
"$TERN_ROOT/launch_scripts/view_page.sh"
build_programs tern-viewer
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
if [[ -z $log ]]; then
  "$TERN_ROOT/launch_scripts/fly.sh" --isolated --record "$work/flight"
  log=$work/flight/flight.lcm
fi
"$TERN_BIN/tern-viewer" --page "$TERN_PAGE" --log "$log" --video "$work/flight.webp" --video-size 800 450 --video-rate 14 \
  --video-part -0.2 9
bytes=$(stat -c %s "$work/flight.webp")
((bytes < MOST_BYTES)) || die "$bytes bytes: more than $MOST_BYTES"
mv "$work/flight.webp" "$animation"
say "$animation: $bytes bytes"
