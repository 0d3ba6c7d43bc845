#!/usr/bin/env bash
# scaling.sh [FOLDER] [OPTION_OF_SCALING...]: how cost grows with obstacles, voxels and J; writes FOLDER/scaling.csv and
# scaling.md (docs/results by default). Under a minute on an idle machine, 4 GB for 10^8 voxels.
set -euo pipefail
# shellcheck source=benchmarks/lib.sh
source "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/lib.sh"

folder=$ROOT/docs/results
if [[ $# -gt 0 && $1 != -* ]]; then
  folder=$1
  shift
fi
build scaling
mkdir -p "$folder"
# The flight's nodes log to stdout too.
"$BUILD/bin/scaling" --config "$ROOT/scenarios/paper_corridor.yaml" "$@" | grep -v '^\[' >"$folder/scaling.csv"
{
# shellcheck disable=SC2016  # the backquotes are Markdown's
  printf '# How cost grows\n\n`benchmarks/scaling.sh` writes this page and [scaling.csv](scaling.csv). Times are thread CPU time.\n'
  printf '[speed.md](speed.md#how-cost-grows) says what they mean.\n\n*Commit %s, %s, %s.*\n' \
    "$(commit)" "$(compiler)" "$(machine)"
  awk -F, '
    NR == 1 { next }
    !($1 in seen) { seen[$1] = ++tables; name[tables] = $1 }
    !(($1, $2) in row) { row[$1, $2] = 1; sizes[$1, ++rows[$1]] = $2 }
    !(($1, $3) in column) { column[$1, $3] = 1; columns[$1, ++width[$1]] = $3 }
    { value[$1, $2, $3] = $4 }
    END {
      title["world"] = "Obstacles in the world, 20 of them near"
      title["reach"] = "Obstacles in reach"
      title["voxels"] = "Voxels"
      title["intervals"] = "Intervals J (paper_corridor 100, seed 1)"
      for (t = 1; t <= tables; ++t) {
        n = name[t]
        printf "\n## %s\n\n| %s |", title[n], n
        for (c = 1; c <= width[n]; ++c) printf " %s |", columns[n, c]
        printf "\n|---|"
        for (c = 1; c <= width[n]; ++c) printf "---|"
        printf "\n"
        for (r = 1; r <= rows[n]; ++r) {
          printf "| %s |", sizes[n, r]
          for (c = 1; c <= width[n]; ++c) printf " %s |", value[n, sizes[n, r], columns[n, c]]
          printf "\n"
        }
      }
    }' "$folder/scaling.csv"
} >"$folder/scaling.md"
echo "written: $folder/scaling.csv, $folder/scaling.md"
