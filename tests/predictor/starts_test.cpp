// Stationary obstacles that start: the stated confidence includes the start.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "predictor/tracking/tracker.h"
#include "tests/predictor/simulated_motion.h"

namespace tern {
namespace {

using testing::at_seconds;

/// A box that is seen from `seen_s` on, rests until `start_s`, and moves.
struct Parked {
  Vec3 place;
  double seen_s = 0.0, start_s = 0.0, end_s = 0.0;
  double speed = 4.5;         // m/s along y
  double acceleration = 0.0;  // m/s² up to its speed; 0: at once
  [[nodiscard]] Vec3 at(double t) const {
    const double s = std::max(0.0, t - start_s);
    const double rise = acceleration > 0.0 ? std::min(s, speed / acceleration) : 0.0;
    return place + Vec3(0.0, 0.5 * acceleration * rise * rise + speed * (s - rise), 0.0);
  }
};

struct CoveredCount {
  int covered = 0, intervals = 0;
  double largest_alpha = 0.0;  // of the last set
  [[nodiscard]] double share() const { return static_cast<double>(covered) / intervals; }
};

/// Feeds detections at 30 Hz, 50 ms late, with noise. Counts whole intervals of stationary tracks in 20 sets a second;
/// a track that was seen too briefly is not stationary yet.
CoveredCount watch(const std::vector<Parked>& boxes, double until_s, const TrackerConfig& config = {}) {
  Rng rng(3);
  Tracker tracker(config);
  CoveredCount covered;
  int sets = 0;
  for (int frame = 0; frame < static_cast<int>(30.0 * until_s); ++frame) {
    const double t = frame / 30.0;
    std::vector<Detection> seen;
    for (const Parked& box : boxes) {
      if (t >= box.seen_s && t < box.end_s && rng.uniform() > 0.05)
        seen.push_back(testing::detection_of(box.at(t), 0.05, rng));
    }
    tracker.update(testing::observations_at(t, std::move(seen)));
    for (double now = t + 0.05; sets * 0.05 <= now - 1.0 / 30.0; ++sets) {
      covered.largest_alpha = 0.0;
      for (const Track& track : tracker.predict(at_seconds(now))) {
        for (const Vec3& alpha : track.alpha) covered.largest_alpha = std::max(covered.largest_alpha, alpha.maxCoeff());
        const auto object = std::find_if(tracker.objects().begin(), tracker.objects().end(),
                                         [&](const TrackedObject& o) { return o.id == track.id; });
        if (!tracker.is_stationary(*object)) continue;
        const Vec3 p = track.motion.sample(track.motion.start).p;
        for (const Parked& box : boxes) {
          if (std::abs(p.x() - box.place.x()) > 5.0 || now >= box.end_s) continue;
          ++covered.intervals;
          covered.covered += testing::covers(
                                 track, [&](double s) { return box.at(s); }, 4.5)
                                 ? 1
                                 : 0;
        }
      }
    }
  }
  return covered;
}

/// One after the other, each seen at rest for 0.9 to 4 s.
std::vector<Parked> that_start(int boxes, double acceleration) {
  std::vector<Parked> all;
  Rng rng(11);
  for (int k = 0; k < boxes; ++k) {
    Parked box;
    box.place = Vec3(20.0 * k, 0.0, 1.0);
    box.seen_s = 0.7 * k;
    box.start_s = box.seen_s + rng.uniform(0.9, 4.0);
    box.end_s = box.start_s + 1.5;
    box.acceleration = acceleration;
    all.push_back(box);
  }
  return all;
}

std::vector<Parked> pillars(int boxes) {
  std::vector<Parked> all = that_start(boxes, 0.0);
  for (Parked& box : all) {
    box.seen_s = 0.0;
    box.start_s = box.end_s = 1e9;
  }
  return all;
}

TEST(Starts, AreCoveredAsStated) {
  for (const double acceleration : {0.0, 20.0, 3.0}) {
    const CoveredCount covered = watch(that_start(40, acceleration), 34.0);
    EXPECT_GE(covered.share(), 0.99) << acceleration << ": " << covered.covered << " of " << covered.intervals;
    RecordProperty("share", std::to_string(covered.share()));
  }
}

TEST(Starts, AreNotExpectedOfAWallThatWasSeenAtRestForLong) {
  EXPECT_GT(watch(pillars(20), 2.0).largest_alpha, 5.0) << "who knows";
  const CoveredCount stood = watch(pillars(20), 60.0);
  EXPECT_LT(stood.largest_alpha, 0.6) << "1200 s of rest without a start";
  EXPECT_GE(stood.share(), 0.999);
}

TEST(TrustedRest, IsLaplacesRuleOfSuccession) {
  const RestRecord none{99.0, 0};
  const double s = trusted_rest_s(none, 0.01);
  EXPECT_NEAR(s / (none.rested_s + s), 0.01, 1e-12);
  EXPECT_NEAR(trusted_rest_s({1000.0, 9}, 0.01), 1000.0 * 0.01 / 10, 0.01);
  EXPECT_EQ(trusted_rest_s({0.0, 0}, 0.01), 0.0);
}

/// Draws a rate, lets obstacles rest and start by it, and checks the time of the next start.
TEST(TrustedRest, IsAsProbableAsItStates) {
  Rng rng(5);
  int early = 0, trials = 0;
  constexpr double kProbability = 0.05;
  for (int i = 0; i < 20'000; ++i) {
    const double rate = rng.uniform(0.0, 2.0);
    RestRecord record;
    record.rested_s = 20.0;
    for (double t = -std::log(rng.uniform()) / rate; t < record.rested_s; t -= std::log(rng.uniform()) / rate)
      ++record.starts;
    ++trials;
    early += -std::log(rng.uniform()) / rate < trusted_rest_s(record, kProbability) ? 1 : 0;
  }
  EXPECT_LE(testing::wilson(early, trials).low, kProbability) << early;
  EXPECT_GE(testing::wilson(early, trials).high, 0.8 * kProbability) << early;
}

}  // namespace
}  // namespace tern
