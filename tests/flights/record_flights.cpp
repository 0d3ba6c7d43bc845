// record_flights FOLDER: records the flights that several tests read (support/recorded_flight.h), on virtual time. A
// ctest fixture: it runs once before any of them.
#include <filesystem>
#include <iostream>

#include "tests/support/eventful_flight.h"
#include "tests/support/recorded_flight.h"

namespace tern::testing {
namespace {

std::string scenario(const char* name) { return std::string(TERN_SCENARIO_FOLDER "/") + name + ".yaml"; }

/// Predictor and planner die and come back, while an intruder passes.
EventfulFlight restarts() {
  const auto stop = [](const char* process) { return [=](VirtualSystem& system) { system.stop(process); }; };
  const auto start = [](const char* process) { return [=](VirtualSystem& system) { system.start(process); }; };
  return {scenario("closing_in"),
          {"world.obstacles=[{name: intruder, half_extents: 0.4, motion: waypoints, vanish: true, "
           "points: [[1, 0, 6, 2], [4, 0, -12, 2]]}, {name: post, centre: [3, 0.2, 2], half_extents: [0.3, 0.3, 2]}]",
           "uav.goal=[8, 0, 2]"},
          5.0,
          {{1.5, stop("tern-predictor")},
           {2.0, start("tern-predictor")},
           {3.0, stop("tern-planner")},
           {3.2, start("tern-planner")}}};
}

void record_all(const std::filesystem::path& folder) {
  std::filesystem::remove_all(folder);
  std::filesystem::create_directories(folder);
  const auto log = [&](const char* name) { return (folder / name).string() + ".lcm"; };
  record_flight(scenario("corridor_demo"), {"world.count=40", "uav.goal=[24, 0, 1]", "executor.rate_hz=10"},
                log("demo"));
  record_flight(scenario("corridor_demo"), {"world.count=100", "uav.goal=[6, 0, 1]"}, log("crowded"));
  record_flight(scenario("quadrotor_corridor"),
                {"world.count=5", "uav.goal=[20, 0, 1]", "simulator.wind.burst=40", "simulator.wind.burst_at_s=3"},
                log("gust"));
  record_flight(scenario("closing_in"), {"seed=1"}, log("closing_in"));
  record_flight(scenario("perception_only"), {"simulator.sensor.range_m=2"}, log("short_sighted"));
  record_flight(scenario("u_trap_map"),
                {"simulator.estimation=vio", "simulator.vehicle=quadrotor", "simulator.quadrotor.class=racer",
                 "uav.dynamics={thrust_min: 2, thrust_max: 39.2, tilt_max: 70, body_rate_max: 900}"},
                log("estimated"));
  record_virtually(restarts(), log("restarts"));
}

}  // namespace
}  // namespace tern::testing

int main(int argc, char** argv) {
  if (argc != 2) {
    std::cerr << "record_flights FOLDER\n";
    return 2;
  }
  tern::testing::record_all(argv[1]);
}
