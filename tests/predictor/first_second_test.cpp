// Tracks that exist for less than a second: their intervals cover from the first moment on, in any company.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "predictor/tracking/tracker.h"
#include "tests/predictor/simulated_motion.h"

namespace tern {
namespace {

using testing::at_seconds;
using testing::Path;

constexpr double kRate = 30.0, kUntil = 60.0, kLatency = 0.05;
constexpr double kLife = 1.2;  // s, then the next one appears
constexpr int kPlaces = 8;     // 20 m apart

/// At each x one obstacle after the other, 20 m apart. At every other x it rests; at the others it swings at 4 m/s.
Path at_place(int place, double t) {
  const auto visit = static_cast<int>(t / kLife);
  const Vec3 centre(20.0 * place, 20.0 * visit, 2.0);
  if (place % 2 == 1) return [=](double) { return centre; };
  Rng rng(static_cast<std::uint64_t>(1000 * place + visit));
  return testing::trefoil(centre, Vec3(1.0, 1.0, 1.0), 1.1, rng.uniform(0.0, 2.0 * std::numbers::pi));
}

/// By age, in steps of kAges.
struct OfAges {
  static constexpr double kAges = 0.2;  // s
  std::array<int, 4> covered{}, intervals{};
};

// Of the swinging obstacles, over kUntil.
void follow_places(std::uint64_t seed, double horizon_s, OfAges& sum) {
  Rng rng(seed);
  Tracker tracker(TrackerConfig{});
  for (int frame = 0; frame < static_cast<int>(kRate * kUntil); ++frame) {
    const double t = frame / kRate;
    std::vector<Detection> seen;
    for (int place = 0; place < kPlaces; ++place) {
      if (rng.uniform() > 0.05) seen.push_back(testing::detection_of(at_place(place, t)(t), 0.05, rng));
    }
    tracker.update(testing::observations_at(t, std::move(seen)));
    if (t < 10.0 || frame % 3 != 0) continue;
    const std::vector<Track> tracks = tracker.predict(at_seconds(t + kLatency));
    for (const TrackedObject& object : tracker.objects()) {
      const auto place = static_cast<int>(std::lround(object.position.x() / 20.0));
      const auto bin = static_cast<std::size_t>((object.last_seen - object.born).seconds() / OfAges::kAges);
      if (place % 2 == 1 || object.last_seen != tracker.newest() || bin >= sum.covered.size()) continue;
      for (const Track& track : tracks) {
        if (track.id != object.id) continue;
        ++sum.intervals[bin];
        sum.covered[bin] += testing::covers(track, at_place(place, t), horizon_s) ? 1 : 0;
      }
    }
  }
}

TEST(FirstSecond, CoversFastTracksAmongStationaryOnes) {
  constexpr double kHorizon = 0.5;
  OfAges sum;
  for (std::uint64_t seed = 17; seed < 20; ++seed) follow_places(seed, kHorizon, sum);
  for (std::size_t bin = 0; bin < sum.covered.size(); ++bin) {
    EXPECT_GT(sum.intervals[bin], 600) << bin;
    EXPECT_GE(sum.covered[bin], 0.985 * sum.intervals[bin])
        << "from " << OfAges::kAges * static_cast<double>(bin) << " s on: " << sum.covered[bin] << " of "
        << sum.intervals[bin];
  }
}

/// Counts the tracks of a set that are covered at each level for `ahead` seconds, by the obstacles of their ids.
void count_covered(const std::vector<Track>& tracks, const std::vector<Path>& movers, double ahead,
                   std::array<int, kLevels>& covered, int& intervals) {
  for (const Track& track : tracks) {
    ++intervals;
    for (int level = 0; level < kLevels; ++level) {
      Track at_level = track;
      for (std::size_t k = 0; k < track.alpha.size(); ++k) at_level.alpha[k] = track.alpha_at(k, level);
      const Path& truth = movers.at(static_cast<std::size_t>(track.id));
      covered.at(static_cast<std::size_t>(level)) += testing::covers(at_level, truth, ahead) ? 1 : 0;
    }
  }
}

/// Twenty walk at 1.2 m/s; later one appears that flies at 4 m/s.
TEST(FirstSecond, NewTracksHaveNarrowMarginsInASlowSceneUntilAFastOneAppears) {
  Rng rng(5);
  Tracker tracker(TrackerConfig{});
  const auto feared = [&] { return tracker.scorer().calibration().margins(kNewTrack)[0][band_of(0.5)]; };
  const double at_first = feared();
  double among_walkers = at_first;
  for (int frame = 0; frame < static_cast<int>(kRate * 5.0); ++frame) {
    const double t = frame / kRate;
    std::vector<Detection> seen;
    for (int k = 0; k < 20; ++k) {
      seen.push_back(testing::detection_of(Vec3(1.2 * t, 20.0 * k, 1.0), 0.05, rng));
    }
    if (t > 3.0) seen.push_back(testing::detection_of(Vec3(4.0 * t, -20.0, 1.0), 0.05, rng));
    tracker.update(testing::observations_at(t, std::move(seen)));
    if (t < 3.0) among_walkers = feared();
  }
  EXPECT_LT(among_walkers, 0.5 * at_first);
  EXPECT_GT(feared(), 2.0 * among_walkers);
}

// A restarted predictor among fast obstacles, with an exact sensor: it has no scores of this scene.
TEST(FirstSecond, CoversAsStatedAtEachConfidenceFromTheFirstPredictionsOn) {
  constexpr int kFlights = 40, kMovers = 25;
  for (const int frames : {2, 3, 4, 6}) {
    std::array<int, kLevels> covered{};
    int intervals = 0;
    for (int flight = 0; flight < kFlights; ++flight) {
      Rng rng(static_cast<std::uint64_t>(flight));
      std::vector<Path> movers;
      for (int k = 0; k < kMovers; ++k) {
        const double phase = rng.uniform(0.0, 2.0 * std::numbers::pi);
        movers.push_back(testing::trefoil(Vec3(20.0 * k, 0.0, 2.0), Vec3::Ones(), 1.1, phase));
      }
      Tracker tracker(TrackerConfig{});
      for (int frame = 0; frame < frames; ++frame) {
        std::vector<Detection> seen;
        for (int k = 0; k < kMovers; ++k) {
          seen.push_back(testing::detection_of(movers[static_cast<std::size_t>(k)](frame / kRate), 0.0, rng, k));
        }
        tracker.update(testing::observations_at(frame / kRate, std::move(seen)));
      }
      count_covered(tracker.predict(at_seconds(frames / kRate)), movers, 2.0, covered, intervals);
    }
    for (int level = 0; level < kLevels; ++level) {
      const double share = static_cast<double>(covered.at(static_cast<std::size_t>(level))) / intervals;
      EXPECT_GE(share, confidence_at(0.99, level)) << "after " << frames << " frames";
      RecordProperty("kept_" + std::to_string(frames) + "_" + std::to_string(level), std::to_string(share));
    }
  }
}

}  // namespace
}  // namespace tern
