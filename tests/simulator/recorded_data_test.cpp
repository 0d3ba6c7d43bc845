// Tests on recordings that are not part of the project (docs/howto/get_data.md says where to get them).
#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "simulator/worlds/declared_motions.h"
#include "simulator/worlds/drawn_recordings.h"
#include "simulator/worlds/generators.h"
#include "simulator/worlds/recorded_tracks.h"
#include "simulator/worlds/world.h"
#include "tests/support/world_digest.h"

namespace tern {
namespace {

constexpr const char* kData = TERN_DATA_FOLDER;

RecordedTracksSpec hermes() {
  RecordedTracksSpec spec;
  spec.file = "crowd/hermes_bo-360-090-090.txt";
  spec.metres_per_unit = 0.01;
  spec.frames_per_second = 16.0;
  spec.half_extents = Vec3(0.25, 0.25, 1.5);
  spec.centre_z = 1.5;
  return spec;
}

/// frame id x z y vx vz vy; annotations are 0.4 s apart.
RecordedTracksSpec eth(const std::string& name, double frames_per_second) {
  RecordedTracksSpec spec;
  spec.file = "crowd/eth_seq_" + name + "_obsmat.txt";
  spec.columns = 8;
  spec.id_column = 1;
  spec.frame_column = 0;
  spec.x_column = 2;
  spec.y_column = 4;
  spec.frames_per_second = frames_per_second;
  return spec;
}

std::vector<RecordedTrack> load(const RecordedTracksSpec& spec) {
  return load_recorded_tracks(find_track_file(spec.file, "", kData).value(), spec).value().tracks;
}

void expect_walking(const std::vector<RecordedTrack>& tracks, double fastest) {
  for (const RecordedTrack& track : tracks) {
    for (std::size_t i = 1; i < track.points.size(); ++i) {
      const double dt = track.points[i].first - track.points[i - 1].first;
      EXPECT_LT((track.points[i].second - track.points[i - 1].second).norm(), fastest * dt) << track.id;
    }
  }
}

TEST(Hermes, HoldsPeopleWhoWalkInACorridor) {
  const auto tracks = load(hermes());
  EXPECT_EQ(tracks.size(), 214u);
  Box area;
  for (const RecordedTrack& track : tracks) {
    for (const auto& [t, p] : track.points) area.extend(p);
  }
  EXPECT_GE(area.min().x(), -1.5);  // 0 in the corridor itself; people gather beyond its ends
  EXPECT_LE(area.max().x(), 5.0);
  EXPECT_GE(area.min().y(), -7.3);
  EXPECT_LE(area.max().y(), 7.1);
  EXPECT_EQ(area.min().z(), 1.5);
  expect_walking(tracks, 4.0);
}

TEST(EthWalking, LoadsBothFilesByColumnsAndRate) {
  const auto eth_tracks = load(eth("eth", 15.0));
  const auto hotel_tracks = load(eth("hotel", 25.0));
  EXPECT_GT(eth_tracks.size(), 300u);
  EXPECT_GT(hotel_tracks.size(), 300u);
  for (const auto& tracks : {eth_tracks, hotel_tracks}) {
    for (const RecordedTrack& track : tracks) {
      if (track.points.size() > 1) {
        EXPECT_NEAR(track.points[1].first - track.points[0].first, 0.4, 0.41);
      }
    }
    expect_walking(tracks, 5.0);
  }
}

Scenario crowd(double start_s) {
  Scenario s;
  s.uav.start = Vec3(1.8, -5, 1);
  s.uav.goal = Vec3(1.8, 5, 1);
  s.world.recorded = {hermes()};
  s.world.recorded[0].start_s = start_s;
  return s;
}

TEST(Crowd, FlightsStartAtAFrameThatLeavesTheStartClear) {
  double before = -1.0;
  for (int k = 1; k <= 10; ++k) {
    const World world = make_world(crowd(2.0 * k), kData).value();
    const double start = world.recorded_start_s.at(0);
    EXPECT_GE(start, 2.0 * k);
    EXPECT_EQ(start * 16.0, std::round(start * 16.0)) << "a whole frame";
    EXPECT_GE(start, before);
    before = start;
    for (double t = 0.0; t <= 1.0; t += 0.01) {
      for (const TrueObstacle& person : true_obstacles(world, t)) {
        EXPECT_GE((person.position - Vec3(1.8, -5, 1)).head<2>().norm(), 0.97) << "the rule looks every 10 ms";
      }
    }
  }
}

TEST(Crowd, IsTheSameWorldWhenListed) {
  const Scenario scenario = crowd(6.0);
  const World world = make_world(scenario, kData).value();
  EXPECT_GT(world.obstacles.size(), 150u);
  EXPECT_EQ(world_digest(make_world(list_obstacles(scenario, world), "").value()), world_digest(world));
}

TEST(Crowd, DeclaresWhoWalksExactly) {
  const World world = make_world(crowd(6.0), kData).value();
  const UTime zero{1'000'000};
  for (std::int64_t at = 0; at < 20'000'000; at += 1'700'000) {
    const UTime from = zero + Duration{at};
    const TrackSet set = declare_motions(world, zero, from, from + Duration::from_seconds(3.5));
    EXPECT_FALSE(set.tracks.empty());
    for (const Track& track : set.tracks) {
      for (Duration d{}; d < Duration::from_seconds(3.5); d = d + Duration{33'333}) {
        const UTime t = from + d;
        if (t < track.motion.start || t > track.motion.end()) continue;
        const Vec3 truth = world.obstacles[static_cast<std::size_t>(track.id)].at((t - zero).seconds()).p;
        EXPECT_LT((track.motion.sample(t).p - truth).cwiseAbs().maxCoeff(), kFitRounding);
      }
    }
  }
}

/// The number of different flights among 200 seeds.
std::size_t different_starts(const RecordedTracksSpec& spec, const UavSpec& uav) {
  const auto tracks = load(spec);
  std::set<double> starts;
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    Rng rng(seed);
    starts.insert(draw_start(rng, tracks, spec, uav).value());
  }
  return starts.size();
}

TEST(People, AreMetInDifferentMomentsByDifferentSeeds) {
  UavSpec uav = crowd(0.0).uav;
  uav.limits = {Vec3::Constant(3.0), Vec3::Constant(10.0)};
  EXPECT_GT(different_starts(hermes(), uav), 150U);
  uav.start = Vec3(-6, 0, 1);
  uav.goal = Vec3(12, 10, 1);
  EXPECT_GT(different_starts(eth("eth", 15.0), uav), 180U);
}

}  // namespace
}  // namespace tern
