// Planner and executor with planner.heading: setpoints turn along the heading that was planned.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "core/world/heading.h"
#include "core/world/thrust.h"
#include "executor/app/executor_node.h"
#include "messages/batching.h"
#include "messages/codec.h"
#include "planner/app/planner_node.h"
#include "planner/heading/heading_planner.h"
#include "runtime/virtual_runner.h"
#include "tests/support/planner_worlds.h"
#include "tests/support/voxel_maps.h"

namespace tern {
namespace {

using namespace support;

/// Planner and executor of a vehicle that is where its setpoints are, among walls that leave gaps on alternate sides.
class Flight {
 public:
  explicit Flight(HeadingMode mode) {
    config_.heading = mode;
    uav_.goal = Vec3(24, 0, 1);
    uav_.flight_box = Box(Vec3(-3, -5, 0), Vec3(30, 5, 3));
    for (int k = 0; k < 4; ++k) {
      const Vec3 c(4.0 + 5.0 * k, k % 2 == 0 ? 2.0 : -2.0, 1.0);
      walls_.push_back(standing_box(k + 1, box_around(c, Vec3(0.2, 3, 2)), runner_.now()));
    }
    Bus& bus = runner_.observer();
    bus.subscribe(channels::kPlanHeading, [&](const PlanHeading& heading) { headings.push_back(heading); });
    bus.subscribe(channels::kSetpoint, [&](const UavState& setpoint) { setpoints.push_back(setpoint); });
    bus.subscribe(channels::kPlan, [&](const Plan& plan) { plans.emplace(plan.inputs.request, plan); });
    bus.subscribe(channels::kHorizonRequest,
                  [&](const HorizonRequest& request) { requests.emplace(request.header.name, request); });
    executor_ = &dynamic_cast<ExecutorNode&>(runner_.start(
        "tern-executor", [&](Bus& own) { return std::make_unique<ExecutorNode>(own, uav_, ExecutorConfig()); }));
    start_planner();
  }

  void restart_planner() {
    runner_.stop("tern-planner");
    run(0.4);
    start_planner();
  }

