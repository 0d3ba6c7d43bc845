#!/usr/bin/env bash
# Plants one breach of each kind in a copy of the sources, each in a file of its own. check.sh must name every one of these
# files, with what is wrong.
set -euo pipefail
here=$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")
root=$(dirname "$(dirname "$here")")
copy=$(mktemp -d)
trap 'rm -rf "$copy"' EXIT
cd "$root"
find core messages flight_log runtime planner predictor executor simulator semantic_mapper logger monitor launcher viewer \
  -type f \( -name '*.h' -o -name '*.cpp' \) -exec cp --parents {} "$copy" \;

"$here/check.sh" "$copy"

expected=()

# planted FILE TEXT [SAID]: the check must print a line that contains FILE and SAID.
planted() {
  [[ ! -e "$copy/$1" ]] || { echo "planted twice: $1" && exit 1; }
  mkdir -p "$copy/$(dirname "$1")"
  printf '%b' "$2" >"$copy/$1"
  expected+=("$1" "${3:-}")
}

planted planner/lcm.cpp '#include <lcm/lcm-cpp.hpp>\n'
planted planner/globs/CMakeLists.txt 'file(GLOB found CONFIGURE_DEPENDS *.cpp)\n'
planted planner/images.cpp '#include <opencv2/core.hpp>\n'
planted planner/generated.cpp '#include "tern_msgs/plan_t.hpp"\n'
planted core/base/x.h '#include "core/world/track.h"\n'
planted core/geometry/x.h '#include "core/splines/minvo.h"\n'
planted core/world/x.h '#include "messages/plan.h"\n'
planted core/wire/x.h '#include "core/world/track.h"\n'
planted core/world/scenario.h '#include "core/scenario/scenario.h"\n'
planted messages/x.h '#include "runtime/bus.h"\n'
planted flight_log/x.h '#include "runtime/bus.h"\n'
planted runtime/x.h '#include "planner/planner.h"\n'
planted viewer/bridge/app/x.h '#include "tools/replay/replay.h"\n'
planted planner/bus.h '#include "runtime/bus.h"\n'
planted launcher/app/x.h '#include "messages/plan.h"\n'
planted planner/node.h '#include "planner/app/planner_node.h"\n'
planted planner/stranger.h '#include "predictor/tracking/tracker.h"\n'
planted planner/search/x.h '#include "planner/attempt.h"\n'
planted planner/safety/x.h '#include "planner/search/search_memory.h"\n'
planted core/world/one.h '#include "core/world/other.h"\n' 'in a circle'
planted core/world/other.h '#include "core/world/one.h"\n' 'in a circle'
planted planner/app/x.h '#include "predictor/app/predictor_node.h"\n'
planted core/world/yaml.h '#include <yaml-cpp/yaml.h>\n'
planted monitor/x.h '#include <CLI/CLI.hpp>\n'
planted planner/log.cpp '#include <spdlog/spdlog.h>\n'
planted planner/clock.cpp '#include <chrono>\n'
planted viewer/bridge/x.h '#include "messages/plan.h"\n'
planted planner/mac.cpp '#include <sodium.h>\n'
planted tools/audit/x.cpp '#include "core/geometry/convex_hull.h"\n'
planted planner/app2/main.cpp "$(printf '\\n%.0s' {1..61})"
planted planner/long.cpp "$(printf '\\n%.0s' {1..401})"
planted tests/long.cpp "$(printf '\\n%.0s' {1..601})"
planted planner/function.cpp "int f(\\n    int a) {$(printf '\\n%.0s' {1..50})}\\n" ':1: a function of 52 lines'
planted planner/method.cpp "Result f() {$(printf '\\n%.0s' {1..51})}\\n" 'a function of 52 lines'
planted planner/class.h 'namespace tern {\nclass Thing;\nstruct Track {\n};\n}  // namespace tern\n' 'tern::Track is defined more than once'
planted planner/enum.h 'namespace tern {\nenum class GoalMode : int { Go, Hold };\n}  // namespace tern\n' 'tern::GoalMode is defined more than once'

# A library that one folder may know: the second folder is named, not the file.
# second FOLDER/ LIBRARY TEXT
second() {
  mkdir -p "$copy/$1"
  printf '%b' "$3" >"$copy/$1/second.cpp"
  expected+=("$2 is in several folders" "$1")
}
second viewer/beast Beast '#include <boost/beast/core.hpp>\n'
second planner/glpk GLPK '#include <glpk.h>\n'
second simulator/cgal CGAL '#include <CGAL/convex_hull_3.h>\n'
second simulator/ipopt Ipopt '#include <IpTNLP.hpp>\n'

if output=$("$here/check.sh" "$copy"); then
  echo "the check found nothing" && exit 1
fi
# tsort names the files of a circle over several lines, each after its own name.
joined=$(sed -E ':a;N;$!ba;s/\n(tsort: )/ \1/g' <<<"$output")
for ((k = 0; k < ${#expected[@]}; k += 2)); do
  grep -F -- "${expected[k]}" <<<"$joined" | grep -qF -- "${expected[k + 1]}" ||
    { echo "not named: ${expected[k]} with '${expected[k + 1]}' in: $output" && exit 1; }
done
echo "all $((${#expected[@]} / 2)) planted breaches were found"
