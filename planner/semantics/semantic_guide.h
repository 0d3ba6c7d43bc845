// What regions add to Eq. 2 on the way to a local goal, and to the choice between trajectories.
#pragma once

#include "core/base/types.h"
#include "core/splines/clamped_spline.h"
#include "planner/problem/planner_config.h"
#include "planner/semantics/semantic_fields.h"

namespace tern {

/// Either cost, in metres of way, as what was flown (`along`) plus what is expected of the rest (`ahead`).
///
/// Exposure: both are integrals of λ-weighted exposure, `ahead` along the straight line to the local goal. Straight on,
/// the sum stays the same and a search goes deep. Leaving what repels, or reaching what attracts, lowers it.
///
/// Mean distance (Eq. 3): `along` is 0. `ahead` is λ_att C_att − λ_rep C_rep at the node, counted from the same at the
/// point of the straight way with equal progress. Only nodes of equal progress compete, so the order is Eq. 2's. But
/// progress is not penalized for coming nearer to what repels.
class SemanticGuide {
 public:
  /// Keeps a reference to the fields.
  SemanticGuide(const SemanticFields& fields, SemanticCost cost, const Vec3& start, const Vec3& local_goal)
      : fields_(&fields), cost_(cost), start_(start), way_(local_goal - start) {}

  [[nodiscard]] double along(const Vec3& a, const Vec3& b) const;
  [[nodiscard]] double ahead(const Vec3& q) const;

  /// along + ahead of a trajectory that is flown from `from_s` for `while_s` and then left.
  [[nodiscard]] double of(const ClampedSpline& trajectory, double from_s, double while_s) const;

 private:
  const SemanticFields* fields_;
  SemanticCost cost_;
  Vec3 start_;
  Vec3 way_;
};

}  // namespace tern
