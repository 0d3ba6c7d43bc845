#include "tests/support/point_sets.h"

#include <algorithm>
#include <cmath>

#include "tests/support/exact_separation.h"

namespace tern {
namespace {

int random_int(Rng& rng, int lo, int hi) { return lo + static_cast<int>(std::floor(rng.uniform() * (hi - lo + 1))); }

Vec3 random_vector(Rng& rng, double size) {
  return {rng.uniform(-size, size), rng.uniform(-size, size), rng.uniform(-size, size)};
}

Points cloud(Rng& rng, int count, const Vec3& centre, double size) {
  Points points(3, count);
  for (int k = 0; k < count; ++k) points.col(k) = centre + random_vector(rng, size);
  return points;
}

Points lattice(Rng& rng, int count) {
  Points points(3, count);
  for (double& x : points.reshaped()) x = 0.5 * random_int(rng, -2, 2);
  return points;
}

// A cloud of 1 m by 1 mm or less by 0.1 µm or less, turned at random.
Points sliver(Rng& rng, int count) {
  const Eigen::Quaterniond turn =
      Eigen::Quaterniond(rng.uniform(-1.0, 1.0), rng.uniform(-1.0, 1.0), rng.uniform(-1.0, 1.0), 1e-3).normalized();
  const Vec3 sizes(1.0, rng.uniform() < 0.5 ? 1.0 : 1e-3 * rng.uniform(), 1e-7 * rng.uniform());
  return turn.toRotationMatrix() * sizes.asDiagonal() * cloud(rng, count, Vec3::Zero(), 1.0);
}

// The plane or line through integer directions; coefficients are halves, so that everything stays on the grid.
Points in_subspace(Rng& rng, int count, const Eigen::Matrix<double, 3, 2>& directions, const Vec3& origin) {
  Points points(3, count);
  for (int k = 0; k < count; ++k) {
    points.col(k) = origin + directions * Eigen::Vector2d(0.25 * random_int(rng, -4, 4), 0.25 * random_int(rng, -4, 4));
  }
  return points;
}

PointSets subspaces(Rng& rng, bool line) {
  const auto directions = [&] {
    Eigen::Matrix<double, 3, 2> d;
    for (double& x : d.reshaped()) x = random_int(rng, -2, 2);
    if (line) d.col(1) = d.col(0);
    return d;
  };
  const Eigen::Matrix<double, 3, 2> first = directions();
  const bool same = rng.uniform() < 0.6;
  const Vec3 shift = 0.5 * lattice(rng, 1).col(0) + (rng.uniform() < 0.5 ? Vec3(first.col(0) * 2.0) : Vec3::Zero());
  return {in_subspace(rng, random_int(rng, 1, 10), first, Vec3::Zero()),
          in_subspace(rng, random_int(rng, 1, 5), same ? first : directions(), shift)};
}

// b moved along the shortest vector until `gap` is left (up to the grid); unchanged if they overlap.
PointSets brought_near(const PointSets& pair, double gap, Rng& rng) {
  const ExactSeparation before = exact_separation(pair.a, pair.b);
  if (!before.disjoint) return pair;
  // Bisection on a random line through both needs no code under test.
  const Vec3 direction = pair.a.rowwise().mean() - pair.b.rowwise().mean() + random_vector(rng, 0.1);
  double lo = 0.0, hi = 1.0;
  const auto moved = [&](double t) -> Points { return on_exact_grid(pair.b.colwise() + t * direction); };
  for (int k = 0; k < 30; ++k) {
    const double t = 0.5 * (lo + hi);
    (exact_separation(pair.a, moved(t)).distance > gap ? lo : hi) = t;
  }
  return {pair.a, moved(rng.uniform() < 0.5 ? lo : hi)};
}

}  // namespace

Points on_exact_grid(const Points& points) { return (points / kExactGrid).array().round() * kExactGrid; }

PointSets random_pair(PairKind kind, Rng& rng) {
  const int n = random_int(rng, 1, 20);
  const int m = random_int(rng, 1, 8);
  switch (kind) {
    case PairKind::Generic:
      return {on_exact_grid(cloud(rng, n, Vec3::Zero(), rng.uniform(0.1, 1.5))),
              on_exact_grid(cloud(rng, m, random_vector(rng, rng.uniform(0.0, 5.0)), rng.uniform(0.01, 1.5)))};
    case PairKind::Lattice: {
      Points b = lattice(rng, m);
      b.colwise() += lattice(rng, 1).col(0) * random_int(rng, 0, 3);
      return {lattice(rng, n), b};
    }
    case PairKind::Nested: {
      const Points a = on_exact_grid(cloud(rng, n, Vec3::Zero(), 1.0));
      const Vec3 middle = a.rowwise().mean();
      const Points b = ((a.leftCols(std::min(n, m)).colwise() - middle) * rng.uniform(0.1, 1.0)).colwise() + middle;
      return {a, on_exact_grid(b)};
    }
    case PairKind::Flat: return subspaces(rng, false);
    case PairKind::Line: return subspaces(rng, true);
    case PairKind::Single: {
      const Points a = lattice(rng, rng.uniform() < 0.5 ? 1 : n);
      return {a, rng.uniform() < 0.3 ? Points(a.col(0)) : on_exact_grid(cloud(rng, 1, Vec3::Zero(), 1.5))};
    }
    case PairKind::Identical: {
      const Points a = rng.uniform() < 0.5 ? lattice(rng, n) : on_exact_grid(cloud(rng, n, Vec3::Zero(), 1.0));
      return {a, a.rowwise().reverse()};
    }
    case PairKind::Sliver: {
      const Points b = sliver(rng, m).colwise() + random_vector(rng, rng.uniform() < 0.5 ? 1e-6 : 1.0);
      return {on_exact_grid(sliver(rng, n)), on_exact_grid(b)};
    }
    case PairKind::NearTouching: {
      constexpr PairKind kSeeds[]{PairKind::Generic, PairKind::Generic, PairKind::Lattice, PairKind::Flat,
                                  PairKind::Line,    PairKind::Sliver,  PairKind::Sliver,  PairKind::Single};
      return brought_near(random_pair(kSeeds[random_int(rng, 0, 7)], rng), rng.uniform(0.0, 4e-6), rng);
    }
    case PairKind::FarAway: {
      PointSets pair = random_pair(PairKind::NearTouching, rng);
      const Vec3 offset = 1e4 * lattice(rng, 1).col(0);
      pair.a.colwise() += offset;
      pair.b.colwise() += offset;
      return pair;
    }
  }
  return {};
}

}  // namespace tern
