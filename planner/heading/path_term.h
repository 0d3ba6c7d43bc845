// The way ahead: what will be flown through before the vehicle can stop.
#pragma once

#include "core/world/vehicle.h"
#include "planner/heading/look_term.h"
#include "planner/problem/tuning.h"

namespace tern {

/// Returns the time to brake from this speed to rest, s: v/a + a/j, or 2√(v/j) if the acceleration a is not reached.
/// It uses the smaller horizontal limits.
double stop_time(double speed, const Limits& limits);

/// Looks at the places where the vehicle will be within kSightAhead and the time to stop. Beyond the end of the
/// trajectory that is the local goal.
///
/// The term's unit is m: the length of path that is flown while the way ahead is not seen. A vehicle slower than
/// kLeastPathSpeed is treated as if it flew at that speed, so that it looks where it will go. Places nearer than
/// kNearestPlace have no direction. kPathWeight lets the path outweigh all tracks together.
class PathTerm final : public LookTerm {
 public:
  /// @param trajectory  is kept by reference
  PathTerm(const TimedSpline& trajectory, const Vec3& local_goal, const Limits& limits);

  [[nodiscard]] double weight() const override { return kPathWeight; }
  void look(const LookInstant& now, std::vector<LookTarget>& targets) const override;

 private:
  ClampedSpline spline_;
  UTime start_, end_;
  Vec3 local_goal_;
  Limits limits_;
};

}  // namespace tern
