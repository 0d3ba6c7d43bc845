#include <gtest/gtest.h>

#include "predictor/tracking/tracker.h"
#include "tests/predictor/simulated_motion.h"

namespace tern {
namespace {

using testing::detection_of;
using testing::observations_at;

constexpr double kRate = 30.0, kApart = 20.0;
constexpr int kPairs = 12;

/// Pairs that walk towards each other for 3 s and on for 3 s. Ids are true, or exchanged from the moment at which the
/// two pass.
double margin_of_pairs(bool exchanged) {
  Rng rng(4);
  Tracker tracker(TrackerConfig{});
  for (int frame = 0; frame < static_cast<int>(kRate * 6.0 * 4); ++frame) {
    const double t = frame / kRate;
    const int round = static_cast<int>(t / 6.0);
    const double since = t - 6.0 * round;
    std::vector<Detection> seen;
    for (int k = 0; k < kPairs; ++k) {
      const bool is_swapped = exchanged && since >= 3.0;
      const std::int64_t first = 2 * (kPairs * round + k), second = first + 1;
      const Vec3 way(1.2 * (since - 3.0), 0.0, 0.0), centre(0.0, kApart * k, 1.0);
      seen.push_back(detection_of(centre + way, 0.05, rng, is_swapped ? second : first));
      seen.push_back(detection_of(centre - way + Vec3(0, 0.05, 0), 0.05, rng, is_swapped ? first : second));
    }
    tracker.update(observations_at(t, std::move(seen)));
  }
  double largest = 0.0;
  for (const MotionKind motion : {MotionKind::Steady, MotionKind::Calm, MotionKind::Lively}) {
    largest = std::max(largest, tracker.scorer().calibration().margins({TrackAge::Old, motion})[0][band_of(1.0)]);
  }
  return largest;
}

TEST(Exchange, OfTracksThatPassEachOtherWidensNoInterval) {
  const double apart = margin_of_pairs(false), exchanged = margin_of_pairs(true);
  EXPECT_LT(exchanged, apart + 0.5);
}

}  // namespace
}  // namespace tern
