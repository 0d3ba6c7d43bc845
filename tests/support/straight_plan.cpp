#include "tests/support/straight_plan.h"

#include <Eigen/QR>
#include <algorithm>
#include <optional>

#include "core/geometry/box.h"

namespace tern {
namespace {

constexpr double kSameEnd = 1e-6;

/// Control points of least Σ‖jerk‖² between a start state and rest at `end`.
Points least_jerk_points(const MotionSample& start, const Vec3& end, int intervals, double interval_s) {
  const SplineBasis& basis = spline_basis(intervals);
  Points q(3, intervals + 3);
  q.leftCols<3>() = start_control_points(start, interval_s);
  q.rightCols<3>().colwise() = end;
  Eigen::MatrixXd jerk = Eigen::MatrixXd::Zero(intervals, intervals + 3);
  for (int j = 0; j < intervals; ++j) jerk.row(j).segment<4>(j) = basis.jerk(j).transpose();
  const int free = intervals - 3;
  Eigen::MatrixXd fixed = jerk;
  fixed.middleCols(3, free).setZero();
  q.middleCols(3, free).setZero();
  const Eigen::MatrixXd target = -fixed * q.transpose();
  q.middleCols(3, free) = jerk.middleCols(3, free).colPivHouseholderQr().solve(target).transpose();
  return q;
}

bool obeys(const ClampedSpline& spline, const Limits& limits, double share) {
  const MotionBounds bounds = motion_bounds(spline);
  return (bounds.v_max.array() <= share * limits.v_max.array()).all() &&
         (bounds.a_max.array() <= share * limits.a_max.array()).all() &&
         (bounds.j_max.array() <= share * limits.j_max.array()).all();
}

std::optional<TimedSpline> shortest(const HorizonRequest& request, const Vec3& end,
                                    const StraightPlanOptions& options) {
  for (Duration interval{20'000}; interval < Duration{3'000'000}; interval.us += interval.us / 16) {
    TimedSpline timed{request.t_s, interval,
                      least_jerk_points(request.start, end, options.intervals, interval.seconds())};
    if (obeys(timed.spline(), request.limits, options.limit_share)) return timed;
  }
  return std::nullopt;
}

Plan keep(Plan plan, const HorizonRequest& request, PlanReason reason) {
  plan.outcome = PlanOutcome::KeepCommitted;
  plan.reason = reason;
  plan.trajectory = request.committed;
  return plan;
}

}  // namespace

Plan straight_plan(const HorizonRequest& request, const Vec3& goal, const StraightPlanOptions& options) {
  Plan plan;
  plan.request_id = request.id;
  plan.inputs.request = request.header.name;
  plan.sphere_radius = options.reach_m;
  const Vec3 way = goal - request.start.p;
  const Vec3 end = request.start.p + way * std::min(1.0, options.reach_m / std::max(way.norm(), 1e-12));
  plan.local_goal = end;
  const Vec3 committed_end = request.committed.control_points.rightCols<1>();
  if ((committed_end - goal).norm() < kSameEnd) {
    const bool rests = request.t_s >= request.committed.end();
    return keep(std::move(plan), request, rests ? PlanReason::AtGoal : PlanReason::WorsePlan);
  }
  const std::optional<TimedSpline> trajectory = shortest(request, end, options);
  if (!trajectory) return keep(std::move(plan), request, PlanReason::Infeasible);
  plan.outcome = PlanOutcome::Optimized;
  plan.trajectory = *trajectory;
  return plan;
}

Plan some_plan(UTime t_s) {
  HorizonRequest request;
  request.id = 1;
  request.t_s = t_s;
  request.committed.start = request.t_s;
  request.flight_box = box_around(Vec3::Zero(), Vec3::Constant(100.0));
  Plan plan = straight_plan(request, Vec3(20.0, 10.0, 3.0));
  plan.inputs.request = {1, 1};
  return plan;
}

}  // namespace tern
