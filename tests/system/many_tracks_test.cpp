// Predictions of three hundred tracks take several messages a set: all of them arrive, twenty times a second.
#include <gtest/gtest.h>

#include <iterator>
#include <map>
#include <set>

#include "campaign/virtual_system.h"
#include "messages/channels.h"
#include "simulator/app/simulator_node.h"
#include "tests/support/watched_flight.h"

namespace tern::testing {
namespace {

TEST(ManyTracks, ThreeHundredArriveCompleteTwentyTimesASecond) {
  constexpr double kSeconds = 5.0;
  constexpr int kRate = 20, kLeastBatches = 4;  // sets a second, messages a set
  VirtualSystem system(scenario_file("corridor_demo"), {"world.count=300", "simulator.min_flight_s=30"});
  VirtualRunner& runner = system.runner();
  runner.run(runner.now() + Duration{20'000'000}, [&] { return system.simulator().world_zero().has_value(); });
  ASSERT_TRUE(system.simulator().world_zero());
  std::int64_t received = 0;
  std::map<std::int64_t, std::set<std::int32_t>> sets;
  std::map<std::int64_t, std::int32_t> batches;
  runner.observer().subscribe(channels::kPredictions, [&](const TrackSet& part) {
    ++received;
    sets[part.batch.set].insert(part.batch.index);
    batches[part.batch.set] = part.batch.count;
  });
  runner.run(runner.now() + Duration::from_seconds(kSeconds));
  EXPECT_GE(received, static_cast<std::int64_t>((kSeconds * kRate - 1) * kLeastBatches))
      << "a set may come just after the end";
  ASSERT_GT(sets.size(), 2U);
  sets.erase(
      sets.begin());  // the first and the last set may have begun before, or end after, the time that is looked at
  sets.erase(std::prev(sets.end()));
  for (const auto& [set, indices] : sets) EXPECT_EQ(std::ssize(indices), batches[set]) << "set " << set;
}

}  // namespace
}  // namespace tern::testing
