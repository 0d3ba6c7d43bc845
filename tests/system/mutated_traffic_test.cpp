// After a storm of mutated copies of true messages a flight goes on as before it, and its counters are true.
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <lcm/lcm-cpp.hpp>
#include <nlohmann/json.hpp>

#include "campaign/virtual_system.h"
#include "messages/channels.h"
#include "monitor/app/monitor_node.h"
#include "simulator/app/simulator_node.h"
#include "tests/support/effort.h"
#include "tests/support/traffic_mutator.h"
#include "tests/support/watched_flight.h"

namespace tern::testing {
namespace {

constexpr Duration kEvery{1'000};
constexpr int kCopiesEach = 10;
constexpr int kCopies = 90'000;

class NoiseNode final : public Node {
 public:
  NoiseNode(Bus& bus, lcm::LCM& network, std::uint64_t seed)
      : network_(network), mutator_(seed), next_(bus.clock().now()) {
    bus.listen([this](std::string_view channel, std::int64_t, std::span<const std::uint8_t> bytes) {
      mutator_.hear(channel, bytes);
    });
  }

  [[nodiscard]] UTime next_wakeup() const override { return left_ > 0 ? next_ : kNever; }
  [[nodiscard]] NodeHealth health() const override { return {ProcessState::Ready, ""}; }
  void step(UTime now) override {
    if (now < next_ || left_ == 0) return;
    next_ = now + kEvery;
    for (int k = 0; k < kCopiesEach && mutator_.has_heard(); ++k, --left_) {
      const TrafficMutator::Message copy = mutator_.next();
      network_.publish(copy.channel, copy.bytes.data(), static_cast<unsigned>(copy.bytes.size()));
    }
  }
  [[nodiscard]] int left() const { return left_; }

 private:
  lcm::LCM& network_;
  TrafficMutator mutator_;
  UTime next_;
  int left_ = kCopies;
};

class MutatedTraffic : public ::testing::TestWithParam<int> {};

TEST_P(MutatedTraffic, TheFlightReachesItsGoalAndItsCountersAreTrue) {
  VirtualSystem system(scenario_file("paper_corridor"), {"world.count=30", "timeout_s=60"});
  VirtualRunner& runner = system.runner();
  const std::string file = ::testing::TempDir() + "/mutated" + std::to_string(getpid()) + ".json";
  MonitorOptions options;
  options.summary_file = file;
  runner.start("tern-monitor",
               [&](Bus& bus) { return std::make_unique<MonitorNode>(bus, system.scenario(), options); });
  runner.run(runner.now() + Duration{20'000'000}, [&] { return system.simulator().world_zero().has_value(); });
  const auto* noise = static_cast<const NoiseNode*>(&runner.start("noise", [&](Bus& bus) {
    return std::make_unique<NoiseNode>(bus, runner.network(), static_cast<std::uint64_t>(GetParam()));
  }));
  runner.run(runner.now() + Duration{10'000'000}, [&] { return noise->left() == 0; });
  ASSERT_EQ(noise->left(), 0);
  runner.stop("noise");
  std::vector<Plan> plans;
  runner.observer().subscribe(channels::kPlan, [&](const Plan& plan) { plans.push_back(plan); });
  const UTime quiet = runner.now() + Duration{2'000'000};
  const RunResult end = runner.run(runner.now() + Duration{100'000'000});
  EXPECT_EQ(end.process, "tern-monitor");
  ASSERT_TRUE(system.simulator().result());
  expect_reached(*system.simulator().result());
  for (const Plan& plan : plans) {
    EXPECT_FALSE(plan.header.utime > quiet && plan.reason == PlanReason::StaleWorld);
  }
  std::ifstream text(file);
  const auto summary = nlohmann::json::parse(text);
  EXPECT_EQ(summary["outcome"], "reached");
  EXPECT_EQ(summary["restarts"], 0);
  std::int64_t refused = 0;
  for (const auto& [channel, count] : summary["messages"].items()) {
    EXPECT_EQ(count["lost"], 0) << channel;
    refused += count["rejected"].get<std::int64_t>();
  }
  EXPECT_GT(refused, kCopies / 2);
  std::filesystem::remove(file);
}

// The traffic, and with it each storm, differs between commits: CONFIGURATION has the version.
INSTANTIATE_TEST_SUITE_P(Seeds, MutatedTraffic, ::testing::Range(1, 1 + support::at_effort(30)));

}  // namespace
}  // namespace tern::testing
