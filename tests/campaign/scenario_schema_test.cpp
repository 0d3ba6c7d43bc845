// The JSON schema of scenarios, checked against the scenarios of the project.
#include "campaign/scenario_schema.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>

#include "campaign/flight_inputs.h"
#include "runtime/config.h"

namespace tern {
namespace {

using nlohmann::json;

/// Whether the schema has a place for this key: "world.obstacles[].centre".
bool knows(json at, const std::string& path) {
  std::istringstream parts(path);
  for (std::string part; std::getline(parts, part, '.');) {
    const bool is_list = part.ends_with("[]");
    if (is_list) part.resize(part.size() - 2);
    if (at.contains("properties") && at["properties"].contains(part)) {
      at = json(at["properties"][part]);
    } else if (at.contains("additionalProperties") && at["additionalProperties"].is_object()) {
      at = json(at["additionalProperties"]);
    } else {
      return false;
    }
    if (is_list) at = json(at["items"]);
  }
  return true;
}

TEST(ScenarioSchema, KnowsEveryKeyThatAScenarioSays) {
  const json schema = json::parse(scenario_schema());
  int files = 0;
  for (const auto& file : std::filesystem::directory_iterator(TERN_SCENARIOS)) {
    if (file.path().extension() != ".yaml") continue;
    ++files;
    ConfigDocument document = ConfigDocument::load(file.path().string(), {});
    read_every_section(document);
    for (const Knob& knob : document.knobs()) EXPECT_TRUE(knows(schema, knob.path)) << file.path() << ": " << knob.path;
  }
  EXPECT_GE(files, 20);
  EXPECT_FALSE(knows(schema, "uav.dynamics.thrust"));
}

}  // namespace
}  // namespace tern
