#!/usr/bin/env bash
# check.sh ROOT: holds the sources to the dependency rules of docs/architecture.md, by their includes. Prints every breach.
set -euo pipefail
cd "$1"

breaches=0
breach() {
  echo "$*"
  breaches=$((breaches + 1))
}

# Every source of ours, built or not yet added to git.
mapfile -t sources < <(find -- * \( -name build -o -name flights -o -name node_modules \) -prune -o \
  -type f \( -name '*.h' -o -name '*.cpp' \) -print | sort)
((${#sources[@]} > 100)) || breach "only ${#sources[@]} sources found under $1"

# all INCLUDES as "file<TAB>header", quoted and bracketed ones.
includes=$(grep -HoE '^ *# *include *[<"][^>"]+' "${sources[@]}" | sed -E 's/^([^:]+): *# *include *[<"]/\1\t/')

# only_in PATTERN_OF_HEADERS PATTERN_OF_FILES WHY
only_in() {
  local file header
  while IFS=$'\t' read -r file header; do
    [[ $file =~ $2 ]] || breach "$file includes $header: $3"
  done < <(awk -F'\t' -v p="$1" '$2 ~ p' <<<"$includes")
}

# never PATTERN_OF_FILES PATTERN_OF_HEADERS WHY
never() {
  local file header
  while IFS=$'\t' read -r file header; do
    breach "$file includes $header: $3"
  done < <(awk -F'\t' -v f="$1" -v h="$2" '$1 ~ f && $2 ~ h' <<<"$includes")
}

# one_folder LIBRARY PATTERN_OF_HEADERS: tests and benchmarks may, besides.
one_folder() {
  local folders
  folders=$(awk -F'\t' -v p="$2" '$2 ~ p && $1 !~ /^(tests|benchmarks)\// {sub(/\/[^\/]*$/, "", $1); print $1}' <<<"$includes" | sort -u)
  [[ $(wc -w <<<"$folders") -le 1 ]] || breach "$1 is in several folders: ${folders//$'\n'/ }"
}

# Middleware and formats stay at the edge.
only_in '^lcm/' '^(messages|runtime|tests|benchmarks)/|/app/' 'LCM is for messages, runtime, apps and tests'
only_in '^tern_msgs/' '^(messages|tests|benchmarks)/' 'generated types are for messages'
only_in '^yaml-cpp/' '^(runtime|tests)/|/app/' 'YAML is for runtime and apps'
only_in '^CLI/' '^runtime/command_line\.cpp$' 'CLI11 stands behind runtime/command_line.h'
only_in '^spdlog/' '^runtime/log\.cpp$' 'spdlog stands behind runtime/log.h'
only_in '^runtime/log\.h$' '^(runtime|tests)/|/app/|^python/module\.cpp$' 'a library does not log'
only_in '^(chrono|sys/time.h)$' '^(runtime|tests|benchmarks|tools|campaign)/|/app/' 'a library gets times as arguments'

# Solvers stay behind one adapter each.
one_folder CGAL '^CGAL/'
one_folder GLPK '^glpk.h$'
one_folder Ipopt '^(coin/)?Ip[A-Z].*[.]hpp$'
one_folder Beast '^boost/beast'
one_folder GeographicLib '^GeographicLib/'
only_in '^sodium' '^runtime/mac[.]cpp$' 'libsodium is for one adapter'
only_in '^laszip/' '^(semantic_mapper/app/unlaz_main[.]cpp|tests/semantic_mapper/unlaz_test[.]cpp)$' 'LASzip trusts its input'
only_in '^opencv2/' '^(features|tests/features)/' 'OpenCV is for one folder'
only_in '^dds/' '^ros2/dds/' 'Cyclone DDS is for one adapter'

# base <- geometry <- splines <- world <- scenario <- process libraries <- apps; wire stands on base alone.
ours='^(core|geodesy|perception|messages|ros_messages|ros_bridge|flight_log|runtime|planner|predictor|detector|estimator|features|executor|simulator|mavlink|ros2|dimos|semantic_mapper|mission|logger|monitor|launcher|campaign|viewer|tools|tests)/'
never '^core/base/' "^core/(geometry|splines|wire|world|scenario|drawing)/" 'base stands on nothing'
never '^core/geometry/' '^core/(splines|wire|world|scenario|drawing)/' 'geometry stands on base'
never '^core/splines/' '^core/(wire|world|scenario|drawing)/' 'splines stand on base and geometry'
never '^core/wire/' '^core/(geometry|splines|world|scenario|drawing)/' 'the wire stands on base'
never '^core/world/' '^core/(scenario|drawing)/' 'what is drawn, and scenarios, stand on world'
never '^core/scenario/' '^core/drawing/' 'scenarios stand on world'
never '^core/' '^(geodesy|perception|messages|ros_messages|ros_bridge|flight_log|runtime|planner|predictor|detector|estimator|features|executor|simulator|mavlink|ros2|dimos|semantic_mapper|mission|logger|monitor|launcher|campaign|viewer|tools|tests)/' \
  'core stands on itself'
never '^perception/' '^(messages|ros_messages|ros_bridge|flight_log|runtime|planner|predictor|detector|estimator|features|executor|simulator|mavlink|ros2|dimos|semantic_mapper|mission|logger|monitor|launcher|campaign|viewer|tools|tests)/' \
  'perception stands on core'
never '^geodesy/' '^(perception|messages|ros_messages|ros_bridge|flight_log|runtime|planner|predictor|detector|estimator|features|executor|simulator|mavlink|ros2|dimos|semantic_mapper|mission|logger|monitor|launcher|campaign|viewer|tools|tests)/' \
  'places on the earth stand on core'
never '^messages/' '^(perception|ros_messages|ros_bridge|flight_log|runtime|planner|predictor|detector|estimator|features|executor|simulator|mavlink|ros2|dimos|semantic_mapper|mission|logger|monitor|launcher|campaign|viewer|tools|tests)/' \
  'messages stand on core'
never '^ros_messages/' '^(perception|messages|ros_bridge|flight_log|runtime|planner|predictor|detector|estimator|features|executor|simulator|mavlink|ros2|dimos|semantic_mapper|mission|logger|monitor|launcher|campaign|viewer|tools|tests)/' \
  'ROS messages stand on core'
never '^ros_bridge/' '^(perception|flight_log|planner|predictor|detector|estimator|features|executor|simulator|mavlink|ros2|dimos|semantic_mapper|mission|logger|monitor|launcher|campaign|viewer|tools|tests)/' \
  'bridges to ROS stand on core and ROS messages, their app/ on the bus'
never '^flight_log/' '^(perception|runtime|planner|predictor|detector|estimator|features|executor|simulator|mavlink|ros2|dimos|semantic_mapper|mission|logger|monitor|launcher|campaign|viewer|tools|tests)/' \
  'the log stands on core and messages'
never '^runtime/' '^(perception|planner|predictor|detector|estimator|features|executor|simulator|mavlink|ros2|dimos|semantic_mapper|mission|logger|monitor|launcher|campaign|viewer|tools|tests)/' \
  'runtime stands on core and messages'

never '^(planner|predictor|detector|estimator|features|executor|simulator|mavlink|ros2|dimos|semantic_mapper|mission|logger|monitor|launcher|campaign|viewer)/' '^tools/' 'tools are the top floor'
never '^(core|messages|flight_log|runtime|planner|predictor|detector|estimator|features|executor|simulator|mavlink|ros2|dimos|semantic_mapper|mission|logger|monitor|launcher|campaign|viewer|tools)/' \
  '^python/' 'the Python package stands on all others'

# Who starts the others knows how to sum up for a monitor that cannot, no messages and no other process.
never '^launcher/' '^(perception|messages|flight_log|planner|predictor|detector|estimator|features|executor|simulator|mavlink|ros2|dimos|semantic_mapper|mission|logger|campaign|viewer|tools|tests)/' \
  'the launcher stands on core, runtime and the summary'

# A process library knows its own folder, core, what channels are called, and for a recorder the messages.
for process in planner predictor detector estimator features executor simulator mavlink ros_bridge ros2 dimos semantic_mapper mission logger monitor viewer/bridge; do
  while IFS=$'\t' read -r file header; do
    case $file in "$process"/app/* | mavlink/sim/app/*) continue ;; esac
    case $header in
      "$process"/app/*) breach "$file includes $header: libraries do not know their node" ;;
      core/* | messages/channels.h | "$process"/*) ;;
      ros_messages/* | ros_bridge/*) [[ $process == ros2 || $process == dimos || $process == ros_bridge ]] ||
        breach "$file includes $header: a library knows no messages of ROS" ;;
      messages/*) [[ $process == logger ]] || breach "$file includes $header: a library knows no messages" ;;
      mavlink/frame.h | mavlink/messages.h) [[ $process == mission ]] || breach "$file includes $header: not its own" ;;
      geodesy/*) [[ $process == semantic_mapper || $process == mission ]] ||
        breach "$file includes $header: places on the earth are for mapper and mission" ;;
      perception/*) [[ $process =~ ^(simulator|predictor|planner|detector|viewer/bridge)$ ]] ||
        breach "$file includes $header: perception serves simulator, predictor, planner, detector and viewer" ;;
      executor/*) [[ $process == simulator || $process == mavlink ]] || breach "$file includes $header: not its own" ;;
      simulator/vehicle/*) [[ $file == mavlink/sim/* ]] || breach "$file includes $header: not its own" ;;
      *) breach "$file includes $header: not its own" ;;
    esac
  done < <(awk -F'\t' -v f="^$process/" -v o="$ours" '$1 ~ f && $2 ~ o' <<<"$includes")
done

# A node stands on its own process's libraries, and the two bridges to ROS-shaped messages on what they share; only tests, campaign
# and tools may host several nodes.
while IFS=$'\t' read -r file header; do
  case $file in tests/* | campaign/* | tools/* | benchmarks/* | python/*) continue ;; esac
  [[ ${header%%/app/*} == ros_bridge && $file =~ ^(ros2|dimos)/app/ ]] && continue
  [[ ${file%%/app/*} == "${header%%/app/*}" ]] || breach "$file includes $header: another process's node"
done < <(awk -F'\t' '$2 ~ /\/app\//' <<<"$includes")

# In the planner: what is given <- safety, semantics, global path <- search, optimization <- the plan.
rooms='^planner/(problem|safety|semantics|global_path|search|optimization)/'
never '^planner/problem/' '^planner/(safety|semantics|global_path|search|optimization)/' 'what is given stands on core'
never "$rooms" '^planner/([^/]+$|app/)' 'a room of the planner does not know the plan'
never '^planner/(safety|semantics|global_path)/' '^planner/(search|optimization)/' 'search and optimization stand on it'

# No circle: tsort names the files of one.
circle=$(awk -F'\t' -v o="$ours" '$2 ~ o' <<<"$includes" | tsort 2>&1 >/dev/null) || breach "includes in a circle: $circle"

# An auditor shares data types with what it audits, no algorithms.
never '^tools/audit/' '^(core/geometry/(convex_hull|separation|distance)|planner|predictor|detector|estimator|features|executor|simulator)' 'audit shares no algorithm'

# One definition of a type name per namespace: two would break the one definition rule where both are linked. Counted are
# definitions at the top of product files, outside unnamed namespaces; a forward declaration is no definition.
while IFS=$'\t' read -r name places; do
  breach "$name is defined more than once:$places"
done < <(awk '
  FILENAME ~ /^(tests|benchmarks)\// { next }
  FNR == 1 { depth = 0 }
  /^namespace .*\{$/ { depth++; scope[depth] = $2 == "{" ? "unnamed" : $2; next }
  /^}  \/\/ namespace/ { depth--; next }
  depth > 0 && scope[depth] != "unnamed" && /^(class|struct|union|enum( class)?) [A-Za-z_0-9]+ *(:( |$)|{| final|$)/ && !/^[^{]*;/ {
    name = $1 == "enum" && $2 == "class" ? $3 : $2
    sub(/[^A-Za-z_0-9].*/, "", name)
    name = scope[depth] "::" name
    places[name] = places[name] " " FILENAME ":" FNR
    if (++count[name] == 2) twice[name]
  }
  END { for (name in twice) print name "\t" places[name] }' "${sources[@]}")

# Sizes: of files, and of functions at the top of a file, from the first line of their signature to the closing brace.
while read -r lines file; do
  case $file in
    */main.cpp) limit=60 ;;
    tests/*) limit=600 ;;
    *) limit=400 ;;
  esac
  [[ $file == total ]] || ((lines <= limit)) || breach "$file has $lines lines, more than $limit"
done < <(wc -l "${sources[@]}")

while IFS=$'\t' read -r file line lines; do
  limit=50
  [[ $file != tests/* ]] || limit=65
  ((lines <= limit)) || breach "$file:$line: a function of $lines lines, more than $limit"
done < <(awk '
  FNR == 1 { start = 0 }
  /^(#|\/\/|\/\*|namespace|extern "C"|using|class |struct |enum )/ { start = 0; next }
  /^}$/ { if (start) print FILENAME "\t" start "\t" FNR - start + 1; start = 0; next }
  /^[^ \t]/ { if (!start) start = FNR }
  /^[^ \t].*[;}]$/ || /^};/ || /^}  \/\// { start = 0 }' "${sources[@]}")

# ninja -n, by which fly.sh says how much there is to build, looks no further than globs that are to be checked first.
while read -r where; do
  breach "$where: a glob with CONFIGURE_DEPENDS hides what is left to build"
done < <(grep -rnoE --include=CMakeLists.txt --exclude-dir=build 'file\(GLOB\w* \w+ CONFIGURE_DEPENDS' . || true)

((breaches == 0)) || { echo "$breaches breaches" && exit 1; }
echo "${#sources[@]} sources keep the rules"
