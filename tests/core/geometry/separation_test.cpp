#include "core/geometry/separation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <iostream>
#include <limits>
#include <stdexcept>

#include "core/geometry/box.h"
#include "core/geometry/distance.h"
#include "core/geometry/separation_lp.h"
#include "tests/support/effort.h"
#include "tests/support/exact_separation.h"
#include "tests/support/point_sets.h"

namespace tern {
namespace {

// The oracle's distance is rounded once.
constexpr double kOracleRounding = 1e-12;
// The slab is the widest one up to the rounding of coordinates of 1e4 m.
constexpr double kGapRounding = 1e-9;
const int kPairs = support::at_effort(100'000);
constexpr std::uint64_t kSeed = 20'260'721;

// Calls claim(pair, truth) on kPairs pairs of all kinds; stops at the first failure, naming it.
template <class Claim>
void for_random_pairs(const Claim& claim) {
  Rng rng(kSeed);
  for (int k = 0; k < kPairs; ++k) {
    const auto kind = static_cast<PairKind>(k % kPairKinds);
    const PointSets pair = random_pair(kind, rng);
    const ExactSeparation truth = exact_separation(pair.a, pair.b);
    claim(pair, truth, rng);
    if (::testing::Test::HasFailure()) {
      const Eigen::IOFormat exact(Eigen::FullPrecision);
      FAIL() << "seed " << kSeed << ", pair " << k << ", kind " << k % kPairKinds << ", exact distance "
             << truth.distance << "\na =\n"
             << pair.a.format(exact) << "\nb =\n"
             << pair.b.format(exact);
    }
  }
}

bool surely_apart(const ExactSeparation& truth, double clearance) {
  return truth.disjoint && truth.distance * (1.0 - kOracleRounding) > clearance + kTouchingTolerance;
}

void expect_holds(const Separation& separation, const PointSets& pair, double clearance, double distance) {
  EXPECT_TRUE(exactly_separates(separation.plane, pair.a, pair.b, std::max(clearance, kPlaneMargin)));
  EXPECT_NEAR(separation.plane.n.norm(), 1.0, 4e-16);
  const double lowest = ((separation.plane.n.transpose() * pair.a).array() + separation.plane.d).minCoeff();
  EXPECT_NEAR(lowest, 0.0, kGapRounding);
  EXPECT_LE(separation.gap, distance * (1.0 + kOracleRounding));
  EXPECT_GE(separation.gap, distance - kGapRounding);
}

TEST(Separation, AgreesWithExactArithmeticAndItsPlanesHoldExactly) {
  separation_counts() = {};
  for_random_pairs([](const PointSets& pair, const ExactSeparation& truth, Rng&) {
    const auto separation = separate(pair.a, pair.b, 0.0);
    if (!truth.disjoint) {
      EXPECT_FALSE(separation);
    }
    if (surely_apart(truth, 0.0)) {
      EXPECT_TRUE(separation);
    }
    if (separation) expect_holds(*separation, pair, 0.0, truth.distance);
  });
  std::cout << separation_counts().fast << " settled fast, " << separation_counts().lp << " by the linear programme\n";
}

TEST(Separation, KeepsAClearanceExactly) {
  for_random_pairs([](const PointSets& pair, const ExactSeparation& truth, Rng& rng) {
    const double near = truth.distance + rng.uniform(-4e-6, 4e-6);
    const double clearance = std::max(0.0, rng.uniform() < 0.5 ? near : rng.uniform(0.0, 0.5));
    const auto separation = separate(pair.a, pair.b, clearance);
    if (!truth.disjoint || truth.distance * (1.0 + kOracleRounding) <= clearance) {
      EXPECT_FALSE(separation);
    }
    if (surely_apart(truth, clearance)) {
      EXPECT_TRUE(separation);
    }
    if (separation) expect_holds(*separation, pair, clearance, truth.distance);
  });
}

// Distances in a city, with all bits of a double: the oracle needs 2048 bits.
TEST(Separation, AgreesWithExactArithmeticOffTheGridAndOnLargeSets) {
  Rng rng(2);
  for (int k = 0; k < 3000; ++k) {
    PointSets pair = random_pair(k % 2 == 0 ? PairKind::NearTouching : PairKind::Sliver, rng);
    const double scale = rng.uniform(0.3, 100.0);
    pair.a *= scale;
    pair.b *= scale;
    const ExactSeparation truth = exact_separation(pair.a, pair.b);
    const auto separation = separate(pair.a, pair.b, 0.0);
    if (!truth.disjoint) {
      EXPECT_FALSE(separation);
    }
    if (surely_apart(truth, 0.0)) {
      EXPECT_TRUE(separation);
    }
    if (separation) {
      expect_holds(*separation, pair, 0.0, truth.distance);
    }
    ASSERT_FALSE(HasFailure()) << "pair " << k << ", exact distance " << truth.distance;
  }
}

TEST(SeparationLp, AgreesWithExactArithmetic) {
  for_random_pairs([](const PointSets& pair, const ExactSeparation& truth, Rng&) {
    const auto plane = separate_by_lp(pair.a, pair.b);
    if (!truth.disjoint) {
      EXPECT_FALSE(plane);
    }
    if (surely_apart(truth, 0.0)) {
      EXPECT_TRUE(plane);
    }
    if (plane) {
      EXPECT_TRUE(exactly_separates(*plane, pair.a, pair.b, 0.0));
    }
  });
}

TEST(Distance, IsTheExactOneAndWithinItsBounds) {
  for_random_pairs([](const PointSets& pair, const ExactSeparation& truth, Rng&) {
    const ShortestVector shortest = shortest_vector(pair.a, pair.b, 0.0);
    EXPECT_NEAR(distance(pair.a, pair.b), truth.distance, kGapRounding);
    EXPECT_LE(shortest.lower, truth.distance + kGapRounding);
    EXPECT_GE(shortest.upper, truth.distance - kGapRounding);
  });
}

TEST(Separation, IsTestedOnEveryKindOfPair) {
  int overlapping = 0, in_tolerance = 0, just_beyond = 0, apart = 0;
  for_random_pairs([&](const PointSets&, const ExactSeparation& truth, Rng&) {
    overlapping += truth.disjoint ? 0 : 1;
    in_tolerance += truth.disjoint && truth.distance <= kTouchingTolerance ? 1 : 0;
    just_beyond += truth.distance > kTouchingTolerance && truth.distance < 1e-5 ? 1 : 0;
    apart += truth.distance >= 1e-5 ? 1 : 0;
  });
  for (const int count : {overlapping, in_tolerance, just_beyond, apart}) EXPECT_GT(count, kPairs / 50);
  std::cout << overlapping << " overlap, " << in_tolerance << " within tolerance, " << just_beyond << " just beyond, "
            << apart << " apart\n";
}

TEST(Separation, IsAFunctionOfItsInputs) {
  Rng rng(1);
  for (int k = 0; k < 2000; ++k) {
    const PointSets pair = random_pair(PairKind::Generic, rng);
    const auto first = separate(pair.a, pair.b, 0.1);
    separate(random_pair(PairKind::NearTouching, rng).a, pair.b, 0.0);
    const auto second = separate(pair.a, pair.b, 0.1);
    ASSERT_EQ(first.has_value(), second.has_value());
    if (!first) continue;
    ASSERT_EQ(first->plane.n, second->plane.n);
    ASSERT_EQ(first->plane.d, second->plane.d);
    ASSERT_EQ(first->gap, second->gap);
  }
}

TEST(Separation, OfTwoBoxesIsTheFaceBetweenThem) {
  const Points a = box_corners(Box(Vec3(2.0, -1.0, -1.0), Vec3(3.0, 1.0, 1.0)));
  const Points b = box_corners(Box(Vec3(-1.0, -1.0, -1.0), Vec3(0.5, 1.0, 1.0)));
  const auto separation = separate(a, b, 0.25);
  ASSERT_TRUE(separation);
  EXPECT_LT((separation->plane.n - Vec3::UnitX()).norm(), 1e-12);
  EXPECT_NEAR(separation->plane.d, -2.0, 1e-12);
  EXPECT_NEAR(separation->gap, 1.5, 1e-12);
}

TEST(Separation, AsksTheLinearProgrammeWhereRoundingHidesTheGap) {
  const Points a = Vec3(1e9, 0.0, 0.0);
  const Points b = Vec3(1e9 - 0x1.0p-18, 0.0, 0.0);
  const SeparationCounts before = separation_counts();
  EXPECT_FALSE(separate(a, b, 0.0));
  EXPECT_EQ(separation_counts().fast, before.fast);
  EXPECT_EQ(separation_counts().lp, before.lp + 1);
}

TEST(Separation, RefusesWhatIsNoPointSet) {
  const Points point = Points::Zero(3, 1);
  EXPECT_THROW(separate(Points(3, 0), point, 0.0), std::invalid_argument);
  EXPECT_THROW(separate(point, Points(3, 0), 0.0), std::invalid_argument);
  EXPECT_THROW(separate(point, Points::Ones(3, 1), -1.0), std::invalid_argument);
  Points broken = Points::Ones(3, 4);
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    broken(1, 2) = bad;
    EXPECT_THROW(separate(broken, point, 0.0), std::invalid_argument);
    EXPECT_THROW(separate(point, broken, 0.0), std::invalid_argument);
    EXPECT_THROW(separate_by_lp(point, broken), std::invalid_argument);
  }
}

}  // namespace
}  // namespace tern
