#include "planner/evasion.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "planner/duration.h"

namespace tern {
namespace {

constexpr int kMaxExpansions = 150;
constexpr double kDurationScale = 1.5;

std::array<Vec3, 14> directions() {
  std::array<Vec3, 14> d;
  std::size_t n = 0;
  for (int axis = 0; axis < 3; ++axis) {
    d[n++] = Vec3::Unit(axis);
    d[n++] = -Vec3::Unit(axis);
  }
  const double c = 1.0 / std::sqrt(3.0);
  for (int k = 0; k < 8; ++k) {
    d[n++] = Vec3((k & 1) != 0 ? c : -c, (k & 2) != 0 ? c : -c, (k & 4) != 0 ? c : -c);
  }
  return d;
}

/// From the end point to the nearest obstacle's box in the first interval after the end, m.
double room_at_end(const SweptObstacles& swept, int intervals, const TimedSpline& trajectory) {
  const Vec3 end = trajectory.control_points.col(trajectory.control_points.cols() - 1);
  double room = std::numeric_limits<double>::infinity();
  for (const SweptObstacles::Candidate& candidate : swept.candidates(intervals)) {
    room = std::min(room, candidate.box.exteriorDistance(end));
  }
  return room;
}

}  // namespace

std::optional<Candidate> find_evasion(const AttemptContext& base, EvasionAim aim) {
  SearchConfig search = base.config.search;
  search.max_expansions = kMaxExpansions;
  std::optional<Candidate> best;
  double best_worth = 0.0;
  int attempt = kFirstEvasionAttempt;
  for (const double share : {0.35, 0.8}) {
    for (const Vec3& direction : directions()) {
      base.budget.begin_attempt(attempt++);
      if (base.budget.expired(Stage::Search)) return best;
      AttemptContext context = base;
      context.fields = nullptr;
      context.local_goal = base.request.start.p + direction * (share * base.config.sphere_radius_m);
      context.way = {context.local_goal, 0.0};
      const double duration = kDurationScale * least_duration(base.request.start, context.local_goal, base.plan_limits);
      const Duration interval{static_cast<std::int64_t>(std::ceil(duration / base.config.intervals * 1e6))};
      SweptObstacles swept = sweep_horizon(context, interval);
      auto found = search_candidate(context, swept, interval, base.config.hold_cap_s, search);
      base.statistics.hulls += swept.hulls_made();
      if (!found) continue;
      found->outcome = PlanOutcome::Evade;
      found->arrival_s = arrival_estimate(base.way, found->trajectory, base.request.t_s, base.plan_limits);
      found->holds = found->hold_s >= base.config.hold_required_s;
      const bool by_time = aim == EvasionAim::LongestClear;
      if (!by_time && !found->holds) continue;
      const double worth = by_time ? found->clear_s : room_at_end(swept, base.config.intervals, found->trajectory);
      if (best && worth <= best_worth) continue;
      best = std::move(found);
      best_worth = worth;
      if (by_time && best->hold_s >= base.config.hold_cap_s) return best;
    }
  }
  return best;
}

}  // namespace tern
