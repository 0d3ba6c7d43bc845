#!/usr/bin/env bash
# tests.sh NAME: tests of tern-campaign as a user runs it. Environment: TERN_BIN, where the programs are.
set -euo pipefail
here=$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")
root=$(dirname "$(dirname "$here")")
campaign=$TERN_BIN/tern-campaign
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

fail() {
  echo "FAILED: $*" >&2
  exit 1
}

# fly OUT OPTION...: a campaign of short flights.
fly() {
  local out=$1
  shift
  "$campaign" --world "$here/short_hop.yaml" --charge counts --out "$out" "$@" >"$out.said" 2>&1
}

# code COMMAND...: runs it with its output in $work/out; prints its exit code.
code() {
  local code=0
  "$@" >"$work/out" 2>&1 || code=$?
  echo "$code"
}

said() { grep -q -- "$1" "$work/out" || fail "not said: $1, but: $(cat "$work/out")"; }

# The column of a file of flights whose cells before it need no quotes.
column() {
  awk -F, -v name="$1" 'NR == 1 { for (k = 1; k <= NF; k++) if ($k == name) at = k; next } { print $at }' "$2"
}

# What is left of a campaign's processes: each has the folder of this test in its command line.
nobody_left() { ! pgrep -f "$work/" >/dev/null; }

# eventually COMMAND...: waits until it succeeds.
eventually() {
  local deadline=$((SECONDS + 180)) # for what takes moments on an idle machine
  until "$@" >/dev/null 2>&1; do
    ((SECONDS <= deadline)) || fail "not in time: $*"
    read -rt 0.02 <> <(:) || true
  done
}

has_lines() { (($(wc -l <"$1") >= $2)); }

# refused WORDS OPTION...: exit code 2, the words are said, nothing is written.
refused() {
  local words=$1
  shift
  [[ $(code "$campaign" "$@") == 2 ]] || fail "exit code of $*"
  said "$words"
  [[ ! -e $work/x.csv ]] || fail "$* wrote a file"
}

bad_arguments_end_with_a_clear_word_and_exit_code_2() {
  local hop=$here/short_hop.yaml out=(--out "$work/x.csv")
  refused "--world is required" "${out[@]}"
  refused "--out is required" --world "$hop"
  refused "no scenario nowhere; there are:.* paper_corridor" --world nowhere "${out[@]}"
  refused "--seeds 5:1: not A:B" --world "$hop" "${out[@]}" --seeds 5:1
  refused "--seeds 1-5: not A:B" --world "$hop" "${out[@]}" --seeds 1-5
  refused "--shard 3/2: not I/N" --world "$hop" "${out[@]}" --shard 3/2
  refused "unknown key" --world "$hop" "${out[@]}" --set planner.hold=1
  refused "mavlink.hold: unknown key" --world "$hop" "${out[@]}" --set mavlink.hold=1
  refused "autopilot_sim.hold: unknown key" --world "$hop" "${out[@]}" --set autopilot_sim.hold=1
  { cat "$hop" && echo "logger: {hold: 1}"; } >"$work/logger.yaml"
  refused "logger.hold: unknown key" --world "$work/logger.yaml" "${out[@]}"
  refused "out of range" --world "$hop" "${out[@]}" --set uav.limits.v_max=-1
  refused "seeds are set by --seeds" --world "$hop" "${out[@]}" --set seed=3
  refused "--charge" --world "$hop" "${out[@]}" --charge wall
  refused "--jobs" --world "$hop" "${out[@]}" --jobs 0
  refused "nowhere: is not an executable program" --world "$hop" "${out[@]}" --audit nowhere
  refused "$hop: is not an executable program" --world "$hop" "${out[@]}" --coverage "$hop"
  refused "--bogus" --world "$hop" "${out[@]}" --bogus
  refused "world: is not an option of summarize" --world x summarize "$work/x.csv"
  refused "no tern-logger runs" --world "$here/short_hop.yaml" --set logger.rotate_mb=3 --out "$work/x.csv"
  refused "charge" judge-contacts --world "$here/short_hop.yaml" --charge cpu "$work/x.csv"
  refused "parts is required" merge --out "$work/x.csv"
  [[ $(code "$campaign" --world "$hop" --out "$work/no/such/folder/x.csv") == 3 ]] || fail "a folder that is not there"
}

# lacks_file WORDS COMMAND...: exit code 3, and the words are said.
lacks_file() {
  local words=$1
  shift
  [[ $(code "$campaign" "$@") == 3 ]] || fail "exit code of $*: $(cat "$work/out")"
  said "$words"
}

