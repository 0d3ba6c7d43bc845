#include "tests/replay/golden_flights.h"

namespace tern::testing {
namespace {

std::string scenario(const std::string& name) { return std::string(TERN_SCENARIO_FOLDER) + "/" + name + ".yaml"; }

auto stop(const std::string& process) {
  return [process](VirtualSystem& system) { system.stop(process); };
}
auto start(const std::string& process) {
  return [process](VirtualSystem& system) { system.start(process); };
}

}  // namespace

std::vector<GoldenFlight> golden_flights() {
  const std::string people = std::string(TERN_SOURCE_FOLDER) + "/tests/replay/people.yaml";
  std::vector<GoldenFlight> flights;
  flights.push_back({"corridor", {scenario("paper_corridor"), {"world.count=60", "seed=2"}, 6.0}, 2.0, 2});
  flights.push_back({"crowd", {people, {}, 5.7}, 1.0, 2});
  flights.push_back({"semantic", {scenario("corridor_demo"), {"seed=3", "semantics.cost=exposure"}, 8.0}, 4.0, 2});
  const std::string intruder =
      "world.obstacles=[{name: intruder, half_extents: 0.4, motion: waypoints, vanish: true, "
      "points: [[1, 0, 6, 10], [4, 0, -12, 10]]}]";
  const std::string box = "uav.flight_box={min: [-30, -30, -20], max: [30, 30, 40]}";
  flights.push_back(
      {"evade", {scenario("closing_in"), {intruder, "uav.start=[0, 0, 10]", "uav.goal=[0, 0, 10]", box}, 4.0}, 1.0, 1});
  flights.push_back({"stale_world",
                     {scenario("corridor_demo"),
                      {"seed=5"},
                      6.0,
                      {{2.5, stop("tern-predictor")},
                       {3.5, start("tern-predictor")},
                       {4.5, stop("tern-planner")},
                       {4.8, start("tern-planner")}}},
                     2.0,
                     2});
  return flights;
}

}  // namespace tern::testing
