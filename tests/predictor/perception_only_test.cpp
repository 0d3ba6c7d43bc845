// BENCHMARKS "perception only" on whole worlds: how many tracks are covered, and is every near obstacle in some box?
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <string>
#include <tuple>
#include <utility>

#include "predictor/tracking/tracker.h"
#include "simulator/sensors/sensor.h"
#include "simulator/worlds/world.h"
#include "tests/predictor/simulated_motion.h"

namespace tern {
namespace {

constexpr double kFlight = 16.0;       // s, along the straight line from start to goal
constexpr double kSurelySeen = 6.0;    // m: obstacles this near have been in range for a while
constexpr double kSameObstacle = 1.0;  // m: a track belongs to the nearest obstacle within this distance

struct Tally {
  int covered = 0, tracks = 0;       // tracks that were covered over all pieces
  int contained = 0, obstacles = 0;  // near obstacles whose centre some track's region contained
};

const WorldObstacle& nearest(const World& world, const Vec3& p, double t) {
  return *std::min_element(world.obstacles.begin(), world.obstacles.end(), [&](const auto& a, const auto& b) {
    return (a.at(t).p - p).squaredNorm() < (b.at(t).p - p).squaredNorm();
  });
}

void count(const World& world, const std::vector<Track>& tracks, const Vec3& eye, double t, double horizon,
           Tally& tally) {
  for (const Track& track : tracks) {
    const Vec3 p = track.motion.sample(track.motion.start).p;
    const WorldObstacle& obstacle = nearest(world, p, t);
    if ((obstacle.at(t).p - p).norm() > kSameObstacle) continue;
    ++tally.tracks;
    tally.covered += testing::covers(
                         track, [&](double s) { return obstacle.at(s).p; }, horizon)
                         ? 1
                         : 0;
  }
  for (const WorldObstacle& obstacle : world.obstacles) {
    const Vec3 p = obstacle.at(t).p;
    if ((p - eye).norm() > kSurelySeen) continue;
    ++tally.obstacles;
    const bool contained = std::any_of(tracks.begin(), tracks.end(), [&](const Track& track) {
      return track.bounds(track.motion.start, track.motion.start).contains(p);
    });
    tally.contained += contained ? 1 : 0;
  }
}

// Flies the sensor through two worlds of the generator and counts every third of a second.
Tally fly(const std::string& generator, int obstacles, const TrackerConfig& config) {
  Tally tally;
  for (std::uint64_t seed = 1; seed <= 2; ++seed) {
    Scenario scenario;
    scenario.seed = seed;
    scenario.world.generator = generator;
    scenario.world.count = obstacles;
    const World world = make_world(scenario, "").value();
    const SensorConfig sensor = perception_only(seed);
    Tracker tracker(config);
    for (int frame = 0; frame < static_cast<int>(kFlight * sensor.rate_hz); ++frame) {
      const double taken = (frame_taken(sensor, UTime{}, frame) - UTime{}).seconds();
      const Vec3 eye = scenario.uav.start + (scenario.uav.goal - scenario.uav.start) * (taken / kFlight);
      tracker.update(observe(world, sensor, UTime{}, frame, eye));
      if (frame < 30 || frame % 10 != 0) continue;
      const UTime now = frame_arrives(sensor, UTime{}, frame);
      count(world, tracker.predict(now), eye, (now - UTime{}).seconds(), config.prediction.horizon.seconds(), tally);
    }
  }
  return tally;
}

double share(int part, int all) { return static_cast<double>(part) / all; }

TEST(PerceptionOnly, CoversInWorldsThatMoveDifferently) {
  for (const auto& [generator, obstacles, least] :
       {std::tuple{"sando_forest", 200, 0.99}, std::tuple{"paper_corridor", 100, 0.97}}) {
    const Tally tally = fly(generator, obstacles, TrackerConfig{});
    RecordProperty(generator, std::to_string(share(tally.covered, tally.tracks)));
    EXPECT_GT(tally.tracks, 1000);
    EXPECT_GE(share(tally.covered, tally.tracks), least)
        << generator << ": " << tally.covered << " of " << tally.tracks;
    EXPECT_GE(share(tally.contained, tally.obstacles), 0.999) << tally.contained << " of " << tally.obstacles;
  }
}

}  // namespace
}  // namespace tern
