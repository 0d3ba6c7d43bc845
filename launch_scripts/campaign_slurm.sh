#!/usr/bin/env bash
# campaign_slurm.sh: a campaign as a Slurm job array; campaign_slurm.sh --help.
#SBATCH --job-name=tern-campaign
set -euo pipefail
# Slurm runs a copy of this script, so the project's folder is the one from which the job was submitted.
here=$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")
[[ -e $here/lib.sh ]] || here=${SLURM_SUBMIT_DIR:?}/launch_scripts
# shellcheck source=launch_scripts/lib.sh
source "$here/lib.sh"

usage() {
  cat <<'END'
campaign_slurm.sh DIR SHARDS OPTION...: flies a campaign on a Slurm cluster.

Run it in the project's folder; every node must see that folder and DIR. It submits an array of SHARDS jobs, each of which
flies its share of the seeds into DIR/shards/. When all have succeeded, a last job merges them into DIR/flights.csv and
DIR/summary.json. What the jobs print is in DIR/output/. OPTION... are tern-campaign's: --world, --count, --seeds, --set, --charge, --audit.

Cores per job: CPUS=K in the environment (default 4). Partition, account and time limit: Slurm's own variables
SBATCH_PARTITION, SBATCH_ACCOUNT and SBATCH_TIMELIMIT. After a failure the same command continues where it stopped.
END
}

[[ ${1:-} != --help && ${1:-} != -h ]] || { usage && exit 0; }
[[ $# -ge 3 && $2 =~ ^[1-9][0-9]*$ ]] || { usage >&2 && exit 2; }
dir=$1 shards=$2
shift 2

if [[ -z ${SLURM_JOB_ID:-} ]]; then
  build_programs tern-campaign tern-audit
  mkdir -p "$dir/shards" "$dir/output"
  # In the name of an output file, Slurm reads % as the beginning of a pattern.
  output=${dir//%/%%}/output
  array=$(sbatch --parsable --array="1-$shards" --cpus-per-task="${CPUS:-4}" --output="$output/shard-%a-of-job-%A.out" \
    "${BASH_SOURCE[0]}" "$dir" "$shards" "$@")
  merge=$(sbatch --parsable --dependency="afterok:${array%%;*}" --output="$output/merge-of-job-%j.out" \
    "${BASH_SOURCE[0]}" "$dir" "$shards" --merge)
  say "submitted: $shards shards as job ${array%%;*}, then their merging as job ${merge%%;*}"
elif [[ $1 == --merge ]]; then
  parts=()
  for ((k = 1; k <= shards; k++)); do parts+=("$dir/shards/$k.csv"); done
  exec "$TERN_BIN/tern-campaign" merge "${parts[@]}" --out "$dir/flights.csv" --summary "$dir/summary.json"
else
  k=$SLURM_ARRAY_TASK_ID
  exec "$TERN_BIN/tern-campaign" "$@" --jobs "${SLURM_CPUS_PER_TASK:-1}" --shard "$k/$shards" --out "$dir/shards/$k.csv" \
    --failures "$dir/failures"
fi
