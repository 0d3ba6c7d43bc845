#!/usr/bin/env bash
# Plants one breach of each kind in a copy of the sources and expects check.sh to name it.
set -euo pipefail
here=$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")
root=$(dirname "$(dirname "$here")")
copy=$(mktemp -d)
trap 'rm -rf "$copy"' EXIT
cd "$root"
find core messages flight_log runtime planner predictor executor simulator semantic_mapper logger monitor launcher viewer \
  -type f \( -name '*.h' -o -name '*.cpp' \) -exec cp --parents {} "$copy" \;

"$here/check.sh" "$copy"

# planted FILE TEXT: the check fails and names the file.
planted() {
  mkdir -p "$copy/$(dirname "$1")"
  printf '%b' "$2" >"$copy/$1"
  if output=$("$here/check.sh" "$copy"); then
    echo "not found: $1 with $2" && exit 1
  fi
  grep -q -- "$1\|${3:-$1}" <<<"$output" || { echo "not named: $1, but: $output" && exit 1; }
  rm "$copy/$1"
}

planted planner/x.cpp '#include <lcm/lcm-cpp.hpp>\n'
planted planner/CMakeLists.txt 'file(GLOB found CONFIGURE_DEPENDS *.cpp)\n'
planted planner/x.cpp '#include "tern_msgs/plan_t.hpp"\n'
planted core/base/x.h '#include "core/world/track.h"\n'
planted core/geometry/x.h '#include "core/splines/minvo.h"\n'
planted core/world/x.h '#include "messages/plan.h"\n'
planted messages/x.h '#include "runtime/bus.h"\n'
planted flight_log/x.h '#include "runtime/bus.h"\n'
planted runtime/x.h '#include "planner/planner.h"\n'
planted viewer/bridge/app/x.h '#include "tools/replay/replay.h"\n'
planted planner/x.h '#include "runtime/bus.h"\n'
planted launcher/app/x.h '#include "messages/plan.h"\n'
planted planner/x.h '#include "planner/app/planner_node.h"\n'
planted planner/x.h '#include "predictor/tracking/tracker.h"\n'
planted planner/search/x.h '#include "planner/attempt.h"\n'
planted planner/safety/x.h '#include "planner/search/search_memory.h"\n'
echo '#include "core/world/x.h"' >"$copy/core/world/y.h"
planted core/world/x.h '#include "core/world/y.h"\n' 'in a circle'
rm "$copy/core/world/y.h"
planted planner/app/x.h '#include "predictor/app/predictor_node.h"\n'
planted core/world/x.h '#include <yaml-cpp/yaml.h>\n'
planted monitor/x.h '#include <CLI/CLI.hpp>\n'
planted planner/x.cpp '#include <spdlog/spdlog.h>\n'
planted planner/x.cpp '#include <chrono>\n'
planted viewer/bridge/x.h '#include "messages/plan.h"\n'
planted viewer/bridge/x.cpp '#include <boost/beast/core.hpp>\n' Beast
planted planner/x.cpp '#include <glpk.h>\n' GLPK
planted runtime/x.cpp '#include <sodium.h>\n'
planted simulator/x.cpp '#include <CGAL/convex_hull_3.h>\n' CGAL
planted simulator/x.cpp '#include <IpTNLP.hpp>\n' Ipopt
planted tools/audit/x.cpp '#include "core/geometry/convex_hull.h"\n'
planted planner/app2/main.cpp "$(printf '\\n%.0s' {1..61})"
planted planner/x.cpp "$(printf '\\n%.0s' {1..401})"
planted tests/x.cpp "$(printf '\\n%.0s' {1..601})"
planted planner/x.cpp "int f(\\n    int a) {$(printf '\\n%.0s' {1..50})}\\n" 'x.cpp:1: a function of 52 lines'
planted planner/x.cpp "Result f() {$(printf '\\n%.0s' {1..51})}\\n" 'a function of 52 lines'
planted planner/x.h 'namespace tern {\nclass Thing;\nstruct Track {\n};\n}  // namespace tern\n' 'tern::Track is defined more than once'
planted planner/x.h 'namespace tern {\nenum class GoalMode : int { Go, Hold };\n}  // namespace tern\n' 'tern::GoalMode is defined more than once'
echo "every planted breach was found"
