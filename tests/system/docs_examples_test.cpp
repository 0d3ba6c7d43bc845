// The examples of docs/ fly as they are.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>

#include "campaign/virtual_system.h"
#include "messages/channels.h"
#include "runtime/config.h"
#include "runtime/scenario_file.h"
#include "simulator/app/simulator_node.h"
#include "tests/support/virtual_flight.h"
#include "tests/support/watched_flight.h"

namespace tern::testing {
namespace {

constexpr Duration kFrame{33'333};
const Vec3 kHalfExtents = Vec3::Constant(0.4);

/// Returns the centre of own_detector.py's box.
Vec3 true_centre(UTime at) { return {6.0, 2.0 * std::sin(static_cast<double>(at.us) * 1e-6), 1.0}; }

/// Publishes what own_detector.py publishes.
class OwnDetector final : public Node {
 public:
  explicit OwnDetector(Bus& bus) : bus_(bus), next_(bus.clock().now()) {}
  [[nodiscard]] UTime next_wakeup() const override { return next_; }
  void step(UTime now) override {
    if (now < next_) return;
    ObservationSet frame;
    frame.at = now;
    frame.sensor_id = 1;
    frame.sensor_position = Vec3(0, 0, 1);
    Detection box;
    box.position = true_centre(now);
    box.half_extents = kHalfExtents;
    box.variance = Vec3::Constant(1e-4);
    frame.detections.push_back(box);
    bus_.publish(channels::kObstacleObservations, frame);
    next_ = next_ + kFrame;
  }
  [[nodiscard]] NodeHealth health() const override { return {ProcessState::Ready, ""}; }

 private:
  Bus& bus_;
  UTime next_;
};

TEST(DocsExamples, AFlightByOnesOwnDetectorReachesItsGoalClearOfWhatTrulyStoodThere) {
  VirtualSystem system(TERN_EXAMPLES "/own_detector.yaml", {});
  VirtualRunner& runner = system.runner();
  runner.start("own-detector", [](Bus& bus) { return std::make_unique<OwnDetector>(bus); });
  double clearance = std::numeric_limits<double>::infinity();
  const double radius = system.scenario().uav.body.radius;
  runner.observer().subscribe(channels::kUavState, [&](const UavState& state) {
    const Vec3 apart = (state.motion.p - true_centre(state.at)).cwiseAbs() - kHalfExtents;
    clearance = std::min(clearance, apart.cwiseMax(0.0).norm() - radius);
  });
  const SimulatorNode& simulator = system.simulator();
  runner.run(runner.now() + Duration{120'000'000}, [&] { return simulator.result().has_value(); });
  ASSERT_TRUE(simulator.result());
  expect_reached(*simulator.result());
  EXPECT_GT(clearance, 0.0);
}

/// Returns the only YAML block of a page.
std::string yaml_of(const std::string& page) {
  std::ifstream file(page);
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  const std::string opening = "\n```yaml\n", closing = "\n```\n";
  const std::size_t begin = text.find(opening);
  if (begin == std::string::npos) return "";
  const std::size_t from = begin + opening.size();
  return text.substr(from, text.find(closing, from) + 1 - from);
}

TEST(DocsExamples, TheCourtyardOfTheTutorialReachesItsGoal) {
  const std::string file = TERN_EXAMPLES "/courtyard.yaml";
  std::ifstream stream(file);
  const std::string text{std::istreambuf_iterator<char>(stream), {}};
  EXPECT_EQ(text, "# The world of docs/tutorial.md.\n" + yaml_of(TERN_EXAMPLES "/../tutorial.md"));
  const VirtualFlight flight = fly_virtually(file, {});
  EXPECT_EQ(flight.end, "");
  expect_reached(flight.result);
}

TEST(DocsExamples, TheFencedFieldOfMissionsReachesItsGoal) {
  const VirtualFlight flight = fly_virtually(TERN_EXAMPLES "/fenced_field.yaml", {});
  EXPECT_EQ(flight.end, "");
  expect_reached(flight.result);
}

TEST(DocsExamples, EveryScenarioOfDocsIsFlownHere) {
  std::vector<std::string> scenarios;
  for (const auto& entry : std::filesystem::directory_iterator(TERN_EXAMPLES)) {
    if (entry.path().extension() == ".yaml") scenarios.push_back(entry.path().stem().string());
  }
  std::sort(scenarios.begin(), scenarios.end());
  EXPECT_EQ(scenarios, (std::vector<std::string>{"courtyard", "fenced_field", "own_detector"}));
}

}  // namespace
}  // namespace tern::testing
