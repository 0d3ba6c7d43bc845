#include "planner/hold.h"

#include <algorithm>

#include "planner/duration.h"
#include "planner/problem/tuning.h"
#include "planner/safety/thrust_set.h"

namespace tern {

double HoldDemand::required(double end_s) const {
  const double to_step_aside = std::min(side_step_s, predicted_s) - end_s;
  return std::clamp(until_s - end_s, 0.0, std::max(required_s, to_step_aside));
}

double HoldDemand::cap(double end_s) const { return std::max(cap_s, required(end_s)); }

double HoldDemand::cap_of_stop(double end_s) const { return std::max(cap(end_s), predicted_s - end_s); }

double side_step_time(const Limits& limits, const Vec3& body_half, const Vec3& mover_half) {
  double times[3];
  for (int axis = 0; axis < 3; ++axis) {
    const Vec3 aside = Vec3::Unit(axis) * (body_half[axis] + mover_half[axis]);
    times[axis] = kStopScale * min_duration(MotionSample{}, aside, limits);
  }
  std::sort(std::begin(times), std::end(times));
  return times[1];
}

namespace {

/// Returns for how long after t_s the growing α stays within `width`, s. Beyond that, a prediction says little more
/// than that the obstacle may be there.
double known_for(const PlanningObstacle& obstacle, double width, UTime t_s) {
  const PiecewiseCubic& motion = obstacle.track->motion;
  const AlphaShare growing{obstacle.alpha.level, obstacle.alpha.scale};
  UTime until = motion.start;
  for (std::size_t k = 0; k < motion.pieces.size(); ++k) {
    if (growing.of(*obstacle.track, k).maxCoeff() > width) break;
    until = until + motion.pieces[k].duration;
  }
  return std::max(0.0, (until - t_s).seconds());
}

double middle_of(Vec3 sides) {
  std::sort(sides.data(), sides.data() + 3);
  return sides[1];
}

/// Returns the longest side_step_time() over all movers. A mover that is no larger than an earlier one on any axis is
/// skipped.
double max_side_step_time(const HorizonRequest& request, const std::vector<PlanningObstacle>& obstacles) {
  const Limits limits = per_axis_limits(request.limits);
  std::vector<Vec3> sizes;
  double longest_s = 0.0;
  for (const PlanningObstacle& obstacle : obstacles) {
    if (!obstacle.moves()) continue;
    const Vec3& half = obstacle.track->half_extents;
    const auto covers = [&](const Vec3& size) { return (half.array() <= size.array()).all(); };
    if (std::any_of(sizes.begin(), sizes.end(), covers)) continue;
    sizes.push_back(half);
    longest_s = std::max(longest_s, side_step_time(limits, request.body.half_extents(), half));
  }
  return longest_s;
}

}  // namespace

HoldDemand hold_demand(const HorizonRequest& request, const PlannerConfig& config,
                       const std::vector<PlanningObstacle>& obstacles, double horizon_s) {
  const double longest_s = std::max(0.5 * horizon_s, kMinHold);
  HoldDemand hold;
  hold.required_s = std::min(config.hold_required_s, longest_s);
  hold.cap_s = std::min(config.hold_cap_s, longest_s);
  const Vec3 body = request.body.half_extents();
  double known_s = 0.0;
  int estimated = 0;
  for (const PlanningObstacle& obstacle : obstacles) {
    if (!obstacle.moves()) continue;
    const Vec3 both = body + obstacle.track->half_extents;
    hold.width = std::max(hold.width, both.maxCoeff());
    hold.predicted_s = std::max(hold.predicted_s, (obstacle.motion_end() - request.t_s).seconds());
    if (obstacle.is_declared_or_static()) continue;
    hold.has_estimated = true;
    known_s += known_for(obstacle, middle_of(both), request.t_s);
    ++estimated;
  }
  hold.side_step_s = max_side_step_time(request, obstacles);
  if (estimated > 0) hold.until_s = known_s / estimated;
  return hold;
}

}  // namespace tern
