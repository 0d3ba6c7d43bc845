#include "planner/heading/path_term.h"

#include <algorithm>
#include <cmath>

#include "planner/problem/tuning.h"

namespace tern {

double stop_time(double speed, const Limits& limits) {
  const double a = std::min(limits.a_max.x(), limits.a_max.y()), j = std::min(limits.j_max.x(), limits.j_max.y());
  return speed * j >= a * a ? speed / a + a / j : 2.0 * std::sqrt(speed / j);
}

PathTerm::PathTerm(const TimedSpline& trajectory, const Vec3& local_goal, const Limits& limits)
    : spline_(trajectory.spline()),
      start_(trajectory.start),
      end_(trajectory.end()),
      local_goal_(local_goal),
      limits_(limits) {}

void PathTerm::look(const LookInstant& now, std::vector<LookTarget>& targets) const {
  const double speed = now.v.head<2>().norm();
  const double step_s = (kSightAhead + stop_time(speed, limits_)) / kPathPlaces;
  const double worth = std::max(speed, kLeastPathSpeed) / kPathPlaces;
  for (int k = 1; k <= kPathPlaces; ++k) {
    const UTime then = now.at + Duration::from_seconds(step_s * k);
    Vec3 place = local_goal_;
    if (then <= end_) place = spline_.sample((then - start_).seconds()).p;
    const Vec3 way = place - now.p;
    if (way.head<2>().norm() < kNearestPlace) continue;
    targets.push_back({std::atan2(way.y(), way.x()), worth});
  }
}

}  // namespace tern
