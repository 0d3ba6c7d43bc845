#!/usr/bin/env bash
# answers_in_time.sh: measures how many requests are answered in time. It flies the demo live at full speed, alone and
# then with one busy process per core. Exit code 1 if an answer of the first flight is late, or more than one in a
# thousand of the second. If the host takes cores away from this machine, the output says so; the numbers are invalid
# then.
set -euo pipefail
root=$(dirname "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")")
work=$(mktemp -d)
busy=()
trap '((${#busy[@]} == 0)) || kill "${busy[@]}" 2>/dev/null; rm -rf "$work"' EXIT

# core_ticks: prints the ticks that the host took from this machine's cores, and all ticks, since the start.
core_ticks() { awk '$1 == "cpu" { print $9, $2 + $3 + $4 + $5 + $6 + $7 + $8 + $9 }' /proc/stat; }

# fly NAME SHARE: flies and prints a line. Fails if a smaller share of the requests was answered in time.
fly() {
  local before after
  before=$(core_ticks)
  "$root/launch_scripts/fly.sh" --no-install --isolated --record "$work/$1" >"$work/$1.out" 2>&1 || { cat "$work/$1.out" && exit 1; }
  after=$(core_ticks)
  python3 - "$1" "$2" "$work/$1/summary.json" "$before" "$after" <<'END'
import json, sys
name, least, file, before, after = sys.argv[1:]
summary = json.load(open(file))
(taken_0, all_0), (taken_1, all_1) = (map(int, ticks.split()) for ticks in (before, after))
in_time, requests = summary["answered_in_time"], summary["requests"]
print(f"{name}: {in_time} of {requests} requests answered in time; the host took "
      f"{100 * (taken_1 - taken_0) / (all_1 - all_0):.1f} % of the cores")
sys.exit(0 if requests > 100 and in_time >= float(least) * requests else 1)
END
}

result=0
fly alone 1 || result=1
for ((core = 0; core < $(nproc); core++)); do
  (while :; do :; done) &
  busy+=($!)
done
fly beside_busy_cores 0.999 || result=1
exit "$result"