files_that_cannot_be_read_or_written_end_with_exit_code_3() {
  local hop=$here/short_hop.yaml none=$work/nothing.csv
  lacks_file "nothing.csv: no such file" merge --out "$work/x.csv" "$none"
  lacks_file "nothing.csv: no such file" compare "$none" "$none"
  lacks_file "nothing.csv: no such file" page "$none"
  lacks_file "nothing.csv: no such file" summarize "$none"
  lacks_file "nothing.csv: no such file" judge-contacts --world "$hop" "$none"
  lacks_file "no/x.svg: cannot be written" check --world "$hop" --out "$work/no/x.svg"
  # shellcheck disable=SC2016  # the inner shell expands it
  [[ $(code bash -c '"$0" columns >/dev/full' "$campaign") == 3 ]] || fail "a full disk: $(cat "$work/out")"
  said "cannot be written\|cannot write"
}

contacts_are_judged_in_the_world_of_their_flights_only() {
  local hop=$here/short_hop.yaml
  fly "$work/flights.csv" --seeds 1:1
  [[ $(code "$campaign" judge-contacts --world "$hop" "$work/flights.csv") == 0 ]] || fail "$(cat "$work/out")"
  said "flights 1, contacts 0"
  refused "flights of another world: count 3 against 2" judge-contacts --world "$hop" --count 2 "$work/flights.csv"
  refused "flights of another world: configuration" judge-contacts --world "$hop" --set uav.limits.v_max=3 "$work/flights.csv"
}

a_campaign_by_counts_gives_the_same_bytes_whatever_the_jobs() {
  fly "$work/one.csv" --seeds 1:6 --jobs 1
  fly "$work/three.csv" --seeds 1:6 --jobs 3
  cmp "$work/one.csv" "$work/three.csv"
  [[ $(column outcome "$work/one.csv" | sort -u) == reached ]] || fail "$(cat "$work/one.csv")"
  [[ ! -e $work/one.csv.failures && ! -e $work/one.csv.lock ]] || fail "left behind: $(ls -a "$work")"
}

shards_merged_equal_the_whole() {
  fly "$work/whole.csv" --seeds 3:9
  for k in 1 2 3; do fly "$work/part$k.csv" --seeds 3:9 --shard "$k/3"; done
  "$campaign" merge "$work"/part?.csv --out "$work/merged.csv" --summary "$work/merged.json" >/dev/null
  cmp "$work/whole.csv" "$work/merged.csv"
  "$campaign" summarize "$work/whole.csv" --summary "$work/whole.json" >/dev/null
  diff <(grep -A7 -E '"(flights|success|flight_time_s)"' "$work/whole.json") \
    <(grep -A7 -E '"(flights|success|flight_time_s)"' "$work/merged.json") || fail "summaries differ"
}

a_comparison_is_of_one_scenario_and_of_different_flights() {
  fly "$work/a.csv" --seeds 1:2
  fly "$work/b.csv" --seeds 1:2 --set uav.limits.v_max=3
  [[ $(code "$campaign" compare --form svg "$work/a.csv" "$work/b.csv") == 0 ]] || fail "$(cat "$work/out")"
  said "^<svg" && said "</svg>"
  [[ $(code "$campaign" compare "$work/a.csv" "$work/a.csv") == 2 ]] || fail "equal flights: $(cat "$work/out")"
  said "A and B are the same flights"
  sed 's/short_hop/elsewhere/' "$work/b.csv" >"$work/other.csv"
  [[ $(code "$campaign" compare "$work/a.csv" "$work/other.csv") == 2 ]] || fail "two scenarios: $(cat "$work/out")"
  said 'their scenarios differ, "short_hop" and "elsewhere"'
}

flights_that_are_equal_have_no_interval_while_they_are_flown() {
  fly "$work/different.csv" --seeds 1:3
  grep -q "3/3  success 100.00 % \[" "$work/different.csv.said" || fail "$(cat "$work/different.csv.said")"
  fly "$work/equal.csv" --seeds 1:3 --set world.generator=none --set world.count=0
  grep -q "3/3  success 100.00 %, 1 different flights" "$work/equal.csv.said" || fail "$(cat "$work/equal.csv.said")"
}

a_killed_campaign_goes_on_and_loses_or_repeats_nothing() {
  "$campaign" --world "$here/short_hop.yaml" --charge counts --seeds 1:24 --jobs 2 --out "$work/flights.csv" \
    >"$work/said" 2>&1 &
  local pid=$!
  eventually has_lines "$work/flights.csv" 4
  kill -KILL "$pid"
  wait "$pid" 2>/dev/null || true
  eventually nobody_left
  cp "$work/flights.csv" "$work/before.csv"
  has_lines "$work/before.csv" 25 && fail "it was over before it was killed"
  fly "$work/flights.csv" --seeds 1:24 --jobs 2
  [[ $(column seed "$work/flights.csv") == $(seq 1 24) ]] || fail "seeds: $(column seed "$work/flights.csv")"
  local line
  while IFS= read -r line; do
    grep -qxF -- "$line" "$work/flights.csv" || fail "lost: $line"
  done <"$work/before.csv"
  fly "$work/uninterrupted.csv" --seeds 1:24 --jobs 2
  cmp "$work/flights.csv" "$work/uninterrupted.csv"
}

