// The worlds of all scenarios, written to a scenario file and read back.
#include <gtest/gtest.h>

#include <filesystem>

#include "runtime/scenario_file.h"
#include "simulator/worlds/world.h"
#include "tests/support/world_digest.h"

namespace tern {
namespace {

#ifdef TERN_DATA_FOLDER
constexpr const char* kData = TERN_DATA_FOLDER;
#else
constexpr const char* kData = "";
#endif

Scenario read(const std::string& yaml, const std::string& file) {
  ConfigDocument document = ConfigDocument::parse(yaml, file);
  return read_scenario(document);
}

std::size_t waypoints(const World& world) {
  std::size_t all = 0;
  for (const WorldObstacle& o : world.obstacles) {
    if (const auto* motion = std::get_if<WaypointMotion>(&o.spec().motion)) all += motion->points.size();
  }
  return all;
}

TEST(ScenarioWorlds, SurviveBeingListedWrittenAndReadBack) {
  int worlds = 0;
  for (const auto& entry : std::filesystem::directory_iterator(TERN_SCENARIO_FOLDER)) {
    if (entry.path().extension() != ".yaml") continue;
    ConfigDocument document = ConfigDocument::load(entry.path().string(), {});
    const Scenario scenario = read_scenario(document);
    if (!scenario.world.recorded.empty() && *kData == '\0') continue;
    const auto world = make_world(scenario, kData);
    ASSERT_TRUE(world) << entry.path() << ": " << world.error().message;
    if (waypoints(*world) > 40'000) continue;  // a whole recording: more values than a file may hold
    const Scenario listed = read(write_scenario(list_obstacles(scenario, *world)), "listed.yaml");
    EXPECT_EQ(world_digest(make_world(listed, "").value()), world_digest(*world)) << entry.path();
    EXPECT_EQ(listed.world.obstacles.size(), world->obstacles.size());
    EXPECT_EQ(listed.uav.goal, scenario.uav.goal);
    ++worlds;
  }
  EXPECT_GE(worlds, 8);
}

}  // namespace
}  // namespace tern
