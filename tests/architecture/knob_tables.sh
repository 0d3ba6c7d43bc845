#!/usr/bin/env bash
# Are the tables of keys in the READMEs what the processes say of themselves?  knob_tables.sh BIN [--write]
# With --write the tables are put there.
set -euo pipefail
cd "$(dirname "$(dirname "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")")")"
bin=$1
write=${2:-}
status=0

# table SECTION: the lines of its table in stdin.
table() { awk -v head="| key of \`$1:\` " 'index($0, head) == 1 { on = 1 } on && !/^\|/ { exit } on'; }

# same PROCESS SECTION README
same() {
  local said shown
  said=$("$bin/$1" --help-config | table "$2")
  shown=$(table "$2" <"$3")
  [[ -n $said && $said == "$shown" ]] && return
  if [[ $write == --write ]]; then
    SAID=$said awk -v head="| key of \`$2:\` " '
      index($0, head) == 1 { print ENVIRON["SAID"]; on = 1 }
      on && !/^\|/ { on = 0 }
      !on' "$3" >"$3.new"
    mv "$3.new" "$3"
    return
  fi
  echo "$3: the table of '$2:' is not what $1 --help-config says:"
  diff <(echo "$shown") <(echo "$said") || true
  status=1
}

same tern-planner planner planner/README.md
same tern-predictor predictor predictor/README.md
same tern-executor executor executor/README.md
same tern-simulator simulator simulator/README.md
same tern-mapper mapper semantic_mapper/README.md
same tern-mavlink mavlink docs/autopilot.md
same tern-autopilot-sim autopilot_sim mavlink/README.md
same tern-logger logger logger/README.md
exit $status
