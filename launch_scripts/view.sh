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
# Ends with tern-viewer, which becomes this process.
{
  exec {pipe}<>"$url_pipe"
  until read -rt 1 -u "$pipe" url || ! kill -0 $$; do :; done
  rm "$url_pipe"
  [[ -z $url ]] || open_page "$url"
} </dev/null >/dev/null 2>&1 &
exec_process tern-viewer --page "$TERN_PAGE" --url-file "$url_pipe" "$@"
