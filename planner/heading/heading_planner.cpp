#include "planner/heading/heading_planner.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "core/world/thrust.h"
#include "planner/heading/path_term.h"
#include "planner/heading/track_term.h"
#include "planner/problem/tuning.h"

namespace tern {
namespace {

MotionSample motion_at(const TimedSpline& trajectory, const ClampedSpline& spline, UTime t) {
  return spline.sample(std::max(0.0, (t - trajectory.start).seconds()));
}

/// The instants of a heading's control points: their Greville abscissae.
std::vector<LookInstant> look_instants(const TimedSpline& trajectory, UTime from) {
  const ClampedSpline spline = trajectory.spline();
  const int intervals = spline.intervals();
  const auto knot = [intervals](int i) { return static_cast<std::int64_t>(std::clamp(i - 3, 0, intervals)); };
  std::vector<LookInstant> instants;
  for (int i = 0; i < intervals + 3; ++i) {
    const Duration later{(knot(i + 1) + knot(i + 2) + knot(i + 3)) * trajectory.interval.us / 3};
    const MotionSample m = motion_at(trajectory, spline, from + later);
    instants.push_back({from + later, m.p, m.v});
  }
  return instants;
}

/// A field of view of this many degrees has no edge.
constexpr double kAllRound = 360.0;

using TargetLists = std::vector<std::vector<LookTarget>>;

/// The values of a term at each instant, with its weight applied.
TargetLists targets_of(const LookTerm& term, const std::vector<LookInstant>& instants) {
  TargetLists lists(instants.size());
  for (std::size_t k = 0; k < instants.size(); ++k) {
    term.look(instants[k], lists[k]);
    for (LookTarget& target : lists[k]) target.worth *= term.weight();
  }
  return lists;
}

void add(const TargetLists& more, TargetLists& to) {
  for (std::size_t k = 0; k < to.size(); ++k) to[k].insert(to[k].end(), more[k].begin(), more[k].end());
}

/// The value of a term along a heading.
double value_along(const PlanHeading& heading, const TargetLists& targets, const HeadingLimits& limits) {
  const int intervals = static_cast<int>(targets.size()) - 3;
  double value = 0.0;
  for (int i = 0; i <= intervals + 1; ++i) {
    value += rate_span(i, intervals, heading.interval.seconds()) *
             unseen_cost(heading.control_points[idx(i + 1)], targets[idx(i + 1)], to_radians(0.5 * limits.view_deg));
  }
  return value;
}

}  // namespace

HeadingStart heading_start(const YawSample& at, Duration interval) {
  const double q0 = wrapped_yaw(at.yaw);
  return {q0, q0 + at.rate * interval.seconds() / 3.0};
}

std::optional<YawSample> flight_direction(const HorizonRequest& request, const Plan& plan) {
  const MotionSample& start = request.start;
  if (start.v.head<2>().norm() >= kLeastPathSpeed) return YawSample{std::atan2(start.v.y(), start.v.x()), 0.0};
  const ClampedSpline spline = plan.trajectory.spline();
  for (int j = 1; j <= spline.intervals() + 1; ++j) {
    const UTime knot = plan.trajectory.start + plan.trajectory.interval * j;
    const Vec3 place = j <= spline.intervals() ? motion_at(plan.trajectory, spline, knot).p : plan.local_goal;
    const Vec3 way = place - start.p;
    if (way.head<2>().norm() >= kNearestPlace) return YawSample{std::atan2(way.y(), way.x()), 0.0};
  }
  return std::nullopt;
}

bool looks_around(const HorizonRequest& request, const Plan& plan, double wait_s) {
  const bool stays = plan.outcome == PlanOutcome::KeepCommitted && plan.trajectory.end() <= request.t_s;
  return stays && (request.t_s - plan.trajectory.end()).seconds() <= kLooksAroundShare * wait_s;
}

std::optional<PlanHeading> plan_heading(const HorizonRequest& request, const Plan& plan,
                                        const std::vector<Track>& tracks, const HeadingLimits& limits,
                                        const HeadingStart& start, const LookReasons& reasons) {
  if (plan.outcome == PlanOutcome::NoPlan) return std::nullopt;
  const TimedSpline& trajectory = plan.trajectory;
  const std::vector<LookInstant> instants = look_instants(trajectory, request.t_s);
  const TargetLists path = targets_of(PathTerm(trajectory, plan.local_goal, request.limits), instants);
  const TargetLists seen = targets_of(TrackTerm(tracks, trajectory, request.t_s), instants);
  TargetLists all(instants.size());
  const TargetLists unseen = reasons.unseen ? targets_of(*reasons.unseen, instants) : TargetLists(instants.size());
  const bool sees_all_round = reasons.texture != nullptr && limits.view_deg >= kAllRound;
  if (!sees_all_round && !reasons.looks_around) add(path, all);
  if (!sees_all_round) add(seen, all);
  if (!sees_all_round) add(unseen, all);
  if (reasons.texture != nullptr) add(targets_of(*reasons.texture, instants), all);
  auto points = search_heading(start, trajectory.interval, all, limits);
  if (!points) return std::nullopt;
  PlanHeading heading;
  heading.request_id = plan.request_id;
  heading.request = request.header.name;
  heading.start = request.t_s;
  heading.interval = trajectory.interval;
  heading.control_points = std::move(*points);
  heading.rate_max = to_radians(limits.rate_max_deg_s);
  heading.acceleration_max = to_radians(limits.acceleration_max_deg_s2);
  heading.path_term = value_along(heading, path, limits);
  heading.track_term = value_along(heading, seen, limits);
  heading.unseen_term = value_along(heading, unseen, limits);
  return heading;
}

}  // namespace tern