an_interrupted_campaign_ends_cleanly_and_goes_on() {
  env --default-signal=INT "$campaign" --world "$here/short_hop.yaml" --charge counts --seeds 1:24 --jobs 2 \
    --out "$work/flights.csv" >"$work/out" 2>&1 &
  local pid=$! code=0
  eventually has_lines "$work/flights.csv" 3
  kill -INT "$pid"
  wait "$pid" || code=$?
  [[ $code == 130 ]] || fail "exit code $code"
  said "run the same command again"
  nobody_left || fail "still there: $(pgrep -af "$work/")"
  [[ ! -e $work/flights.csv.failures ]] || fail "left behind: $(ls -a "$work/flights.csv.failures")"
  fly "$work/flights.csv" --seeds 1:24
  [[ $(column seed "$work/flights.csv") == $(seq 1 24) ]] || fail "seeds: $(column seed "$work/flights.csv")"
}

whoever_ends_a_flight_s_process_interrupts_the_campaign_and_fails_no_flight() {
  "$campaign" --world "$root/scenarios/paper_corridor.yaml" --count 300 --charge counts --seeds 1:2 --jobs 1 \
    --out "$work/flights.csv" >"$work/out" 2>&1 &
  local pid=$! code=0
  eventually pkill -TERM -f "fly-one .*$work/"
  wait "$pid" || code=$?
  [[ $code == 130 ]] || fail "exit code $code: $(cat "$work/flights.csv")"
  said "run the same command again"
  [[ $(wc -l <"$work/flights.csv") == 1 ]] || fail "a flight was counted: $(cat "$work/flights.csv")"
  [[ ! -e $work/flights.csv.failures ]] || fail "left behind: $(ls -a "$work/flights.csv.failures")"
}

another_campaign_is_refused_by_the_file() {
  fly "$work/flights.csv" --seeds 1:1
  cp "$work/flights.csv" "$work/before.csv"
  [[ $(code "$campaign" --world "$here/short_hop.yaml" --charge counts --count 2 --out "$work/flights.csv") == 3 ]] ||
    fail "flown: $(cat "$work/out")"
  said "flights of another campaign: count 3 against 2"
  cmp "$work/flights.csv" "$work/before.csv"
}

a_failed_flight_can_be_flown_again_from_its_scenario() {
  fly "$work/flights.csv" --seeds 4:4 --set timeout_s=1
  [[ $(column outcome "$work/flights.csv") == timeout ]] || fail "$(cat "$work/flights.csv")"
  local folder=$work/flights.csv.failures/seed-4
  for file in scenario.yaml flight.lcm summary.json flight.log; do [[ -s $folder/$file ]] || fail "no $file"; done
  grep -q 'generator: none' "$folder/scenario.yaml" || fail "obstacles are not listed"
  grep -q 'seed-4/flight.lcm' "$work/flights.csv" || fail "the log is not named"
  "$campaign" --world "$folder/scenario.yaml" --charge counts --seeds 4:4 --out "$work/again.csv" >/dev/null 2>&1
  local measure
  for measure in outcome flight_time_s path_length_m min_clearance_m requests plans_search_only; do
    [[ $(column "$measure" "$work/again.csv") == $(column "$measure" "$work/flights.csv") ]] || fail "$measure differs"
  done
}

a_flight_whose_process_dies_has_failed() {
  # A second of CPU time is not enough for it.
  "$campaign" --world "$root/scenarios/paper_corridor.yaml" --count 300 --set executor.rate_hz=60 --seeds 1:1 \
    --cpu-limit 1 --out "$work/flights.csv" >"$work/out" 2>&1
  [[ $(column outcome "$work/flights.csv") == failed ]] || fail "$(cat "$work/flights.csv")"
  grep -q "the flight's process died of signal 24 (CPU time limit exceeded)" "$work/flights.csv" ||
    fail "$(cat "$work/flights.csv")"
  [[ -s $work/flights.csv.failures/seed-1/scenario.yaml ]] || fail "no scenario"
}

a_full_disk_ends_the_campaign_and_fails_no_flight() {
  # No file may be longer than 100 kB: as on a full disk, writing fails.
  [[ $(trap '' XFSZ && ulimit -f 100 && code "$campaign" --world "$here/short_hop.yaml" --out "$work/flights.csv") == 3 ]] ||
    fail "flown: $(cat "$work/out")"
  said "flight.lcm: File too large\|not all messages could be written"
  [[ $(wc -l <"$work/flights.csv") == 1 ]] || fail "a flight was counted: $(cat "$work/flights.csv")"
  fly "$work/other.csv" --seeds 1:1
}

