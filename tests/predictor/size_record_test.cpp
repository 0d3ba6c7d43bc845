#include "predictor/faces/size_record.h"

#include <gtest/gtest.h>

#include "core/base/random.h"

namespace tern {
namespace {

const Vec3 kPillar(0.4, 0.4, 4.0), kBeam(0.4, 4.0, 0.4), kCube(0.8, 0.8, 0.8);

SizeRecord record_of(int times, const std::vector<Vec3>& sizes) {
  SizeRecord record;
  std::int64_t track = 0;
  for (int k = 0; k < times; ++k) {
    for (const Vec3& one : sizes) record.add(++track, one);
  }
  return record;
}

TEST(SizeRecord, SaysNothingBeforeEnoughSimilarObstaclesWereSeen) {
  const KnownSizes front{{0.0, 0.8, 0.8}, {false, true, true}};
  EXPECT_EQ(record_of(SizeRecord::kFewestSimilar - 1, {kCube}).longest(0, front), std::nullopt);
  EXPECT_EQ(record_of(SizeRecord::kFewestSimilar, {kPillar, kBeam}).longest(0, front), std::nullopt);
  EXPECT_EQ(record_of(SizeRecord::kFewestSimilar, {kCube}).longest(0, front), 0.8);
}

TEST(SizeRecord, KnowsTheKindOfAnObstacleByItsMeasuredSides) {
  const SizeRecord record = record_of(10, {kPillar, kBeam, kCube});
  EXPECT_EQ(record.longest(0, {{0.0, 0.8, 0.8}, {false, true, true}}), 0.8);
  EXPECT_EQ(record.longest(2, {{0.4, 0.4, 1.0}, {true, true, false}}), 4.0);
  // A beam along x is a beam along y that is turned.
  EXPECT_EQ(record.longest(0, {{1.0, 0.4, 0.4}, {false, true, true}}), 4.0);
  // An obstacle that is longer than the cubes is like the beams.
  EXPECT_EQ(record.longest(1, {{0.3, 1.5, 0.4}, {false, false, true}}), 4.0);
}

// The rule of succession: of n + 1 obstacles of one population, the newest is the longest with a share of 1/(n + 1).
TEST(SizeRecord, IsExceededByOneInNPlusOne) {
  Rng rng(11);
  constexpr int kRecorded = 19, kTrials = 4000;
  int longer = 0;
  for (int trial = 0; trial < kTrials; ++trial) {
    SizeRecord record;
    const auto drawn = [&] { return Vec3(0.4, rng.uniform(1.0, 8.0), 0.4); };
    for (int k = 0; k < kRecorded; ++k) record.add(k, drawn());
    const double length = drawn().y();
    const auto longest = record.longest(1, {{0.4, 1.0, 0.4}, {true, false, true}});
    ASSERT_TRUE(longest.has_value());
    longer += length > *longest ? 1 : 0;
  }
  EXPECT_NEAR(static_cast<double>(longer) / kTrials, 1.0 / (kRecorded + 1), 0.012);  // 3.5 standard deviations
}

TEST(SizeRecord, KeepsOneEntryOfATrackAndTheNewestTracks) {
  SizeRecord record;
  for (int k = 0; k < 100; ++k) record.add(1, kCube);
  const KnownSizes any{Vec3::Zero(), {false, false, false}};
  EXPECT_EQ(record.longest(0, any), std::nullopt) << "one track is one obstacle";
  record.add(2, {9, 9, 9});
  for (std::size_t k = 0; k < SizeRecord::kMostSizes; ++k) record.add(static_cast<std::int64_t>(10 + k), kCube);
  EXPECT_EQ(record.longest(0, any), 0.8);
}

}  // namespace
}  // namespace tern
