// The semantic cost of a course: added to Eq. 2 in the search, and to the arrival in the choice. See
// docs/planner/search.md.
#pragma once

#include "core/base/types.h"
#include "core/splines/clamped_spline.h"
#include "planner/problem/planner_config.h"
#include "planner/semantics/semantic_fields.h"

namespace tern {

/// The semantic cost in metres: the cost of the part that is flown (`along`) plus the expected cost of the rest
/// (`ahead`).
///
///  - Exposure: both are integrals of λ-weighted exposure; `ahead` is along the straight line to the local goal. On
///    that line the sum is constant, so the search goes deep. Leaving a repulsive region lowers it, as does reaching
///    an attractive one.
///  - Mean distance (Eq. 3): `along` is 0. `ahead` is λ_att C_att − λ_rep C_rep at q, minus the same at the point of
///    the straight line with equal progress. Only nodes of equal progress compete, so the order is that of Eq. 2.
///    Progress is not penalized for coming nearer to a repulsive region.
class SemanticGuide {
 public:
  /// @param fields  must outlive the guide
  SemanticGuide(const SemanticFields& fields, SemanticCost cost, const Vec3& start, const Vec3& local_goal)
      : fields_(&fields), cost_(cost), start_(start), way_(local_goal - start) {}

  /// Returns the cost of the step from a to b, m.
  [[nodiscard]] double along(const Vec3& a, const Vec3& b) const;
  /// Returns the expected cost of the rest of the way from q, m.
  [[nodiscard]] double ahead(const Vec3& q) const;

  /// Returns along + ahead of a trajectory that is flown from from_s for while_s and then left, m.
  [[nodiscard]] double of(const ClampedSpline& trajectory, double from_s, double while_s) const;

 private:
  const SemanticFields* fields_;
  SemanticCost cost_;
  Vec3 start_;
  Vec3 way_;
};

}  // namespace tern
