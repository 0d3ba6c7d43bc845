#include "planner/hold.h"

#include <algorithm>

#include "planner/duration.h"
#include "planner/safety/thrust_set.h"
#include "planner/tuning.h"

namespace tern {

double HoldDemand::required(double end_s) const {
  const double to_step_aside = std::min(aside_s, predicted_s) - end_s;
  return std::clamp(until_s - end_s, 0.0, std::max(required_s, to_step_aside));
}

double HoldDemand::cap(double end_s) const { return std::max(cap_s, required(end_s)); }

double HoldDemand::cap_of_stop(double end_s) const { return std::max(cap(end_s), predicted_s - end_s); }

double time_to_step_aside(const Limits& limits, const Vec3& body_half, const Vec3& mover_half) {
  double times[3];
  for (int axis = 0; axis < 3; ++axis) {
    const Vec3 aside = Vec3::Unit(axis) * (body_half[axis] + mover_half[axis]);
    times[axis] = kStopScale * least_duration(MotionSample{}, aside, limits);
  }
  std::sort(std::begin(times), std::end(times));
  return times[1];
}

namespace {

/// How long from t_s on α stays within `width`, s: beyond, a prediction says little more than that it may be there.
double known_for(const PlanningObstacle& obstacle, double width, UTime t_s) {
  const PiecewiseCubic& motion = obstacle.track->motion;
  UTime until = motion.start;
  for (std::size_t k = 0; k < motion.pieces.size(); ++k) {
    if (obstacle.alpha.of(*obstacle.track, k).maxCoeff() > width) break;
    until = until + motion.pieces[k].duration;
  }
  return std::max(0.0, (until - t_s).seconds());
}

}  // namespace

HoldDemand hold_demand(const HorizonRequest& request, const PlannerConfig& config,
                       const std::vector<PlanningObstacle>& obstacles, double horizon_s) {
  const double longest_s = std::max(0.5 * horizon_s, kLeastHold);
  HoldDemand hold{std::min(config.hold_required_s, longest_s), std::min(config.hold_cap_s, longest_s),
                  config.hold_until_s};
  Vec3 largest = Vec3::Zero();
  int estimated = 0;
  for (const PlanningObstacle& obstacle : obstacles) {
    if (!obstacle.moves()) continue;
    hold.promised = hold.promised && obstacle.is_promised();
    estimated += obstacle.is_promised() ? 0 : 1;
    largest = largest.cwiseMax(obstacle.track->half_extents);
    hold.predicted_s = std::max(hold.predicted_s, (obstacle.track->motion.end() - request.t_s).seconds());
  }
  if (largest.isZero(0.0)) return hold;
  const Vec3 body = request.body.half_extents();
  hold.aside_s = time_to_step_aside(boxed(request.limits), body, largest);
  hold.width = (body + largest).maxCoeff();
  Vec3 sides = body + largest;
  std::sort(sides.data(), sides.data() + 3);
  double known_s = 0.0;
  for (const PlanningObstacle& obstacle : obstacles) {
    if (!obstacle.is_promised()) known_s += known_for(obstacle, sides[1], request.t_s) / estimated;
  }
  if (estimated > 0) hold.until_s = std::min(hold.until_s, known_s);
  return hold;
}

}  // namespace tern
