#include "simulator/worlds/world.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>

#include "tests/support/temp_folder.h"
#include "tests/support/world_digest.h"

namespace tern {
namespace {

using ::testing::HasSubstr;

ObstacleSpec spec(const std::string& name, decltype(ObstacleSpec::motion) motion) {
  ObstacleSpec o;
  o.name = name;
  o.centre = Vec3(1, 2, 3);
  o.motion = std::move(motion);
  return o;
}

/// One of each motion, after ten of a generator.
Scenario mixed_scenario() {
  Scenario s;
  s.seed = 4;
  s.world.generator = "mader_corridor";
  s.world.count = 10;
  s.world.obstacles = {
      spec("still", StaticMotion{}),
      spec("trefoil", TrefoilMotion{}),
      spec("wave", WaveMotion{Vec3::UnitX(), 1.5, 0.2}),
      spec("linear", LinearMotion{Vec3::UnitY(), 1.0 / 3.0}),
      spec("round", WaypointMotion{{{0.0, Vec3::Zero()}, {1.0 / 7, Vec3::Ones()}, {2.0, Vec3::Zero()}}, true, false}),
      spec("passer-by", WaypointMotion{{{2.0, Vec3::Zero()}, {3.0, Vec3::Ones()}}, false, true})};
  return s;
}

TEST(World, NumbersItsObstaclesGeneratedThenListed) {
  const World world = make_world(mixed_scenario(), "").value();
  ASSERT_EQ(world.obstacles.size(), 16u);
  for (std::size_t i = 0; i < 16; ++i) EXPECT_EQ(world.obstacles[i].id(), static_cast<std::int64_t>(i));
  EXPECT_EQ(world.obstacles[10].spec().name, "still");
  EXPECT_FALSE(world.obstacles[10].moves());
}

TEST(World, BeforeTimeZeroWhatMovesIsOnItsWayAndNothingThatSetsOutByThenIsThere) {
  Scenario scenario;
  const WaypointMotion walk{{{-1.0, Vec3::Zero()}, {1.0, Vec3::Ones()}}, false, true};
  scenario.world.obstacles = {spec("still", StaticMotion{}), spec("trefoil", TrefoilMotion{}),
                              spec("sets out at 0", LinearMotion{Vec3::UnitY(), 0.0}),
                              spec("sets out later", LinearMotion{Vec3::UnitY(), 3.0}), spec("comes", walk)};
  const World world = make_world(scenario, "").value();
  const auto ids = [&](double t) {
    std::vector<std::int64_t> seen;
    for (const TrueObstacle& o : true_obstacles(world, t)) seen.push_back(o.id);
    return seen;
  };
  EXPECT_EQ(ids(-1.5), (std::vector<std::int64_t>{0, 1, 3}));
  EXPECT_EQ(ids(-0.5), (std::vector<std::int64_t>{0, 1, 3, 4}));
  EXPECT_EQ(ids(0.0), (std::vector<std::int64_t>{0, 1, 2, 3, 4}));
  for (const double t : {-0.9, -0.3, 0.0, 0.4}) {
    constexpr double kStep = 1e-4;
    for (const TrueObstacle& o : true_obstacles(world, t - kStep)) {
      if (o.id == 2) continue;
      const auto later = true_obstacles(world, t + kStep);
      const auto same = std::find_if(later.begin(), later.end(), [&](const TrueObstacle& l) { return l.id == o.id; });
      ASSERT_NE(same, later.end());
      EXPECT_LT((same->position - o.position - 2.0 * kStep * o.velocity).norm(), 1e-6) << o.id << " at " << t;
    }
  }
}

TEST(World, WrittenOutAsAListIsTheSameWorld) {
  const Scenario scenario = mixed_scenario();
  const World world = make_world(scenario, "").value();
  const Scenario listed = list_obstacles(scenario, world);
  EXPECT_EQ(listed.world.generator, "none");
  EXPECT_EQ(listed.world.obstacles.size(), 16u);
  EXPECT_TRUE(listed.world.recorded.empty());
  const World again = make_world(listed, "").value();
  EXPECT_EQ(world_digest(again), world_digest(world));
  for (double t : {-1.0, 0.0, 0.123, 2.5, 17.0}) {
    const auto a = true_obstacles(world, t);
    const auto b = true_obstacles(again, t);
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t i = 0; i < a.size(); ++i) EXPECT_EQ(a[i].position, b[i].position);
  }
}

TEST(World, DigestTellsEveryNumberApart) {
  const Scenario scenario = mixed_scenario();
  const std::uint64_t digest = world_digest(make_world(scenario, "").value());
  Scenario seeded = scenario;
  seeded.seed = 5;
  EXPECT_NE(world_digest(make_world(seeded, "").value()), digest);
  Scenario shifted = scenario;
  std::get<WaveMotion>(shifted.world.obstacles[2].motion).phase += 1e-12;
  EXPECT_NE(world_digest(make_world(shifted, "").value()), digest);
}

TEST(World, TruthListsOnlyWhoIsPresent) {
  const World world = make_world(mixed_scenario(), "").value();
  EXPECT_EQ(true_obstacles(world, 1.0).size(), 15u);
  EXPECT_EQ(true_obstacles(world, 2.5).size(), 16u);
  EXPECT_EQ(true_obstacles(world, 2.5).back().velocity, Vec3::Ones());
  EXPECT_EQ(static_boxes(world).size(), 1u);
  EXPECT_EQ(static_boxes(world)[0].center(), Vec3(1, 2, 3));
}

TEST(World, PassesOnWhatIsWrongWithAnObstacleOrFile) {
  Scenario bad = mixed_scenario();
  std::get<WaveMotion>(bad.world.obstacles[2].motion).slowness = -1.0;
  EXPECT_THAT(make_world(bad, "").error().message, HasSubstr("obstacle 12 'wave': slowness -1"));
  Scenario missing;
  missing.world.recorded = {RecordedTracksSpec{}};
  missing.world.recorded[0].file = "nowhere.txt";
  missing.file = "/tmp/scenario.yaml";
  EXPECT_THAT(make_world(missing, "/tmp").error().message,
              HasSubstr("'nowhere.txt': no such file; tried /tmp/nowhere.txt"));
}

TEST(World, WithRecordedPeopleListsThemToo) {
  const TempFolder folder;
  std::ofstream(folder.file("two.txt")) << "1 0 0 9\n1 1 1 9\n1 2 2 9\n2 1 5 9\n2 3 7 9\n3 2 0 0\n";
  Scenario s;
  s.file = folder.file("scenario.yaml");
  RecordedTracksSpec recorded;
  recorded.file = "two.txt";
  recorded.columns = 4;
  recorded.frames_per_second = 1.0;
  recorded.half_extents = Vec3(0.25, 0.25, 2.0);
  recorded.centre_z = 1.5;
  recorded.start_s = 0.0;
  s.world.recorded = {recorded};
  const World world = make_world(s, "").value();
  ASSERT_EQ(world.obstacles.size(), 2u) << "who is seen in one frame only is left out";
  EXPECT_EQ(world.obstacles[0].spec().name, "two#1");
  EXPECT_EQ(world.recorded_start_s.at(0), 0.0);
  EXPECT_EQ(world.obstacles[1].at(2.0).p, Vec3(6, 9, 1.5));
  EXPECT_FALSE(world.obstacles[1].present(0.5));
  EXPECT_EQ(world_digest(make_world(list_obstacles(s, world), "").value()), world_digest(world));
}

TEST(World, WithADrawnBeginningLeavesOutWhoCrowdsTheStart) {
  const TempFolder folder;
  std::ofstream out(folder.file("two.txt"));
  for (int k = 0; k <= 10; ++k) out << "1 " << k << " 0.5 0\n2 " << k << " 5 0\n";
  out.close();
  Scenario s;
  s.file = folder.file("scenario.yaml");
  s.uav.start = Vec3(0, 0, 1);
  s.uav.goal = Vec3(10, 0, 1);
  RecordedTracksSpec recorded;
  recorded.file = "two.txt";
  recorded.columns = 4;
  recorded.frames_per_second = 1.0;
  s.world.recorded = {recorded};
  const World world = make_world(s, "").value();
  EXPECT_EQ(world.left_out, 1);
  ASSERT_EQ(world.obstacles.size(), 1U);
  EXPECT_EQ(world.obstacles[0].spec().name, "two#2");
}

}  // namespace
}  // namespace tern
