#!/usr/bin/env bash
# view.sh [OPTION...]: builds tern-viewer's page if needed, runs tern-viewer, and opens the page where there is a display.
# The options are tern-viewer's own (--help lists them). To play a recorded flight: --log flights/FOLDER/flight.lcm.
set -euo pipefail
# shellcheck source=launch_scripts/lib.sh
source "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/lib.sh"

case " $* " in *" --help "* | *" --version "*) exec_process tern-viewer "$@" ;; esac
[[ -n $TERN_INSTALLED ]] || "$TERN_ROOT/launch_scripts/view_page.sh"
# With --export or --video no page is opened.
case " $* " in *" --export"[\ =]* | *" --video"[\ =]*) exec_process tern-viewer --page "$TERN_PAGE" "$@" ;; esac
url_pipe=$(mktemp -u)
mkfifo "$url_pipe"
{
  read -rt 120 url <>"$url_pipe" || true
  rm "$url_pipe"
  [[ -z $url ]] || open_page "$url"
} &
exec_process tern-viewer --page "$TERN_PAGE" --url-file "$url_pipe" "$@"
