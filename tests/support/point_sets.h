// Random pairs of point sets for separation tests: generic, touching and degenerate ones.
#pragma once

#include "core/base/random.h"
#include "core/base/types.h"

namespace tern {

/// Two point sets, m, all coordinates multiples of kExactGrid.
struct PointSets {
  Points a, b;
};

/// The kind of a pair.
enum class PairKind {
  Generic,       ///< two clouds in boxes of up to 3 m, anywhere within 5 m
  Lattice,       ///< on {−1, −½, 0, ½, 1}³: touching, coplanar, coincident, repeated points
  Nested,        ///< b lies inside a
  Flat,          ///< each in a plane, often the same one
  Line,          ///< each on a line, often the same one
  Single,        ///< one point against one or a cloud
  Identical,     ///< b is a with its columns in reverse order
  Sliver,        ///< flat or very thin (a few steps of the grid), turned at random
  NearTouching,  ///< a pair of another kind, moved to a distance of 0 to 4e-6 m
  FarAway,       ///< NearTouching, 1e4 m from the origin
};
inline constexpr int kPairKinds = 10;

/// Returns `points` with each coordinate rounded to a multiple of kExactGrid.
Points on_exact_grid(const Points& points);

/// Returns a random pair of this kind, with 1 to 20 points in a and 1 to 8 in b.
PointSets random_pair(PairKind kind, Rng& rng);

}  // namespace tern
