// The ages of tracks, as the predictor and as receivers of its predictions see them.
#include "core/world/track_class.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace tern {
namespace {

TEST(TrackAge, FollowsFromDetectionsFirstAndThenFromTime) {
  EXPECT_EQ(track_age(1, 5.0), TrackAge::New);
  EXPECT_EQ(track_age(2, 0.0), TrackAge::Young);
  EXPECT_EQ(track_age(20, kYoungAge), TrackAge::Grown);
  EXPECT_EQ(track_age(20, kGrownAge), TrackAge::Old);
}

TEST(TrackAge, OfAReceiverBelongsToTheLesserAgeAtABound) {
  EXPECT_EQ(age_in_predictions(0.0), TrackAge::New);
  EXPECT_EQ(age_in_predictions(kNewInPredictions), TrackAge::New);
  EXPECT_EQ(age_in_predictions(kYoungAge), TrackAge::Young);
  EXPECT_EQ(age_in_predictions(kGrownAge), TrackAge::Grown);
  EXPECT_EQ(age_in_predictions(kGrownAge + 1e-6), TrackAge::Old);
}

TEST(TrackClass, HasWordsForEachAge) {
  EXPECT_STREQ(to_string(TrackAge::New), "new");
  EXPECT_STREQ(to_string(TrackAge::Old), "old");
}

TEST(CoverageHorizons, Ascend) { EXPECT_TRUE(std::ranges::is_sorted(kCoverageHorizons)); }

}  // namespace
}  // namespace tern
