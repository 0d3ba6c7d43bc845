#include "campaign/experiments/semantic_flights.h"

#include <fmt/format.h>

#include <stdexcept>

#include "core/world/names.h"
#include "planner/planner_build.h"

namespace tern {
namespace {

constexpr double kLambda = 2.0;  ///< of the paper's section 6.2

const SemanticWorld& world_of(const std::string& scenario) {
  for (const SemanticWorld& world : semantic_worlds()) {
    if (world.scenario == scenario) return world;
  }
  throw std::invalid_argument("no semantic world " + scenario);
}

}  // namespace

const std::vector<SemanticMethod>& semantic_methods() {
  static const std::vector<SemanticMethod> kMethods = {
      {"off", {"semantics.enabled=false"}},
      {"mean_distance", {"semantics.cost=mean_distance", "planner.semantic_path=false"}},
      {"mean_distance+path", {"semantics.cost=mean_distance"}},
      {"exposure", {"semantics.cost=exposure", "planner.semantic_path=false"}},
      {"exposure+path", {"semantics.cost=exposure"}}};
  return kMethods;
}

const SemanticMethod& semantic_method(const std::string& name) {
  for (const SemanticMethod& method : semantic_methods()) {
    if (method.name == name) return method;
  }
  throw std::invalid_argument("no semantic method " + name);
}

const std::vector<SemanticWorld>& semantic_worlds() {
  static const std::vector<SemanticWorld> kWorlds = {{"paper_attract", "semantics.lambda_attractive", true},
                                                     {"paper_repel", "semantics.lambda_repulsive", false}};
  return kWorlds;
}

SemanticFlight semantic_flight(const SemanticCase& flown, const FlightRecord& record) {
  const FlightResult& r = record.result;
  return {flown,
          record.seed,
          r.outcome,
          r.flight_time_s,
          r.path_length_m,
          r.min_clearance_m,
          r.exposure.empty() ? Exposure{} : r.exposure.front()};
}

std::vector<SemanticCase> on_off_cases() {
  std::vector<SemanticCase> cases;
  for (const SemanticWorld& world : semantic_worlds()) {
    cases.push_back({world.scenario, "off", 0.0});
    for (const char* method : {"mean_distance", "exposure+path"}) cases.push_back({world.scenario, method, kLambda});
  }
  return cases;
}

std::vector<SemanticCase> sweep_cases() {
  std::vector<SemanticCase> cases;
  for (const SemanticWorld& world : semantic_worlds()) {
    cases.push_back({world.scenario, "off", 0.0});
    for (const SemanticMethod& method : semantic_methods()) {
      if (method.name == "off") continue;
      for (const double lambda : kSweepLambdas) cases.push_back({world.scenario, method.name, lambda});
    }
  }
  return cases;
}

std::vector<std::string> overrides_of(const SemanticCase& wanted) {
  std::vector<std::string> overrides = semantic_method(wanted.method).overrides;
  if (wanted.method != "off")
    overrides.push_back(fmt::format("{}={}", world_of(wanted.world).lambda_key, wanted.lambda));
  overrides.insert(overrides.end(), {"uav.flight_box.min=[-100, -100, 0]", "uav.flight_box.max=[200, 100, 4]"});
  return overrides;
}

std::string to_csv(const std::vector<SemanticFlight>& flights) {
  std::string text =
      "world,method,lambda,seed,outcome,flight_time_s,path_length_m,min_clearance_m,inside_m,inside_s,near_m,near_s,"
      "planner\n";
  for (const SemanticFlight& f : flights) {
    text += fmt::format("{},{},{},{},{},{:.4f},{:.4f},{:.4f},{:.4f},{:.4f},{:.4f},{:.4f},{:016x}\n", f.flown.world,
                        f.flown.method, f.flown.lambda, f.seed, to_string(f.outcome), f.flight_time_s, f.path_length_m,
                        f.min_clearance_m, f.exposure.metres, f.exposure.seconds, f.exposure.near_metres,
                        f.exposure.near_seconds, planner_build());
  }
  return text;
}

}  // namespace tern
