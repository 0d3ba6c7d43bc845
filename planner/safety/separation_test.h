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
  std::int64_t by_box = 0;
  std::int64_t by_plane = 0;
};

/// What stands against an interval.
struct Separated {
  bool ok = true;
  std::int64_t blocker = 0;  ///< id of the first obstacle that is not separated, when !ok
};

/// Eq. 1 for one interval: is the curve (powers of u ∈ [0, 1] over the whole interval) separated from every obstacle?
///
/// A pair whose boxes are disjoint needs no plane. Otherwise a plane must hold the MINVO points of the whole interval,
/// or of both its halves, or of the quarters of a half that fails. @param planes  if not null, gets every plane that
/// was needed.
/// @param reach  m: boxes nearer than this count as overlapping, so that near obstacles get their planes too.
/// @param form   whose hull points stand for the curve: the checker takes the tightest, MINVO.
Separated separate_interval(SweptObstacles& obstacles, int interval, const PowerCubic& power, PairCounts& counts,
                            std::vector<CertificatePlane>* planes, double reach = 0.0, HullForm form = {});

/// How long the body at rest at p stays separated from every obstacle, from the start of interval `first` on: the end
/// of the last clear interval minus the start of the first, s (0 when the first is not clear).
double clear_time_at(SweptObstacles& obstacles, int first, const Vec3& p, PairCounts& counts);

/// MINVO points of the part [u0, u1] of a cubic in powers of u.
Points4 minvo_of(const PowerCubic& power, double u0, double u1);

}  // namespace tern
