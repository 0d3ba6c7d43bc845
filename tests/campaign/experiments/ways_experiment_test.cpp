#include "campaign/experiments/ways_experiment.h"

#include <gtest/gtest.h>

#include "tests/support/effort.h"

namespace tern {
namespace {

const ChosenWay& way_of(const std::vector<ChosenWay>& ways, int world, WayChooser chooser) {
  return ways[static_cast<std::size_t>(world * kWayChoosers) + static_cast<std::size_t>(chooser)];
}

TEST(WaysExperiment, WithoutWrongLabelsThePriceIsTheOracles) {
  WaysOptions options;
  options.worlds = support::at_effort(20);
  options.wrong_share = 0.0;
  const std::vector<ChosenWay> ways = choose_ways(options);
  ASSERT_EQ(ways.size(), static_cast<std::size_t>(options.worlds * kWayChoosers));
  for (int world = 0; world < options.worlds; ++world) {
    const ChosenWay& oracle = way_of(ways, world, WayChooser::Oracle);
    EXPECT_EQ(oracle.wrong_labels, 0);
    EXPECT_EQ(way_of(ways, world, WayChooser::Price).cost_m, oracle.cost_m);
    EXPECT_NEAR(oracle.cost_m, oracle.way_m + 20.0 * (oracle.sigma_goal_m + oracle.sigma_worst_m), 1e-9);
    EXPECT_NEAR(way_of(ways, world, WayChooser::Shortest).way_m, 80.0, 1e-9);
  }
  EXPECT_EQ(regret(ways, WayChooser::Price).mean, 0.0);
  EXPECT_EQ(to_csv(ways), to_csv(choose_ways(options)));
}

TEST(WaysExperiment, WrongLabelsAreDrawnForThePlannerAlone) {
  WaysOptions options;
  options.worlds = 1;
  options.wrong_share = 1.0;
  const std::vector<ChosenWay> wrong = choose_ways(options);
  options.wrong_share = 0.0;
  const std::vector<ChosenWay> right = choose_ways(options);
  EXPECT_EQ(way_of(wrong, 0, WayChooser::Price).wrong_labels, way_of(wrong, 0, WayChooser::Price).regions);
  EXPECT_EQ(way_of(wrong, 0, WayChooser::Oracle).cost_m, way_of(right, 0, WayChooser::Oracle).cost_m);
  EXPECT_EQ(way_of(wrong, 0, WayChooser::Shortest).cost_m, way_of(right, 0, WayChooser::Shortest).cost_m);
}

}  // namespace
}  // namespace tern
