// Separation of one interval of a curve from all obstacles: by boxes, then planes, then with the interval split in
// time. See docs/planner/separation.md.
#pragma once

#include <cstdint>
#include <vector>

#include "core/splines/hull_basis.h"
#include "core/world/horizon.h"
#include "planner/safety/separation_cache.h"

namespace tern {

/// Counts of pairs (obstacle, part of an interval) by the test that decided them.
struct PairCounts {
  std::int64_t by_box = 0;      ///< their boxes are disjoint
  std::int64_t by_instant = 0;  ///< they touch at one of five instants: not separated
  std::int64_t by_cache = 0;    ///< separated along the direction that last separated this part of the obstacle
  std::int64_t by_plane = 0;    ///< decided by the distance algorithm (GJK)

  PairCounts& operator+=(const PairCounts& o) {
    by_box += o.by_box;
    by_instant += o.by_instant;
    by_cache += o.by_cache;
    by_plane += o.by_plane;
    return *this;
  }
};

/// The result for one interval.
struct Separated {
  bool ok = true;
  std::int64_t blocker = 0;  ///< if !ok, the id of the first obstacle that is not separated
};

/// Returns whether the curve is separated from every obstacle in an interval (Eq. 1).
///
/// A pair whose boxes are disjoint needs no plane. For any other pair a plane must separate the MINVO points of the
/// whole interval. If there is none, both halves need one each; if a half has none, both its quarters do. Each plane is
/// a pure function of hull and points, so anyone can compute it again.
/// @param power   the curve in powers of u ∈ [0, 1] over the whole interval
/// @param planes  receives every plane that was needed
Separated separate_interval(SeparationCache& cache, int interval, const PowerCubic& power, PairCounts& counts,
                            std::vector<CertificatePlane>& planes);

/// Finds planes for a solver, by the same splitting, from every obstacle whose boxes come nearer than `reach` to those
/// of the spline.
///
/// The planes are made from the sweeps, without hulls. In each interval the search for planes ends at the first
/// obstacle that is not separated.
/// @param basis   its hull points represent the curve
/// @param reach   m
/// @param planes  receives them
void find_planes(SeparationCache& cache, const ClampedSpline& spline, HullBasis basis, double reach, PairCounts& counts,
                 std::vector<CertificatePlane>& planes);

/// Answers the question of separate_interval() with yes or no: for many curves, since it needs neither planes nor
/// hulls.
///
/// The answers are equal, except that rounding may turn a pair within kTouchingTolerance of touching into "not
/// separated". The obstacle that blocked the interval last is tested first.
/// @param points  the curve's hull points (of `form`; MINVO by default) over the whole interval
bool is_separated(SeparationCache& cache, int interval, const PowerCubic& power, const Points4& points,
                  PairCounts& counts, HullForm form = {});

/// How long a body at rest stays separated from every obstacle.
struct ClearTime {
  double seconds = 0.0;                       ///< 0 if it is not separated in the first interval, s
  const PlanningObstacle* blocker = nullptr;  ///< the obstacle that ends it; null if it lasts to the last interval
};

/// Returns the clear time of the body at rest at p, counted from the start of interval `first`. It ends with the last
/// interval in which the body is separated.
ClearTime clear_time_at(SeparationCache& cache, int first, const Vec3& p, PairCounts& counts);

/// Returns whether a hold is as long as required. Holds are differences of times, so rounding may make a full one
/// slightly shorter.
inline bool lasts(double hold_s, double required_s) { return hold_s >= required_s - 1e-9; }

}  // namespace tern
