#!/usr/bin/env bash
# bag.sh TERN_EXPORT LOG: exports a recorded flight as a bag, and reads it with python3-rosbags, against the tables.
set -euo pipefail
here=$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
"$1" "$2" --csv "$work/tables" --bag "$work/flight"
python3 "$here/check_bag.py" "$work/flight" "$work/tables"
