#include "simulator/worlds/declared_motions.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "core/base/random.h"

namespace tern {
namespace {

const UTime kZero{1'700'000'000'000'123};

World world_of(const std::vector<ObstacleSpec>& specs) {
  Scenario s;
  s.world.obstacles = specs;
  return make_world(s, "").value();
}

World generated(const char* generator, int count, std::uint64_t seed) {
  Scenario s;
  s.seed = seed;
  s.world.generator = generator;
  s.world.count = count;
  return make_world(s, "").value();
}

ObstacleSpec moving(decltype(ObstacleSpec::motion) motion) {
  ObstacleSpec o;
  o.centre = Vec3(10, 2, 1);
  o.motion = std::move(motion);
  return o;
}

std::vector<ObstacleSpec> every_motion() {
  return {moving(StaticMotion{}),
          moving(TrefoilMotion{Vec3(1, 0.5, 2), 1.1, 1.0}),
          moving(WaveMotion{Vec3(0, 0, -1), 1.0, 0.5}),
          moving(LinearMotion{Vec3(1, -2, 0), 1.25}),
          moving(WaypointMotion{{{0.5, Vec3::Zero()}, {1.0 / 3 + 1, Vec3::Ones()}, {4.0, Vec3(2, 0, 0)}}}),
          moving(WaypointMotion{{{-0.5, Vec3::Zero()}, {1.7, Vec3::Ones()}, {2.5, Vec3::Zero()}}, true, false}),
          moving(WaypointMotion{{{-0.5, Vec3::Zero()}, {2.0, Vec3::Ones()}, {4.5, Vec3::UnitX()}}, false, true})};
}

/// Checks the error bound of a track at many instants of its pieces.
void expect_promise_kept(const World& world, const TrackSet& set) {
  for (const Track& track : set.tracks) {
    const WorldObstacle& o = world.obstacles.at(static_cast<std::size_t>(track.id));
    ASSERT_EQ(track.alpha.size(), track.motion.pieces.size());
    UTime start = track.motion.start;
    for (std::size_t k = 0; k < track.motion.pieces.size(); ++k) {
      const CubicPiece& piece = track.motion.pieces[k];
      ASSERT_GT(piece.duration.us, 0);
      for (int i = 0; i <= 50; ++i) {
        const Duration tau{piece.duration.us * i / 50};
        const Vec3 truth = o.at((start + tau - kZero).seconds()).p;
        const Vec3 told = sample_cubic(piece.coefficients, tau.seconds()).p;
        EXPECT_TRUE(((told - truth).cwiseAbs().array() <= track.alpha[k].array() + 1e-15).all())
            << "track " << track.id << ", piece " << k << ": " << (told - truth).transpose() << " against "
            << track.alpha[k].transpose();
      }
      start = start + piece.duration;
    }
  }
}

TEST(DeclaredMotions, NeverExceedTheirAlpha) {
  Rng rng(2);
  for (const char* generator : {"paper_corridor", "mader_corridor", "sando_forest"}) {
    const World world = generated(generator, 60, 3);
    for (int i = 0; i < 5; ++i) {
      const UTime from = kZero + Duration::from_seconds(rng.uniform(-3.0, 30.0));
      const TrackSet set = declare_motions(world, kZero, from, from + Duration::from_seconds(4.0));
      EXPECT_EQ(set.tracks.size(), 60u);
      expect_promise_kept(world, set);
      for (const Track& track : set.tracks) {
        for (const Vec3& alpha : track.alpha) EXPECT_LE(alpha.maxCoeff(), 5.001e-3);
      }
    }
  }
}

TEST(DeclaredMotions, AreExactForStraightMotions) {
  const World world = world_of(every_motion());
  for (const double from_s : {-2.0, -0.3, 0.0, 0.7, 1.25, 3.9, 11.0}) {
    const UTime from = kZero + Duration::from_seconds(from_s);
    const TrackSet set = declare_motions(world, kZero, from, from + Duration::from_seconds(2.0));
    expect_promise_kept(world, set);
    for (const Track& track : set.tracks) {
      if (track.id >= 3) {
        EXPECT_LE(track.alpha[0].maxCoeff(), kFitRounding);
      }
    }
  }
}

TEST(DeclaredMotions, CoverWhatIsAskedWhileTheObstacleIsPresent) {
  const World world = world_of(every_motion());
  for (const double from_s : {-2.0, 0.0, 1.0, 2.5, 6.0, 100.0}) {
    const UTime from = kZero + Duration::from_seconds(from_s);
    const UTime to = from + Duration::from_seconds(3.5);
    const TrackSet set = declare_motions(world, kZero, from, to);
    EXPECT_TRUE(std::is_sorted(set.tracks.begin(), set.tracks.end(),
                               [](const Track& a, const Track& b) { return a.id < b.id; }));
    for (const Track& track : set.tracks) {
      const WorldObstacle& o = world.obstacles.at(static_cast<std::size_t>(track.id));
      EXPECT_LE(track.motion.start, std::max(from, kZero + Duration::from_seconds(std::max(o.first_s(), -1e3))));
      EXPECT_GE(track.motion.end(), std::min(to, kZero + Duration::from_seconds(std::min(o.last_s(), 1e3))));
      EXPECT_LE((track.motion.end() - to).us, 3'000'000);
    }
    EXPECT_EQ(set.tracks.size(), from_s > 4.5 ? 6u : 7u) << "who has vanished is not declared";
  }
}

TEST(DeclaredMotions, OfStaticObstaclesAreOnePieceWithoutError) {
  const TrackSet set = declare_motions(world_of(every_motion()), kZero, kZero, kZero + Duration{3'500'000});
  const Track& still = set.tracks.at(0);
  EXPECT_EQ(still.kind, TrackKind::Static);
  EXPECT_EQ(still.motion.pieces.size(), 1u);
  EXPECT_EQ(still.alpha.at(0), Vec3::Zero());
  EXPECT_EQ(still.top_speed, 0.0);
  EXPECT_EQ(set.tracks.at(1).kind, TrackKind::Declared);
  EXPECT_EQ(set.confidence, 1.0);
}

TEST(DeclaredMotions, OfSuccessiveSetsAgreePieceByPiece) {
  const World world = generated("paper_corridor", 20, 1);
  std::map<std::pair<std::int64_t, std::int64_t>, CubicPiece> known;
  int met_again = 0;
  for (int i = 0; i < 20; ++i) {
    const UTime from = kZero + Duration{200'000} * i;
    for (const Track& track : declare_motions(world, kZero, from, from + Duration{3'500'000}).tracks) {
      if (track.kind == TrackKind::Static) continue;
      UTime start = track.motion.start;
      for (const CubicPiece& piece : track.motion.pieces) {
        const auto [place, first_time] = known.try_emplace({track.id, start.us}, piece);
        EXPECT_EQ(place->second.coefficients, piece.coefficients);
        EXPECT_EQ(place->second.duration, piece.duration);
        met_again += first_time ? 0 : 1;
        start = start + piece.duration;
      }
    }
  }
  EXPECT_GT(met_again, 1000);
}

TEST(DeclaredMotions, RestBeforeTheWorldStarts) {
  const World world = world_of(every_motion());
  const TrackSet set = declare_motions(world, kZero, kZero - Duration{5'000'000}, kZero - Duration{1'000'000});
  EXPECT_EQ(set.tracks.size(), 7u);
  for (const Track& track : set.tracks) {
    ASSERT_EQ(track.motion.pieces.size(), 1u);
    EXPECT_EQ(track.motion.sample(kZero - Duration{2'000'000}).v, Vec3::Zero());
  }
}

TEST(DeclaredMotions, BoundsHoldTheTruthAlsoBeyondTheLastPiece) {
  const World world = generated("paper_corridor", 30, 2);
  const UTime from = kZero + Duration{3'000'000};
  for (const Track& track : declare_motions(world, kZero, from, from + Duration{1'000'000}).tracks) {
    const WorldObstacle& o = world.obstacles.at(static_cast<std::size_t>(track.id));
    for (int i = -10; i < 40; ++i) {
      const UTime t = from + Duration{100'000} * i;
      const Box promised = grown(track.bounds(t, t + Duration{1}), Vec3::Constant(1e-9));
      EXPECT_TRUE(promised.contains(o.box((t - kZero).seconds()))) << track.id << " at " << i;
    }
  }
}

TEST(DeclaredMotions, AreFewEnoughForTheirMessages) {
  const World world = generated("paper_corridor", 300, 1);
  std::size_t pieces = 0;
  for (const Track& t : declare_motions(world, kZero, kZero + Duration{123'456}, kZero + Duration{4'123'456}).tracks) {
    pieces += t.motion.pieces.size();
  }
  EXPECT_LE(pieces, 6u * 460u);
}

/// Waypoints as of a recording of `seconds` at `rate`, from `first_s` on.
WaypointMotion recorded(double rate, double first_s, double seconds, bool repeat = false) {
  WaypointMotion m;
  m.repeat = repeat;
  m.vanish = !repeat;
  const int frames = static_cast<int>(seconds * rate);
  for (int k = 0; k <= frames; ++k) {
    const double t = k / rate;
    m.points.emplace_back(first_s + t, Vec3(2.0 * std::sin(1.2 * t), 1.5 * std::cos(0.7 * t), 1.0));
  }
  if (repeat) m.points.back().second = m.points.front().second;
  return m;
}

TEST(DeclaredMotions, TooFineForAMessageAreCoarserAndKeepTheirPromise) {
  constexpr Duration kWindow{4'600'000};
  std::vector<ObstacleSpec> specs = {moving(recorded(120.0, -3.0, 30.0)), moving(recorded(1000.0, 1.0, 10.0)),
                                     moving(recorded(1000.0, -2.0, 9.0, true)),
                                     moving(recorded(1000.0, 0.0, 2.0, true)),
                                     moving(recorded(1e5, 0.0, 0.0005, true))};
  for (const double slowness : {0.05, 0.02, 0.01, 0.001}) {
    specs.push_back(moving(TrefoilMotion{Vec3(1, 0.5, 2), slowness, 1.0}));
    specs.push_back(moving(WaveMotion{Vec3(0, 0, -1), slowness, 0.5}));
  }
  const World world = world_of(specs);
  for (const std::size_t pieces : {1u, 2u, 20u, 100u, 460u}) {
    const CoarseMotions coarse = coarse_motions(world, kWindow, pieces);
    for (const double from_s : {-3.0, -0.1, 0.03, 1.7, 5.0, 8.9}) {
      const UTime from = kZero + Duration::from_seconds(from_s);
      const TrackSet set = declare_motions(world, kZero, from, from + kWindow, coarse);
      EXPECT_EQ(set.tracks.size(), specs.size());
      expect_promise_kept(world, set);
      for (const Track& track : set.tracks) {
        EXPECT_LE(track.motion.pieces.size(), 4 * pieces + 4) << track.id << " from " << from_s;
        for (const Vec3& alpha : track.alpha)
          EXPECT_LE(alpha.maxCoeff(), 3.1) << "little more than the reach of them all";
      }
    }
  }
}

TEST(DeclaredMotions, ThatAreFewEnoughAreNotMadeCoarser) {
  EXPECT_TRUE(coarse_motions(world_of(every_motion()), Duration{4'600'000}, 40).empty());
  EXPECT_TRUE(coarse_motions(generated("paper_corridor", 100, 1), Duration{4'600'000}, 20).empty());
}

TEST(DeclaredMotions, CountWhoIsThereAtOnce) {
  std::vector<ObstacleSpec> specs = every_motion();
  for (int k = 0; k < 10; ++k) specs.push_back(moving(recorded(10.0, 3.0 * k, 2.0)));
  const PresentCount present = max_present(world_of(specs), Duration{100'000});
  EXPECT_EQ(present.resting, 1u);
  EXPECT_EQ(present.moving, 5u + 2u) << "the vanishing one of every_motion() and the first or second of the others";
}

TEST(DeclaredMotions, ThrowWithoutATimeToCover) {
  EXPECT_THROW(declare_motions(World{}, kZero, kZero, kZero), std::invalid_argument);
}

TEST(FitPiece, IsTheLongestThatKeepsTheError) {
  const auto length = [](double fourth) { return fit_piece({Vec3::Zero(), Vec3::Zero(), Vec3::Constant(fourth)}).us; };
  EXPECT_EQ(length(81.0 / (1.1 * 1.1 * 1.1 * 1.1)), 430'000);
  EXPECT_EQ(length(1.0), 1'170'000);
  EXPECT_EQ(length(1e-9), 2'000'000);
  EXPECT_EQ(length(1e12), 10'000);
}

}  // namespace
}  // namespace tern
