#!/usr/bin/env bash
# view_page.sh: builds tern-viewer's page (Vite, three.js, uPlot) if its sources are newer. Needs Node 18 or newer with npm.
# Asks npm's registry only if the lock file has changed.
set -euo pipefail
# shellcheck source=launch_scripts/lib.sh
source "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/lib.sh"

help_if_asked "$@"
web=$TERN_ROOT/viewer/web
exec {lock}<"$web"
flock "$lock"

is_current() {
  [[ -e $TERN_PAGE/index.html ]] || return 1
  local newer
  newer=$(find "$web" -name node_modules -prune -o -type f -newer "$TERN_PAGE/index.html" -print -quit)
  [[ -z $newer ]]
}
! is_current || exit 0

command -v npm >/dev/null || die "no npm; launch_scripts/install.sh launch_scripts/packages_view.txt installs it"
cd "$web"
if ! cmp -s package-lock.json node_modules/.fetched; then
  say "Fetching what the page is built of"
  npm ci --no-audit --no-fund --loglevel=error
  cp package-lock.json node_modules/.fetched
fi
say "Building the page"
rm -rf "$TERN_PAGE.new"
TERN_PAGE_DIR=$TERN_PAGE.new npx vite build --logLevel warn
rm -rf "$TERN_PAGE"
mv "$TERN_PAGE.new" "$TERN_PAGE"
touch "$TERN_PAGE/index.html"
