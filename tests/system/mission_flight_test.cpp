// Missions on virtual time: waypoints without stops, fences, restarts.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <memory>
#include <optional>

#include "campaign/virtual_system.h"
#include "messages/channels.h"
#include "mission/app/mission_node.h"
#include "runtime/config.h"
#include "simulator/app/simulator_node.h"
#include "tests/mission/station_link.h"
#include "tests/support/temp_folder.h"
#include "tests/support/watched_flight.h"

namespace tern::testing {
namespace {

using ::testing::HasSubstr;

class MissionFlight : public ::testing::Test {
 protected:
  /// Loads the example's field with a mission: one of the examples, or the content of a CSV file.
  void load(const std::string& mission = "square.csv", std::vector<std::string> overrides = {}) {
    const std::string examples = TERN_EXAMPLES, own = folder_.file("own.csv");
    const bool is_own = mission.find('\n') != std::string::npos;
    if (is_own) std::ofstream(own) << mission;
    overrides.push_back("simulator.goals_from=tern-mission");
    overrides.push_back("mission.file=" + (is_own ? own : mission));
    system_ = std::make_unique<VirtualSystem>(examples + "/fenced_field.yaml", overrides);
    system_->runner().observer().subscribe(channels::kVehicleTruth, [this](const UavState& s) { flown_.push_back(s); });
    system_->runner().observer().subscribe(channels::kHeartbeat, [this](const Heartbeat& h) {
      if (h.process == "tern-mission") said_ = h.waiting_for;
    });
  }
  [[nodiscard]] const std::optional<FlightResult>& result() const { return system_->simulator().result(); }
  RunResult fly(double seconds) {
    VirtualRunner& runner = system_->runner();
    return runner.run(runner.now() + Duration::from_seconds(seconds), [this] { return result().has_value(); });
  }
  /// Smallest distance of the flight from p, m.
  [[nodiscard]] double nearest(const Vec3& p) const {
    double distance = 1e9;
    for (const UavState& state : flown_) distance = std::min(distance, (state.motion.p - p).norm());
    return distance;
  }
  /// The smallest speed from take-off until the vehicle comes within `reach` of p for the first time, m/s. It has taken
  /// off once it is faster than 1 m/s.
  [[nodiscard]] double slowest_on_the_way_to(const Vec3& p, double reach) const {
    double slowest = 1e9;
    bool has_taken_off = false;
    for (const UavState& state : flown_) {
      const double speed = state.motion.v.norm();
      has_taken_off = has_taken_off || speed > 1.0;
      if (has_taken_off) slowest = std::min(slowest, speed);
      if ((state.motion.p - p).norm() < reach) return slowest;
    }
    ADD_FAILURE() << p.transpose() << " was never reached";
    return 0.0;
  }
  /// The longest time for which the vehicle rested within 0.3 m of p, s.
  [[nodiscard]] double rested_at(const Vec3& p) const {
    double longest = 0.0;
    std::optional<UTime> since;
    for (const UavState& state : flown_) {
      const bool rests = state.motion.v.norm() < 0.1 && (state.motion.p - p).norm() < 0.3;
      if (!rests) since.reset();
      if (rests && !since) since = state.at;
      if (since) longest = std::max(longest, (state.at - *since).seconds());
    }
    return longest;
  }
  /// Every place of the body lies inside the field and outside the pond.
  void expect_inside(const Box& field, double pond_radius) const {
    const double body = system_->scenario().uav.body.radius;
    const Box places(field.min() + Vec3::Constant(body), field.max() - Vec3::Constant(body));
    for (const UavState& state : flown_) {
      const Vec3& p = state.motion.p;
      ASSERT_TRUE(places.contains(p)) << p.transpose();
      ASSERT_GE((p.head<2>() - Eigen::Vector2d(10, 8)).norm(), pond_radius + body) << p.transpose();
    }
  }

