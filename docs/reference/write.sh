#!/usr/bin/env bash
# write.sh BIN: writes keys.md and programs.md from what the programs in BIN print about themselves.
# write.sh BIN --check [keys|programs|exit_codes]: compares instead and prints every difference; exit code 1 if there is any.
#
# exit_codes.md is written by hand. The check starts every program with --help and with an unknown option, and expects the
# codes of the page. It also looks for every constant kExit... of the code on the page.
# shellcheck disable=SC2317,SC2016  # pages are functions called by name; backquotes are Markdown
set -euo pipefail
if [[ $# -lt 1 || $1 == --help ]]; then
  sed -n '2,/^[^#]/s/^# \{0,1\}//p' "$0"
  exit 0
fi
bin=$(readlink -f "$1")
check=${2:-}
only=${3:-}
cd "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")"
root=$(readlink -f ../..)
unset TERN_PACE TERN_DATA LCM_DEFAULT_URL
differences=0

# process and its section of the scenario file
sections=(
  tern-planner planner
  tern-predictor predictor
  tern-executor executor
  tern-simulator simulator
  tern-mapper mapper
  tern-detector detector
  tern-estimator estimator
  tern-features features
  tern-mavlink mavlink
  tern-autopilot-sim autopilot_sim
  tern-logger logger
  tern-mission mission
  tern-dimos dimos
)

keys() {
  cat <<'TEXT'
# Keys of the processes

Each process has a section of its own in the scenario file. The tables are made from `--help-config` of the programs by
[write.sh](write.sh), and a test compares them. An override on the command line names section and key:

    launch_scripts/fly.sh --scenario corridor_demo --set planner.search.samples_xy=7

A key that a process does not know, a wrong type or a value out of range ends the process with exit code 2. The message
names file, line, key, value and range. The keys of the world, the vehicle and the regions are in
[scenarios.md](scenarios.md).
TEXT
  local k table
  for ((k = 0; k < ${#sections[@]}; k += 2)); do
    [[ ${sections[k]} != tern-features || -x $bin/tern-features ]] || continue
    table=$("$bin/${sections[k]}" --help-config |
      awk -v head="| key of \`${sections[k + 1]}:\` " 'index($0, head) == 1 { on = 1 } on && !/^\|/ { exit } on')
    [[ -n $table ]] || { echo "${sections[k]} --help-config has no table of ${sections[k + 1]}" >&2 && exit 1; }
    printf '\n## %s\n\nRead by %s.\n\n%s\n' "${sections[k + 1]}" "${sections[k]}" "$table"
  done
}

names() { (cd "$bin" && find . -maxdepth 1 -name 'tern-*' ! -name '*.so' -type f -perm -u+x -printf '%f\n' | LC_ALL=C sort); }

# subcommands PROGRAM [COMMAND...]: the names under "Subcommands:" of its help
subcommands() { "$bin/$1" "${@:2}" --help | awk '/^[A-Z][A-Za-z ]*:/ { on = /^Subcommands:/; next } on && /^  [a-z]/ { print $1 }'; }

# help PROGRAM [COMMAND...]: without the folder that the program lies in, and without spaces at the ends of lines
help() { "$bin/$1" "${@:2}" --help | sed -e "s|$bin/||g" -e 's/ *$//' -e '/./,$!d' | cat -s; }

programs() {
  cat <<'TEXT'
# Programs

The output of `--help` of every program, made by [write.sh](write.sh) and compared by a test. The scripts in
[launch_scripts](../../launch_scripts/README.md) start these programs. See also [exit_codes.md](exit_codes.md), and
[keys.md](keys.md) for the scenario file.
TEXT
  local name command
  for name in $(names); do
    printf '\n## %s\n\n```text\n%s\n```\n' "$name" "$(help "$name")"
    for command in $(subcommands "$name"); do
      printf '\n### %s %s\n\n```text\n%s\n```\n' "$name" "$command" "$(help "$name" "$command")"
    done
  done
}

# of_built: the page on standard input without the sections of programs that were not built, since their library is missing.
of_built() {
  local name missing=
  for name in tern-ros2 tern-unlaz tern-features; do
    [[ -x $bin/$name ]] || missing+=" $name ${name#tern-} "
  done
  awk -v missing="$missing" '/^## / { skip = index(missing, " " $2 " ") > 0 } !skip'
}

# page NAME: writes NAME.md, or compares it.
page() {
  local made
  made=$("$1")
  if [[ $check != --check ]]; then
    printf '%s\n' "$made" >"$1.md"
  elif ! diff <(of_built <"$1.md") <(printf '%s\n' "$made"); then
    echo "docs/reference/$1.md is not what the programs print: docs/reference/write.sh BIN writes it anew"
    differences=$((differences + 1))
  fi
}

# rows_of PROGRAM: its rows of the page of exit codes as "code<TAB>meaning"
rows_of() {
  awk -F' *[|] *' -v name="$1" '
    $2 != "" { hit = index($2, "`" name "`") > 0 }
    hit && $3 ~ /^[0-9]/ { print $3 "\t" $4 }' exit_codes.md
}

exit_codes() {
  local name code meaning
  for name in $(names); do
    code=0
    "$bin/$name" --help >/dev/null 2>&1 || code=$?
    [[ $code == 0 ]] || { echo "$name --help ends with $code" && differences=$((differences + 1)); }
    code=0
    "$bin/$name" --no-such-option >/dev/null 2>&1 </dev/null || code=$?
    meaning=$(rows_of "$name" | awk -F'\t' -v code="$code" '$1 == code { print $2 }')
    [[ $meaning == *option* ]] || {
      echo "$name --no-such-option ends with $code; exit_codes.md has for that code: ${meaning:-nothing}"
      differences=$((differences + 1))
    }
  done
  while IFS=: read -r where code; do
    awk -F' *[|] *' -v code="$code" '$3 == code || $3 ~ "^" code " " { found = 1 } END { exit !found }' exit_codes.md || {
      echo "exit code $code of $where is not in docs/reference/exit_codes.md"
      differences=$((differences + 1))
    }
  done < <(cd "$root" && grep -rHoE --include='*.h' --include='*.cpp' 'constexpr int kExit[A-Za-z]+ = [0-9]+' -- */ |
    grep -v '^build/' | sed -E 's/:constexpr int (kExit[A-Za-z]+) = ([0-9]+)/ \1:\2/')
}

for name in keys programs; do
  [[ -n $only && $only != "$name" ]] || page "$name"
done
[[ -n $only && $only != exit_codes ]] || exit_codes
exit $((differences > 0))
