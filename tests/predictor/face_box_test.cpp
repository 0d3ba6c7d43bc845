#include "predictor/faces/face_box.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/base/random.h"
#include "predictor/faces/sighting_matching.h"

namespace tern {
namespace {

constexpr double kSigma = 0.01;

// The sighting of a whole box: near faces towards −x, −y, −z.
Sighting sighting_of(const Box& box, const std::array<BoundSight, 6>& bounds) {
  Sighting sighting;
  sighting.lower = box.min();
  sighting.upper = box.max();
  sighting.lower_sigma = sighting.upper_sigma = Vec3::Constant(kSigma);
  sighting.bounds = bounds;
  sighting.points = 200;
  return sighting;
}
std::array<BoundSight, 6> all(BoundSight sight) {
  std::array<BoundSight, 6> bounds;
  bounds.fill(sight);
  return bounds;
}

// The visible part of a box at one time. Of each axis a sensor sees both ends, one or none, and less without an end.
Sighting part_of(const Box& box, Rng& rng) {
  Sighting sighting = sighting_of(box, all(BoundSight::Whole));
  for (int axis = 0; axis < 3; ++axis) {
    for (int side = 0; side < 2; ++side) {
      if (rng.uniform() < 0.5) continue;
      sighting.bounds[idx(2 * axis + side)] = rng.uniform() < 0.5 ? BoundSight::Occluded : BoundSight::Cut;
      const double hidden = 0.45 * rng.uniform() * box.sizes()[axis];
      (side == 0 ? sighting.lower : sighting.upper)[axis] += side == 0 ? hidden : -hidden;
    }
  }
  return sighting;
}

Box random_box(Rng& rng) {
  const Vec3 centre(rng.uniform(-5, 5), rng.uniform(-5, 5), rng.uniform(0, 3));
  return box_around(centre, Vec3(rng.uniform(0.1, 2), rng.uniform(0.1, 2), rng.uniform(0.1, 2)));
}

TEST(FaceBox, AChangeOfWhatIsVisibleIsNoMotion) {
  Rng rng(1);
  for (int trial = 0; trial < 200; ++trial) {
    const Box box = random_box(rng);
    Vec3 anchor;
    FaceBox faces(part_of(box, rng), anchor);
    for (int k = 0; k < 20; ++k) {
      const Sighting sighting = part_of(box, rng);
      const AnchorMeasurement measured = faces.measure(anchor, sighting);
      for (int axis = 0; axis < 3; ++axis) {
        if (!measured.has[idx(axis)]) continue;
        ASSERT_NEAR(measured.position[axis], anchor[axis], 1e-9);
      }
      faces.learn(anchor, sighting);
    }
  }
}

TEST(FaceBox, MeasuresTheMotionOfABoxWhateverIsVisible) {
  Rng rng(2);
  for (int trial = 0; trial < 200; ++trial) {
    const Box box = random_box(rng);
    Vec3 anchor;
    FaceBox faces(sighting_of(box, all(BoundSight::Whole)), anchor);
    const Vec3 moved(rng.uniform(-0.5, 0.5), rng.uniform(-0.5, 0.5), rng.uniform(-0.5, 0.5));
    const AnchorMeasurement measured =
        faces.measure(anchor, part_of(box_around(box.center() + moved, 0.5 * box.sizes()), rng));
    for (int axis = 0; axis < 3; ++axis) {
      if (!measured.has[idx(axis)]) continue;
      ASSERT_NEAR(measured.position[axis] - anchor[axis], moved[axis], 1e-9);
    }
  }
}

TEST(FaceBox, HasNoPositionAlongAnAxisThatIsCutOnBothSides) {
  Rng rng(3);
  std::array<BoundSight, 6> bounds = all(BoundSight::Whole);
  bounds[2] = BoundSight::Cut;
  bounds[3] = BoundSight::Occluded;
  const Sighting sighting = sighting_of(random_box(rng), bounds);
  Vec3 anchor;
  FaceBox faces(sighting, anchor);
  faces.learn(anchor, sighting);
  EXPECT_FALSE(faces.has_position(1));
  EXPECT_EQ(faces.measure(anchor, sighting).has, (std::array{true, false, true}));
}

TEST(FaceBox, AFaceThatIsFoundLaterIsLearntFromTheSize) {
  const Box box(Vec3(4, -1, 0), Vec3(5, 1, 2));
  std::array<BoundSight, 6> bounds = all(BoundSight::Whole);
  bounds[3] = BoundSight::Occluded;
  Sighting partial = sighting_of(box, bounds);
  partial.upper.y() = 0.0;
  Vec3 anchor;
  FaceBox faces(partial, anchor);
  // The filter errs by 0.3 m: that must not become extent.
  faces.learn(anchor + Vec3(0, 0.3, 0), sighting_of(box, all(BoundSight::Whole)));
  EXPECT_NEAR(faces.completed(anchor).sizes().y(), 2.0, 1e-9);
}

TEST(FaceBox, TheUnseenDepthIsAsLongAsTheShorterKnownSide) {
  std::array<BoundSight, 6> bounds = all(BoundSight::Whole);
  bounds[0] = BoundSight::Face;
  bounds[1] = BoundSight::Unseen;
  Vec3 anchor;
  const FaceBox faces(sighting_of(Box(Vec3(4, -0.4, 0), Vec3(4, 0.4, 4)), bounds), anchor);
  const Box box = faces.completed(anchor);
  EXPECT_NEAR(box.min().x(), 4.0, 1e-9);
  EXPECT_NEAR(box.max().x(), 4.8, 1e-9);
}

// The front of a pillar whose upper end is hidden.
FaceBox front_of_pillar(const Box& pillar, Vec3& anchor) {
  std::array<BoundSight, 6> bounds = all(BoundSight::Whole);
  bounds[0] = BoundSight::Face;
  bounds[5] = BoundSight::Occluded;
  Sighting part = sighting_of(pillar, bounds);
  part.upper.z() = pillar.min().z() + 1.0;
  return {part, anchor};
}

TEST(FaceBox, AHiddenEndIsAsFarOutAsSimilarObstaclesAreLong) {
  const Box pillar(Vec3(4, -0.2, 0), Vec3(4.4, 0.2, 4));
  Vec3 anchor;
  const FaceBox faces = front_of_pillar(pillar, anchor);
  EXPECT_NEAR(faces.completed(anchor).max().z(), 1.0, 1e-9) << "the least";
  SizeRecord record;
  EXPECT_NEAR(faces.whole(anchor, 0.0, record).max().z(), 1.0 + kUnseenRest, 1e-9) << "nothing is known";
  for (int k = 0; k < SizeRecord::kFewestSimilar; ++k) record.add(k, pillar.sizes());
  EXPECT_TRUE(faces.whole(anchor, 0.0, record).contains(pillar));
  EXPECT_NEAR(faces.whole(anchor, 0.0, record).max().z(), 4.0 + kSizeTolerance, 1e-9);
}

TEST(FaceBox, AHiddenEndIsNearerThanTheSensor) {
  Vec3 anchor;
  FaceBox faces = front_of_pillar(Box(Vec3(4, -0.2, 0), Vec3(4.4, 0.2, 4)), anchor);
  SensorView above;  // it saw nothing, but it is there
  above.sensor_position = Vec3(4.2, 0, 3);
  faces.limit_hidden_ends(above, anchor, 0.0);
  const double end = faces.whole(anchor, 0.0, {}).max().z();
  EXPECT_GE(end, 3.0);
  EXPECT_LT(end, 3.2);
}

TEST(FaceBox, GrowsAtOnceUntilItsSizeIsSure) {
  Vec3 anchor;
  const Box small(Vec3(4, -0.5, 0), Vec3(5, 0.5, 1)), large(Vec3(4, -0.5, 0), Vec3(5, 1.5, 1));
  for (const bool is_sure : {false, true}) {
    FaceBox faces(sighting_of(small, all(BoundSight::Whole)), anchor);
    for (int k = 2; k < (is_sure ? 30 : kSureSize); ++k)
      faces.learn(anchor, sighting_of(small, all(BoundSight::Whole)));
    faces.learn(anchor, sighting_of(large, all(BoundSight::Whole)));
    EXPECT_NEAR(faces.completed(anchor).max().y(), is_sure ? 0.55 : 1.5, 1e-6);
    for (int k = 0; k < 200; ++k) faces.learn(anchor, sighting_of(large, all(BoundSight::Whole)));
    EXPECT_NEAR(faces.completed(anchor).sizes().y(), 2.0, 0.02) << "a size that is seen for long is believed";
  }
}

// A side that is seen edge-on ends somewhere within metres.
TEST(FaceBox, AnUncertainEndIsNoMismatchAndGivesWay) {
  Vec3 anchor;
  const Box box(Vec3(4, -0.5, 0), Vec3(4.4, 0.5, 1));
  std::array<BoundSight, 6> front = all(BoundSight::Whole);
  front[1] = BoundSight::Unseen;
  FaceBox faces(sighting_of(box, front), anchor);
  for (int k = 0; k < 30; ++k) faces.learn(anchor, sighting_of(box, front));
  Sighting edge_on = sighting_of(box, all(BoundSight::Whole));
  edge_on.upper.x() = 6.0;
  edge_on.upper_sigma.x() = 1.2;
  faces.learn(anchor, edge_on);
  const Sighting clear = sighting_of(box, all(BoundSight::Whole));
  EXPECT_LT(faces.mismatch(anchor, clear, 0.0), 0.05);
  faces.learn(anchor, clear);
  EXPECT_NEAR(faces.completed(anchor).max().x(), 4.4, 0.02);
}

TEST(FaceBox, ShrinksSlowly) {
  Vec3 anchor;
  const Box small(Vec3(4, -0.5, 0), Vec3(5, 0.5, 1)), large(Vec3(4, -0.5, 0), Vec3(5, 1.5, 1));
  FaceBox faces(sighting_of(large, all(BoundSight::Whole)), anchor);
  for (int k = 0; k < 30; ++k) faces.learn(anchor, sighting_of(large, all(BoundSight::Whole)));
  faces.learn(anchor, sighting_of(small, all(BoundSight::Whole)));
  EXPECT_GT(faces.completed(anchor).sizes().y(), 1.9);
  for (int k = 0; k < 200; ++k) faces.learn(anchor, sighting_of(small, all(BoundSight::Whole)));
  const Box shrunk = faces.completed(faces.measure(anchor, sighting_of(small, all(BoundSight::Whole))).position);
  EXPECT_NEAR(shrunk.max().y(), 0.5, 0.02);
  EXPECT_NEAR(shrunk.min().y(), -0.5, 0.02);
}

TEST(FaceBox, ASliverHasNoEnds) {
  std::array<BoundSight, 6> bounds = all(BoundSight::Whole);
  bounds[0] = BoundSight::Face;
  bounds[5] = BoundSight::Cut;
  Sighting sliver = sighting_of(Box(Vec3(4, -1, 2), Vec3(4, 1, 2.05)), bounds);
  sliver.points = kSliverPoints - 1;
  EXPECT_TRUE(std::ranges::none_of(without_false_ends(sliver).bounds, is_end));
  sliver.points = kSliverPoints;
  EXPECT_EQ(without_false_ends(sliver).bounds, bounds);
  // Something small and far that is seen whole is no sliver.
  sliver.points = 6;
  sliver.bounds = all(BoundSight::Whole);
  EXPECT_TRUE(std::ranges::all_of(without_false_ends(sliver).bounds, is_end));
}

TEST(SightingMatching, TakesTheBestPairsFirst) {
  const Box left(Vec3(4, -1, 0), Vec3(5, 0, 1));
  const auto at = [&](double y) {
    return sighting_of(Box(left.min() + Vec3(0, y, 0), left.max() + Vec3(0, y, 0)), all(BoundSight::Whole));
  };
  Vec3 anchor, other_anchor;
  const FaceBox box(at(0.0), anchor), other(at(0.5), other_anchor);
  const std::vector<PredictedFaces> tracks{{&box, anchor, kFaceGate}, {&other, other_anchor, kFaceGate}};
  EXPECT_EQ(match_sightings(tracks, {at(0.45), at(0.2)}), (std::vector{1, 0}));
  EXPECT_EQ(match_sightings(tracks, {at(0.3)}), (std::vector{kNoSighting, 0}));
  EXPECT_EQ(match_sightings(tracks, {at(-0.7), at(1.2)}), (std::vector{kNoSighting, kNoSighting}));
}

TEST(SightingMatching, AnUncertainTrackLeavesItsNeighboursSightingsAlone) {
  const Box known(Vec3(4, -1, 0), Vec3(5, 0, 1)), vague(Vec3(4, -0.6, 0), Vec3(5, 0.4, 1));
  Vec3 anchor, other_anchor;
  const FaceBox box(sighting_of(known, all(BoundSight::Whole)), anchor);
  const FaceBox other(sighting_of(vague, all(BoundSight::Whole)), other_anchor);
  // It differs by 0.3 m of 0.6 m from the one, and by 0.1 m of 2 m from the other.
  const Sighting between = sighting_of(Box(Vec3(4, -0.7, 0), Vec3(5, 0.3, 1)), all(BoundSight::Whole));
  const std::vector<PredictedFaces> tracks{{&box, anchor, kFaceGate}, {&other, other_anchor, kMaxFaceGate}};
  EXPECT_EQ(match_sightings(tracks, {between}), (std::vector{0, kNoSighting}));
}

TEST(SightingMatching, ComparesMeasuredEndsAlone) {
  const Box box(Vec3(4, -2, 0), Vec3(5, 2, 1));
  Vec3 anchor;
  const FaceBox faces(sighting_of(box, all(BoundSight::Whole)), anchor);
  std::array<BoundSight, 6> bounds = all(BoundSight::Whole);
  bounds[3] = BoundSight::Occluded;
  Sighting partial = sighting_of(box, bounds);
  partial.upper.y() = -1.0;  // three quarters are hidden
  EXPECT_EQ(match_sightings({{&faces, anchor, kFaceGate}}, {partial}), std::vector{0});
  partial.upper.y() = 3.0;  // it reaches beyond a face that is known
  EXPECT_EQ(match_sightings({{&faces, anchor, kFaceGate}}, {partial}), std::vector{kNoSighting});
}

}  // namespace
}  // namespace tern
