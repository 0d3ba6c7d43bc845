#!/usr/bin/env bash
# ten_times.sh [TIMES [CTEST_OPTION...]]: runs the default tests TIMES times (10), while one busy process per core loads
# the machine. Prints how each run ended; the output is in build/ten_times/. Exit code 1 if any test failed. Builds
# nothing.
set -euo pipefail
root=$(dirname "$(dirname "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")")")
times=${1:-10}
shift || true
busy=()
trap '((${#busy[@]} == 0)) || kill "${busy[@]}" 2>/dev/null' EXIT
for ((core = 0; core < $(nproc); core++)); do
  (while :; do :; done) &
  busy+=($!)
done
mkdir -p "$root/build/ten_times"
result=0
for ((run = 1; run <= times; run++)); do
  began=$SECONDS log=$root/build/ten_times/$run.log ended=passed
  ctest --test-dir "$root/build/release" -j"$(($(nproc) + 1))" -LE soak --output-on-failure "$@" >"$log" 2>&1 || { ended=FAILED && result=1; }
  echo "run $run of $times: $ended after $((SECONDS - began)) s"
  sed -n '/The following tests FAILED/,$p' "$log"
done
exit "$result"