  TempFolder folder_;
  std::unique_ptr<VirtualSystem> system_;
  std::vector<UavState> flown_;
  std::string said_;
};

TEST_F(MissionFlight, PassesItsWaypointsWithoutAStopHoldsAndStaysInsideItsFences) {
  load();
  fly(120.0);
  ASSERT_TRUE(result().has_value()) << said_;
  expect_reached(*result());
  for (const Vec3& p : {Vec3(20, 0, 2), Vec3(20, 10, 3)}) EXPECT_LE(nearest(p), 2.0) << p.transpose();
  EXPECT_GE(slowest_on_the_way_to({0, 10, 2}, 3.0), 0.5);
  EXPECT_GE(rested_at({0, 10, 2}), 0.9) << "the hold of 1 s";
  EXPECT_EQ(result()->stops, 2) << "the hold, and the end";
  expect_inside(Box(Vec3(-3, -3, 0), Vec3(23, 13, 6)), 2.0);
}

TEST_F(MissionFlight, FliesAPlanOfQGroundControlInsideItsFences) {
  load("site.plan");
  fly(120.0);
  ASSERT_TRUE(result().has_value()) << said_;
  expect_reached(*result());
  EXPECT_LE(nearest({20, 0, 2}), 2.1);
  EXPECT_GE(rested_at({0, 10, 2}), 0.9);
  expect_inside(Box(Vec3(-2.6, -2.6, 0), Vec3(22.6, 12.6, 6)), 2.5);
}

TEST_F(MissionFlight, LandsAboveItsPlace) {
  load("x,y,z,action\n5,0,3,\n5,-2,0,land\n");
  fly(60.0);
  ASSERT_TRUE(result().has_value()) << said_;
  expect_reached(*result());
  EXPECT_LE(nearest({5, -2, 3}), 2.0) << "it descends from above";
  EXPECT_GE(rested_at({5, -2, 1}), 0.1) << "mission.landing_height_m";
}

TEST_F(MissionFlight, GoesOnAfterMissionExecutorAndPlannerWereRestarted) {
  load();
  fly(9.0);
  for (const char* process : {"tern-mission", "tern-executor", "tern-planner"}) {
    ASSERT_FALSE(result().has_value());
    system_->stop(process);
    fly(0.5);
    system_->start(process);
    fly(3.0);
  }
  fly(120.0);
  ASSERT_TRUE(result().has_value()) << said_;
  expect_reached(*result());
  EXPECT_LE(nearest({20, 10, 3}), 2.0);
  EXPECT_LE(nearest({0, 10, 2}), 0.3);
}

TEST_F(MissionFlight, RefusesAWaypointBeyondAFenceBeforeTheFlight) {
  load("x,y,z\n10,8,2\n0,0,1\n");
  const RunResult run = fly(60.0);
  EXPECT_EQ(run.end, RunEnd::Finished);
  EXPECT_EQ(run.process, "tern-mission");
  EXPECT_EQ(run.exit_code, 2);
  EXPECT_FALSE(system_->simulator().world_zero().has_value());
}

TEST_F(MissionFlight, RefusesByNameWhatCannotBeFlown) {
  for (const auto& [mission, why] :
       {std::pair{"x,y,z\n30,0,2\n",
                  "waypoint 1 at (30.00, 0.00, 2.00) m is outside the "
                  "flight box by 5.10 m on x"},
        std::pair{"x,y,z,speed\n5,0,2,9\n", "has a speed of 9 m/s; that of the vehicle is 4"}}) {
    try {
      load(mission);
      FAIL() << "not refused";
    } catch (const ConfigError& e) {
      EXPECT_THAT(e.what(), HasSubstr(why));
    }
  }
}

TEST_F(MissionFlight, EndsWhenAWaypointCannotBeReached) {
  load("x,y,z\n0,10,2\n",
       {"world.fences=[{kind: exclusion, corners: [[-5, 5], [25, 5], [25, 6], [-5, 6]]}]", "world.obstacles=[]"});
  fly(120.0);
  ASSERT_TRUE(result().has_value()) << said_;
  EXPECT_EQ(result()->outcome, FlightOutcome::Timeout);
  EXPECT_THAT(result()->detail, HasSubstr("waypoint 1 was not reached within"));
}

TEST_F(MissionFlight, FollowsATrackThatMovesAtFourMetresPerSecond) {
  load("x,y,z,action,hold_s,track\n-3,0,1,follow,6,0\n",
       {"world.fences=[]", "uav.flight_box.max=[60, 15, 8]", "uav.limits.v_max=6",
        "world.obstacles=[{centre: [6, 4, 1], half_extents: [0.3, 0.3, 0.9], motion: linear, velocity: [4, 0, 0], "
        "from_s: 2}]"});
  fly(60.0);
  ASSERT_TRUE(result().has_value()) << said_;
  expect_reached(*result());
  EXPECT_GT(flown_.back().motion.p.x(), 15.0);
  const UTime zero = system_->simulator().world_zero().value();
  for (const UavState& state : flown_) {
    if (flown_.back().at - state.at > Duration{3'000'000}) continue;
    const double place = 6.0 + 4.0 * ((state.at - zero).seconds() - 2.0) - 3.0;
    ASSERT_LT((place - state.motion.p.x()) / 4.0, 2.0) << "s behind its place beside the track";
  }
}

TEST_F(MissionFlight, FliesItsLegsAtTheirSpeeds) {
  load("x,y,z,speed\n0,10,2,1\n20,10,2,3\n20,0,2,\n", {"world.fences=[]", "world.obstacles=[]"});
  fly(120.0);
  ASSERT_TRUE(result().has_value()) << said_;
  expect_reached(*result());
  double first = 0.0, second = 0.0, third = 0.0;  // the largest speeds of the legs, m/s
  for (const UavState& state : flown_) {
    const Vec3 p = state.motion.p;
    const double speed = state.motion.v.head<2>().norm();
    if (p.x() < 1.0 && p.y() < 7.0) first = std::max(first, speed);
    if (p.y() > 8.5 && p.x() > 3.0 && p.x() < 17.0) second = std::max(second, speed);
    if (p.x() > 18.5 && p.y() < 7.0) third = std::max(third, speed);
  }
  EXPECT_NEAR(first, 1.0, 0.1);
  EXPECT_NEAR(second, 3.0, 0.3);
  EXPECT_NEAR(third, 4.0, 0.2);
  EXPECT_EQ(result()->stops, 1) << "the legs become faster, so it rests at the end alone";
}

TEST_F(MissionFlight, SlowsDownForASlowerLegWithoutAStop) {
  load("x,y,z,speed\n20,0,2,\n20,10,2,1\n", {"world.fences=[]", "world.obstacles=[]"});
  fly(120.0);
  ASSERT_TRUE(result().has_value()) << said_;
  expect_reached(*result());
  EXPECT_LE(nearest({20, 0, 2}), 2.0);
  EXPECT_LT(rested_at({20, 0, 2}), 0.2);
  for (const UavState& state : flown_) {
    const bool is_slow_leg = state.motion.p.y() > 1.0;
    ASSERT_LT(state.motion.v.head<2>().norm(), is_slow_leg ? 1.0 * 1.23 + 0.05 : 1e3);
  }
}

/// A flight of a mission that a ground station uploads, with fences.
class UploadedFlight : public MissionFlight {
 protected:
  /// The field without obstacles and fences of its own; a tern-mission that the test is the ground station of.
  void load_field() {
    load("square.csv", {"world.fences=[]", "world.obstacles=[]", "mission.fence_uploads=true"});
    system_->stop("tern-mission");
    start_mission();
    system_->runner().observer().subscribe(channels::kSemanticMap, [this](const MapChunk&) { ++chunks_; });
  }
  void start_mission() {
    system_->runner().start("tern-mission", [&](Bus& bus) {
      mission::MissionSetup setup;
      setup.site.home = system_->scenario().uav.start;
      setup.uav = system_->scenario().uav;
      setup.folder = folder_.file("");
      setup.link = std::make_unique<mission::testing::StationLink>(cable_, sent_);
      setup.fence_uploads = true;
      return std::make_unique<mission::MissionNode>(bus, std::move(setup));
    });
  }
  /// Uploads a mission straight through a circle to stay out of, inside a field to stay in, and starts it.
  void order_flight() {
    using namespace mission;
    const std::vector<Step> steps{{"there", 1, Action::Stop, Vec3(20, 0, 2), 0.0, 0.0, 0}};
    mission::testing::upload(cable_, items_of(steps, Site{}), kMissionType);
    auto fences = mission::testing::rectangle(mission::testing::kPolygonInclusion, -3, -3, 23, 13);
    fences.push_back(mission::testing::fence_item(mission::testing::kCircleExclusion, 2.0F, 10, 0));
    mission::testing::upload(cable_, fences, kFenceType);
    fly(5.0);
    mavlink::CommandLong start;
    start.command = 300;
    start.target_system = start.target_component = 1;
    mission::testing::send(cable_, start);
  }
  void expect_fences_kept() const {
    const double body = system_->scenario().uav.body.radius;
    for (const UavState& state : flown_) {
      const Vec3& p = state.motion.p;
      ASSERT_GE((p.head<2>() - Eigen::Vector2d(10, 0)).norm(), 2.0 + body) << p.transpose();
      ASSERT_GE(p.head<2>().minCoeff(), -3.0 + body) << p.transpose();
      ASSERT_LE(p.x(), 23.0 - body) << p.transpose();
      ASSERT_LE(p.y(), 13.0 - body) << p.transpose();
    }
  }

  mission::testing::Cable cable_;
  std::vector<mavlink::Frame> sent_;
  int chunks_ = 0;
};

TEST_F(UploadedFlight, FliesAroundAnUploadedFenceInItsStraightWay) {
  load_field();
  fly(2.0);
  order_flight();
  fly(120.0);
  ASSERT_TRUE(result().has_value()) << said_;
  expect_reached(*result());
  expect_fences_kept();
}

TEST_F(UploadedFlight, KeepsItsFencesIfMapperAndMissionAreRestartedInFlight) {
  load_field();
  fly(2.0);
  order_flight();
  fly(1.5);
  ASSERT_FALSE(result().has_value());
  system_->stop("tern-mission");
  system_->stop("tern-mapper");
  chunks_ = 0;
  system_->start("tern-mapper");
  fly(2.0);
  EXPECT_EQ(chunks_, 0) << "a map without the fences is never published";
  start_mission();
  fly(120.0);
  ASSERT_TRUE(result().has_value()) << said_;
  expect_reached(*result());
  expect_fences_kept();
  EXPECT_GT(chunks_, 0);
}

}  // namespace
}  // namespace tern::testing
