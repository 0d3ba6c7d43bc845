// Random pairs of point sets for separation tests: the easy, the touching and the degenerate.
#pragma once

#include "core/base/random.h"
#include "core/base/types.h"

namespace tern {

/// Two point sets, m, all coordinates multiples of kExactGrid.
struct PointSets {
  Points a, b;
};

/// What a pair is meant to exercise.
enum class PairKind {
  Generic,       ///< two clouds in boxes of up to 3 m, anywhere within 5 m
  Lattice,       ///< on {−1, −½, 0, ½, 1}³: touching, coplanar, coincident, repeated points
  Nested,        ///< b shrunk into a
  Flat,          ///< each in a plane, often the same one
  Line,          ///< each on a line, often the same one
  Single,        ///< one point against one or a cloud
  Identical,     ///< b is a, with its columns turned around
  Sliver,        ///< flat or thin as a hair up to a few steps of the grid, turned at random
  NearTouching,  ///< a pair of the other kinds moved until 0 to 4e-6 m apart
  FarAway,       ///< NearTouching, 1e4 m from the origin
};
inline constexpr int kPairKinds = 10;

/// `points` with each coordinate rounded to a multiple of kExactGrid.
Points on_exact_grid(const Points& points);

/// A random pair of that kind; 1 to 20 points in a, 1 to 8 in b.
PointSets random_pair(PairKind kind, Rng& rng);

}  // namespace tern
