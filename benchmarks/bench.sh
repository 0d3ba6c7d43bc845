#!/usr/bin/env bash
# bench.sh [FILE.json] [GOOGLE_BENCHMARK_OPTION...]: every stage alone; one JSON with commit, compiler and machine.
set -euo pipefail
# shellcheck source=benchmarks/lib.sh
source "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/lib.sh"

out=$ROOT/build/benchmarks.json
if [[ ${1:-} == *.json ]]; then
  out=$1
  shift
fi
build tern_benchmarks
"$BUILD/bin/tern_benchmarks" --benchmark_out="$out" --benchmark_out_format=json \
  --benchmark_context="commit=$(commit)" --benchmark_context="compiler=$(compiler | tr ',=' '  ')" \
  --benchmark_context="machine=$(machine | tr ',=' '  ')" "$@" 2>"$out.log" ||
  { cat "$out.log" >&2 && exit 1; }
echo "written: $out"
