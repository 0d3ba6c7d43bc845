// The reasons to look somewhere: terms behind one interface (heading_planner.h adds them up).
#pragma once

#include <vector>

#include "core/base/time.h"
#include "core/base/types.h"

namespace tern {

/// A direction that is worth looking at.
struct LookTarget {
  double bearing = 0.0;    ///< about W's z from W's x, rad
  double worth = 0.0;      ///< cost while it is not seen, in the unit of its term per second, ≥ 0
  double half_view = 0.0;  ///< half of the field of view of the camera that is to see it, rad; 0: of HeadingLimits
};

/// The vehicle at one instant of its plan.
struct LookInstant {
  UTime at;
  Vec3 p = Vec3::Zero();  ///< W, m
  Vec3 v = Vec3::Zero();  ///< W, m/s
};

/// One reason to look somewhere. A term is a pure function of the plan and its inputs.
class LookTerm {
 public:
  virtual ~LookTerm() = default;
  /// Turns the term's unit into metres, the unit of the planner's cost.
  [[nodiscard]] virtual double weight() const = 0;
  /// Appends the directions that are worth looking at from this instant.
  virtual void look(const LookInstant& now, std::vector<LookTarget>& targets) const = 0;
};

}  // namespace tern