a_resumed_campaign_says_how_many_were_audited_now_before_and_not() {
  local resumed=$work/flights.csv
  fly "$resumed" --seeds 1:2
  ! grep -q audited "$resumed.said" || fail "audited: $(cat "$resumed.said")"
  fly "$resumed" --seeds 1:3 --audit true
  grep -q 'audited 1 of 3' "$resumed.said" || fail "$(cat "$resumed.said")"
  fly "$resumed" --seeds 1:5 --audit true
  for words in 'audited 3 of 5' '2 were flown earlier without --audit' '2 audited in this run, 1 before it'; do
    grep -q -- "$words" "$resumed.said" || fail "not said: $words, but $(cat "$resumed.said")"
  done
}

an_audit_that_finds_a_breach_fails_the_flight() {
  # shellcheck disable=SC2016  # the audit expands it
  printf '#!/bin/sh\ntest -s "$1" && echo "a breach in $1"\nexit 1\n' >"$work/audit"
  chmod +x "$work/audit"
  fly "$work/flights.csv" --seeds 1:1 --audit "$work/audit"
  [[ $(column outcome "$work/flights.csv") == reached ]] || fail "$(cat "$work/flights.csv")"
  grep -q ',broken,seed-1/flight.lcm,' "$work/flights.csv" || fail "$(cat "$work/flights.csv")"
  grep -q 'a breach in' "$work/flights.csv.failures/seed-1/audit.txt" || fail "no audit.txt"
  grep -q 'success 0.00 %' "$work/flights.csv.said" || fail "$(cat "$work/flights.csv.said")"
}

a_page_of_a_campaign_asks_for_nothing_and_links_what_failed() {
  fly "$work/flights.csv" --seeds 4:5 --set timeout_s=1
  [[ $(code "$campaign" page "$work/flights.csv" --out "$work/page.html") == 0 ]] || fail "$(cat "$work/out")"
  [[ -s $work/page.html ]] || fail "no page"
  ! grep -oE 'https?:[^"]*|(src|href)="//[^"]*' "$work/page.html" | grep -v '^http://www.w3.org/' || fail "it asks for something"
  local seed
  for seed in 4 5; do
    grep -q "seed-$seed/flight.lcm" "$work/page.html" || fail "no link to the log of seed $seed"
    [[ -s $work/flights.csv.failures/seed-$seed/flight.lcm ]] || fail "no log of seed $seed"
  done
  grep -q flights.csv.failures "$work/page.html" || fail "where the logs are is not said"
}

# A stand-in for sbatch: runs the jobs at once, one after the other, from a copy of the script, as Slurm does.
make_sbatch() {
  mkdir -p "$work/spool" "$work/path"
  cat >"$work/path/sbatch" <<'END'
#!/usr/bin/env bash
set -euo pipefail
array='' cpus=1 output=slurm-%A_%a.out
while [[ $1 == --* ]]; do
  case $1 in
    --array=1-*) array=${1##*-} ;;
    --cpus-per-task=*) cpus=${1#*=} ;;
    --output=*) output=${1#*=} ;;
  esac
  shift
done
spool=$(dirname "$(dirname "$0")")/spool
cp "$1" "$spool/script"
shift
for ((k = 1; k <= ${array:-1}; k++)); do
  out=${output//%a/${array:+$k}} out=${out//%[Aj]/7}
  env SLURM_JOB_ID=7 SLURM_SUBMIT_DIR="$PWD" ${array:+SLURM_ARRAY_TASK_ID=$k SLURM_CPUS_PER_TASK=$cpus} \
    bash "$spool/script" "$@" >>"$out" 2>&1
done
echo 7
END
  chmod +x "$work/path/sbatch"
}

the_slurm_script_flies_all_shards_and_merges_them() {
  make_sbatch
  cd "$root"
  PATH=$work/path:$PATH CPUS=2 launch_scripts/campaign_slurm.sh "$work/dir" 3 --world "$here/short_hop.yaml" --charge counts \
    --seeds 1:5 >"$work/out"
  said "submitted: 3 shards as job 7"
  fly "$work/whole.csv" --seeds 1:5
  cmp "$work/whole.csv" "$work/dir/flights.csv"
  grep -q '"flights": 5' "$work/dir/summary.json" || fail "$(cat "$work/dir/summary.json")"
  local outputs='merge-of-job-7.out shard-1-of-job-7.out shard-2-of-job-7.out shard-3-of-job-7.out '
  [[ $(cd "$work/dir/output" && printf '%s ' *) == "$outputs" ]] || fail "output files: $(ls "$work/dir/output")"
  [[ -z $(find "$root" -maxdepth 1 -name '*.out') ]] || fail "output files in the clone"
}

declare -F "$1" >/dev/null || fail "no test $1"
"$1"
echo "passed: $1"