  void run(double seconds) {
    for (const UTime end = runner_.now() + Duration::from_seconds(seconds); runner_.now() < end; ++tick_) {
      tell_vehicle();
      if (tick_ % 5 == 0) tell_world();
      runner_.run(runner_.now() + Duration{10'000});
    }
  }

  [[nodiscard]] const HeadingCounters& counters() const { return executor_->heading_counters(); }
  [[nodiscard]] const std::vector<Track>& tracks() const { return walls_; }
  [[nodiscard]] double to_goal() const { return (setpoints.back().motion.p - uav_.goal).norm(); }

  std::vector<PlanHeading> headings;
  std::vector<UavState> setpoints;
  std::map<MessageName, Plan> plans;  ///< by request
  std::map<MessageName, HorizonRequest> requests;

 private:
  void start_planner() {
    PlannerExecution execution;
    execution.threaded = false;
    runner_.start("tern-planner",
                  [&](Bus& own) { return std::make_unique<PlannerNode>(own, uav_, config_, 1, execution); });
  }

  void tell_vehicle() {
    UavState state;
    state.at = runner_.now();
    state.motion.p = uav_.start;
    if (!setpoints.empty()) {
      state.at = setpoints.back().at;
      state.motion = setpoints.back().motion;
    }
    if (state.at > told_) runner_.observer().publish(channels::kUavState, state);
    told_ = state.at;
    VehicleStatus status;
    status.at = runner_.now();
    status.armed = status.following = tick_ > 50;
    status.mode = std::string(kPerfectMode);
    if (!status.following) status.why_not = "not yet";
    runner_.observer().publish(channels::kVehicleStatus, status);
  }

  void tell_world() {
    Bus& bus = runner_.observer();
    TrackSet set;
    set.batch.set = ++sets_;
    set.made_at = runner_.now();
    set.tracks = walls_;
    for (const TrackSet& batch : split_batches(set)) bus.publish(channels::kPredictions, batch);
    if (tick_ % 50 != 0) return;
    for (const MapChunk& chunk : to_chunks(free_map({8, 8, 8}))) bus.publish(channels::kSemanticMap, chunk);
    Goal goal;
    goal.id = 1;
    goal.position = uav_.goal;
    bus.publish(channels::kGoal, goal);
  }

  VirtualRunner runner_;
  UavSpec uav_;
  PlannerConfig config_;
  std::vector<Track> walls_;
  const ExecutorNode* executor_ = nullptr;
  UTime told_;
  std::int64_t tick_ = 0, sets_ = 0;
};

double apart(double a, double b) { return std::abs(std::remainder(a - b, 2.0 * M_PI)); }

/// The largest change of the yaw in the time of one setpoint, rad/s.
double fastest_turn(const std::vector<UavState>& setpoints) {
  double fastest = 0.0;
  for (std::size_t k = 1; k < setpoints.size(); ++k) {
    const double h = (setpoints[k].at - setpoints[k - 1].at).seconds();
    if (h >= 1e-3) fastest = std::max(fastest, apart(setpoints[k].yaw, setpoints[k - 1].yaw) / h);
  }
  return fastest;
}

/// The share of the second and the stopping time before the vehicle is at a place in which that place is in view, as a
/// mean over the flight.
double share_seen(const std::vector<UavState>& setpoints, double half_view) {
  constexpr double kStop = 0.35, kBefore = 1.0, kNearest = 0.3;  // s: 6 m/s at 20 m/s²; s; m
  std::int64_t seen = 0, judged = 0;
  for (const UavState& there : setpoints) {
    if (there.motion.v.norm() < 0.5) continue;
    for (const UavState& from : setpoints) {
      const double before = (there.at - from.at).seconds();
      if (before < kStop || before > kStop + kBefore) continue;
      const Vec3 way = there.motion.p - from.motion.p;
      if (way.head<2>().norm() < kNearest) continue;
      ++judged;
      seen += apart(std::atan2(way.y(), way.x()), from.yaw) <= half_view ? 1 : 0;
    }
  }
  return static_cast<double>(seen) / static_cast<double>(judged);
}

constexpr double kLongEnough = 10.0;  // s

TEST(PlannedHeading, IsSentWithEachPlanAdoptedAndFlownByTheSetpoints) {
  Flight flight(HeadingMode::Planned);
  flight.run(kLongEnough);
  EXPECT_LT(flight.to_goal(), 0.1);
  EXPECT_GT(flight.headings.size(), 50U);
  const HeadingCounters& counted = flight.counters();
  EXPECT_EQ(counted.of(HeadingVerdict::Adopted), static_cast<std::int64_t>(flight.headings.size()));
  EXPECT_EQ(counted.started_anew, 1);
  std::int64_t beside = 0;
  for (std::size_t k = 0; k + 1 < flight.headings.size(); ++k) {
    const HeadingSpline before(flight.headings[k]), next(flight.headings[k + 1]);
    const YawSample a = before.sample(next.start()), b = next.sample(next.start());
    EXPECT_LE(apart(a.yaw, b.yaw), kYawJoinTolerance);
    EXPECT_NEAR(a.rate, b.rate, kYawJoinTolerance);
    for (const UavState& s : flight.setpoints) {
      if (s.at < next.start() || s.at < flight.headings.front().start + Duration{2'000'000}) continue;
      if (k + 2 < flight.headings.size() && s.at >= flight.headings[k + 2].start) break;
      beside += apart(next.sample(s.at).yaw, s.yaw) <= 1e-6 ? 0 : 1;
    }
  }
  EXPECT_EQ(beside, 0) << "setpoints beside the heading in force";
  EXPECT_LE(fastest_turn(flight.setpoints), to_radians(120.0) * 1.001);
}

TEST(PlannedHeading, IsTheSameBytesWhenItIsPlannedAgainFromItsRecordedStart) {
  Flight flight(HeadingMode::Planned);
  flight.run(kLongEnough);
  for (const PlanHeading& heading : flight.headings) {
    auto again = plan_heading(flight.requests.at(heading.request), flight.plans.at(heading.request), flight.tracks(),
                              HeadingLimits(), {heading.control_points[0], heading.control_points[1]});
    ASSERT_TRUE(again);
    again->header = heading.header;
    ASSERT_EQ(encode(*again), encode(heading));
  }
}

TEST(PlannedHeading, IsNotSentByDefaultAndChangesNothingButTheYaw) {
  EXPECT_EQ(PlannerConfig().heading, HeadingMode::Along);
  Flight along(HeadingMode::Along), planned(HeadingMode::Planned);
  along.run(kLongEnough);
  planned.run(kLongEnough);
  EXPECT_TRUE(along.headings.empty());
  EXPECT_EQ(along.counters().verdicts, HeadingCounters().verdicts);
  ASSERT_EQ(along.setpoints.size(), planned.setpoints.size());
  for (std::size_t k = 0; k < along.setpoints.size(); ++k) {
    ASSERT_EQ(along.setpoints[k].at, planned.setpoints[k].at);
    ASSERT_EQ(along.setpoints[k].motion.p, planned.setpoints[k].motion.p);
  }
}

TEST(PlannedHeading, SeesMoreOfTheWayBeforeItIsFlownThroughThanTheDirectionOfFlight) {
  Flight along(HeadingMode::Along), planned(HeadingMode::Planned);
  along.run(kLongEnough);
  planned.run(kLongEnough);
  const double half_view = to_radians(0.5 * HeadingLimits().view_deg);
  const double by_flight = share_seen(along.setpoints, half_view), by_plan = share_seen(planned.setpoints, half_view);
  RecordProperty("along", std::to_string(by_flight));
  RecordProperty("planned", std::to_string(by_plan));
  EXPECT_GT(by_plan, by_flight + 0.03) << by_flight;
}

TEST(PlannedHeading, BeginsAnewWithANewPlannerAndTheYawNeverJumps) {
  Flight flight(HeadingMode::Planned);
  flight.run(2.5);
  flight.restart_planner();
  flight.run(kLongEnough);
  EXPECT_LT(flight.to_goal(), 0.1);
  EXPECT_GE(flight.counters().started_anew, 2);
  EXPECT_LE(fastest_turn(flight.setpoints), to_radians(120.0) * 1.001);
}

}  // namespace
}  // namespace tern
