// The pages "From your drone to Tern": their scenarios fly behind a simulated autopilot of the page's kind.
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>

#include "tests/support/flight_behind_mavlink.h"
#include "tests/support/temp_folder.h"
#include "tests/support/watched_flight.h"

namespace tern::testing {
namespace {

using mavlink::BridgeConfig;
using mavlink::FlownBehindMavlink;
using mavlink::Manners;
using mavlink::SimulatedAutopilotConfig;

/// Returns the only YAML block of a page.
std::string yaml_of(const std::string& page) {
  std::ifstream file(TERN_HOWTO "/" + page);
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  const std::string opening = "\n```yaml\n", closing = "\n```\n";
  const std::size_t begin = text.find(opening);
  if (begin == std::string::npos || text.find(opening, begin + 1) != std::string::npos) return "";
  const std::size_t from = begin + opening.size();
  return text.substr(from, text.find(closing, from) + 1 - from);
}

struct Page {
  const char* file;
  Manners manners;
};

class StackPages : public ::testing::TestWithParam<Page> {};

TEST_P(StackPages, TheScenarioFliesWithASimulatedAutopilotAndLands) {
  const std::string yaml = yaml_of(GetParam().file);
  ASSERT_NE(yaml, "") << GetParam().file << " has one block of YAML";
  const TempFolder folder;
  const std::string file = folder.file("first.yaml");
  std::ofstream(file) << yaml;

  BridgeConfig bridge = ConfigDocument::load(file, {}).root().section("mavlink").read<BridgeConfig>();
  EXPECT_EQ(bridge.external_vision, yaml.find("external_vision: true") != std::string::npos);
  bridge.set_parameters = bridge.without_remote = true;
  SimulatedAutopilotConfig autopilot;
  autopilot.manners = GetParam().manners;
  const FlownBehindMavlink flown = mavlink::fly_behind_mavlink(file, {}, bridge, autopilot);
  ASSERT_TRUE(flown.result) << flown.why_not;
  expect_reached(*flown.result);
  EXPECT_TRUE(flown.landed) << flown.why_not;
  EXPECT_EQ(flown.tube_exits, 0);
}

INSTANTIATE_TEST_SUITE_P(Pages, StackPages,
                         ::testing::Values(Page{"drone_px4.md", Manners::Px4},
                                           Page{"drone_ardupilot.md", Manners::ArduPilot},
                                           Page{"drone_mocap.md", Manners::Px4},
                                           Page{"drone_fast_lio2.md", Manners::Px4},
                                           Page{"drone_dimos.md", Manners::Px4}),
                         [](const auto& tested) {
                           const std::string file = tested.param.file;
                           return file.substr(0, file.find('.'));
                         });

}  // namespace
}  // namespace tern::testing
