#include "core/world/body_distance.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/random.h"
#include "core/geometry/box.h"
#include "tests/support/random_splines.h"

namespace tern {
namespace {

using support::random_vector;

Body sphere(double radius) { return {Points::Zero(3, 1), radius}; }

Body polytope(Rng& rng, int vertices, double size) {
  Points v(3, vertices);
  for (int i = 0; i < vertices; ++i) v.col(i) = random_vector(rng, size);
  return {v, 0.0};
}

TEST(BodyDistance, OfASphereIsThePointsMinusTheRadius) {
  const BodyDistance d(sphere(0.1));
  const Vec3 h(1, 2, 3);
  EXPECT_DOUBLE_EQ(d(Vec3(3, 0, 0), h), 1.9);
  EXPECT_DOUBLE_EQ(d(Vec3(4, 6, 0), h), 4.9);
  EXPECT_NEAR(d(Vec3(1.05, 0, 0), h), -0.05, 1e-15);
  EXPECT_DOUBLE_EQ(d(Vec3(0.7, 0, 0), h), -0.4) << "inside: the shortest way out and the radius";
  EXPECT_DOUBLE_EQ(d(Vec3::Zero(), h), -1.1);
}

TEST(BodyDistance, OfABoxIsThatOfTwoBoxes) {
  Body body{box_corners(box_around(Vec3::Zero(), Vec3::Constant(0.1))), 0.0};
  const BodyDistance d(body);
  const Vec3 h(1, 1, 1);
  EXPECT_NEAR(d(Vec3(1.1 + 3, 1.1 + 4, 0), h), 5.0, 1e-12);
  EXPECT_NEAR(d(Vec3(1.05, 0, 0), h), -0.05, 1e-12);
  EXPECT_NEAR(d(Vec3(1.1, 0, 0), h), 0.0, 1e-12);
}

TEST(BodyDistance, OfABoxBodyAgreesWithTheGeneralPolytope) {
  Rng rng(1);
  for (int i = 0; i < 300; ++i) {
    const Vec3 size = Vec3::Constant(0.05) + random_vector(rng, 1.0).cwiseAbs();
    const Vec3 off = random_vector(rng, 0.2);
    const Points corners = box_corners(box_around(off, size));
    Body box{corners, 0.0};
    // A corner at the middle of an edge, moved inwards by 1e-9: the hull hardly changes, the code path does.
    Body general{corners, 0.0};
    general.vertices.col(7) -= Vec3::Constant(1e-9);
    const Vec3 p = random_vector(rng, 3.0);
    const Vec3 h = Vec3::Constant(0.1) + random_vector(rng, 1.0).cwiseAbs();
    EXPECT_NEAR(BodyDistance(box)(p, h), BodyDistance(general)(p, h), 1e-8);
  }
}

/// Supporting slabs in many directions: the signed distance is the largest separation over all unit directions.
double by_directions(const Body& body, const Vec3& p, const Vec3& h, Rng& rng) {
  double best = -1e9;
  const auto separation = [&](const Vec3& n) {
    return (n.transpose() * (body.vertices.colwise() + p)).minCoeff() - h.dot(n.cwiseAbs());
  };
  Vec3 best_n = Vec3::UnitX();
  for (int i = 0; i < 20'000; ++i) {
    const double spread = i < 4000 ? 1.0 : 0.3 * std::pow(0.9985, i - 4000);
    const Vec3 n = ((i < 4000 ? Vec3::Zero().eval() : best_n) + random_vector(rng, spread)).normalized();
    if (const double s = separation(n); s > best) {
      best = s;
      best_n = n;
    }
  }
  return best - body.radius;
}

TEST(BodyDistance, OfAPolytopeIsTheWidestSlabApartAndInOverlap) {
  Rng rng(7);
  int overlaps = 0;
  for (int i = 0; i < 60; ++i) {
    Body body = polytope(rng, 4 + i % 5, 0.5);
    body.radius = i % 2 == 0 ? 0.0 : 0.07;
    const Vec3 p = random_vector(rng, i % 2 == 0 ? 1.2 : 0.6);
    const Vec3 h = Vec3::Constant(0.1) + random_vector(rng, 0.5).cwiseAbs();
    const double d = BodyDistance(body)(p, h);
    overlaps += d < 0.0 ? 1 : 0;
    const double slab = by_directions(body, p, h, rng);
    EXPECT_LE(slab, d + 1e-9) << "a slab proves more than the distance";
    EXPECT_NEAR(slab, d, 2e-3);
  }
  EXPECT_GT(overlaps, 10);
}

TEST(BodyDistance, OfSegmentsAndTrianglesWorks) {
  Points segment(3, 2);
  segment << -1, 1, 0, 0, 0, 0;
  const BodyDistance d({segment, 0.1});
  EXPECT_NEAR(d(Vec3(0, 0, 1.5), Vec3::Ones()), 0.4, 1e-9);
  EXPECT_NEAR(d(Vec3(2.5, 0, 0), Vec3::Ones()), 0.4, 1e-9);
  EXPECT_NEAR(d(Vec3(0, 0, 0.8), Vec3::Ones()), -0.3, 1e-9);
}

TEST(BodyDistance, IsConvexAndNoSteeperThanOne) {
  Rng rng(3);
  const BodyDistance distances[] = {BodyDistance(sphere(0.2)), BodyDistance(polytope(rng, 8, 0.4))};
  for (const BodyDistance& d : distances) {
    for (int i = 0; i < 500; ++i) {
      const Vec3 h(0.3, 0.5, 0.7);
      const Vec3 p = random_vector(rng, 1.5);
      const Vec3 q = random_vector(rng, 1.5);
      const double s = rng.uniform();
      EXPECT_LE(d(p + s * (q - p), h), (1 - s) * d(p, h) + s * d(q, h) + 1e-9);
      EXPECT_LE(std::abs(d(p, h) - d(q, h)), (p - q).norm() + 1e-9);
    }
  }
}

TEST(BodyDistance, ThrowsOnABodyThatIsNone) {
  EXPECT_THROW(BodyDistance({Points(3, 0), 0.1}), std::invalid_argument);
  EXPECT_THROW(BodyDistance({Points::Zero(3, 1), -0.1}), std::invalid_argument);
}

}  // namespace
}  // namespace tern
