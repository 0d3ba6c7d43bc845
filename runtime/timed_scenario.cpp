#include "runtime/timed_scenario.h"

namespace tern {

std::string read_goals_from(ConfigDocument& document) {
  return document.root().section("simulator").text("goals_from", "");
}

Scenario timed(Scenario scenario, const std::string& goals_from) {
  constexpr double kNoTimeoutS = 1e6;
  if (!goals_from.empty() && !scenario.timeout_s) scenario.timeout_s = kNoTimeoutS;
  return scenario;
}

}  // namespace tern
