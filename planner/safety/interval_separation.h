// One interval of a curve against all obstacles of that time: boxes, then planes, then the interval split in time.
#pragma once

#include <cstdint>
#include <vector>

#include "core/splines/hull_basis.h"
#include "core/world/horizon.h"
#include "planner/safety/swept_obstacles.h"

namespace tern {

/// How pairs of (obstacle, interval part) were settled.
struct PairCounts {
  std::int64_t by_box = 0;      ///< their boxes are disjoint
  std::int64_t by_instant = 0;  ///< they touch at one of five instants
  std::int64_t by_cache = 0;    ///< separated along the direction that separated the obstacle's part last
  std::int64_t by_plane = 0;    ///< by the distance algorithm

  PairCounts& operator+=(const PairCounts& o) {
    by_box += o.by_box;
    by_instant += o.by_instant;
    by_cache += o.by_cache;
    by_plane += o.by_plane;
    return *this;
  }
};

/// What stands against an interval.
struct Separated {
  bool ok = true;
  std::int64_t blocker = 0;  ///< id of the first obstacle that is not separated, when !ok
};

/// Eq. 1 for one interval: is the curve (powers of u ∈ [0, 1] over the whole interval) separated from every obstacle?
///
/// A pair whose boxes are disjoint needs no plane. Otherwise a plane must separate the MINVO points of the whole
/// interval, of both its halves, or of the quarters of a half that fails. Planes are made from (hull, points), so that
/// anyone can make them again.
/// @param planes  gets every plane that was needed
Separated separate_interval(SweptObstacles& obstacles, int interval, const PowerCubic& power, PairCounts& counts,
                            std::vector<CertificatePlane>& planes);

/// Planes for a solver, by the same splitting, from every obstacle whose boxes come nearer than `reach`, m, to the
/// spline's. They are made from the sweeps, without hulls. In each interval they end at the first obstacle that is not
/// separated.
/// @param basis   whose hull points stand for the curve
/// @param planes  gets them
void find_planes(SweptObstacles& obstacles, const ClampedSpline& spline, HullBasis basis, double reach,
                 PairCounts& counts, std::vector<CertificatePlane>& planes);

/// The question of separate_interval() for many curves: only yes or no, without planes or hulls. The answer is the same
/// but for rounding within kTouchingTolerance of touching. What blocked the interval last is asked first.
/// @param points  the curve's hull points (of `form`, MINVO) over the whole interval
bool is_separated(SweptObstacles& obstacles, int interval, const PowerCubic& power, const Points4& points,
                  PairCounts& counts, HullForm form = {});

/// How long a body at rest stays separated from every obstacle.
struct ClearTime {
  double seconds = 0.0;                       ///< 0 when it is not separated in the first interval
  const PlanningObstacle* blocker = nullptr;  ///< what ends it; null: nothing as far as was looked
};

/// Of the body at rest at p, from the start of interval `first` on: to the end of the last interval in which it is
/// separated.
ClearTime clear_time_at(SweptObstacles& obstacles, int first, const Vec3& p, PairCounts& counts);

/// Whether a hold lasts as long as is asked. Holds are differences of times, so that a full one may round to just less.
inline bool lasts(double hold_s, double required_s) { return hold_s >= required_s - 1e-9; }

}  // namespace tern
