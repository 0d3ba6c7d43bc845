#include "planner/evasion.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "core/geometry/box.h"
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

/// A stop to try.
struct Aim {
  Vec3 point = Vec3::Zero();
  Duration interval;     ///< Δt of the way there
  double clear_s = 0.0;  ///< forecast: when the way there, or resting there, first meets an obstacle's box
};

/// Where all aims are forecast: the sphere, long enough to reach the farthest of them and to hold there.
const SweptObstacles& sweep_forecast(const AttemptContext& context, double duration_s) {
  constexpr double kStep = 0.1;  // s
  std::vector<double>& times = context.workspace.times;
  times.assign(1, 0.0);
  while (times.back() < duration_s) times.push_back(times.back() + kStep);
  const Box region = box_around(context.request.start.p, Vec3::Constant(context.config.sphere_radius_m));
  SweptObstacles& swept = context.workspace.forecast;
  swept.assign(context.obstacles, context.request.body, context.request.t_s, times, region);
  return swept;
}

/// A smooth way from rest to rest at s of its duration, 0 … 1.
double smooth(double s) { return s * s * (3.0 - 2.0 * s); }

double forecast(const SweptObstacles& swept, const Vec3& from, const Vec3& to, double way_s) {
  for (int k = 0; k < swept.intervals(); ++k) {
    const double middle = 0.5 * (swept.time(k) + swept.time(k + 1));
    const Vec3 p = from + smooth(std::min(1.0, middle / way_s)) * (to - from);
    for (const SweptObstacles::Candidate& candidate : swept.candidates(k)) {
      if (candidate.box.contains(p)) return swept.time(k);
    }
  }
  return swept.time(swept.intervals());
}

/// All aims, those first whose forecast is clear longest; of equals the nearer ones, then by direction.
std::vector<Aim> ordered_aims(const AttemptContext& context) {
  std::vector<Aim> aims;
  double longest = 0.0;
  for (const double share : {0.35, 0.8}) {
    for (const Vec3& direction : directions()) {
      Aim aim;
      aim.point = context.request.start.p + direction * (share * context.config.sphere_radius_m);
      const double duration = kDurationScale * least_duration(context.request.start, aim.point, context.plan_limits);
      aim.interval = Duration{static_cast<std::int64_t>(std::ceil(duration / context.config.intervals * 1e6))};
      longest = std::max(longest, duration);
      aims.push_back(aim);
    }
  }
  const SweptObstacles& swept = sweep_forecast(context, longest + context.config.hold_cap_s);
  for (Aim& aim : aims) {
    aim.clear_s =
        forecast(swept, context.request.start.p, aim.point, aim.interval.seconds() * context.config.intervals);
  }
  std::stable_sort(aims.begin(), aims.end(), [](const Aim& a, const Aim& b) { return a.clear_s > b.clear_s; });
  return aims;
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
  // One plan may seek both aims; a budget's cuts are by attempt, so no attempt occurs twice.
  constexpr int kAttempts = 100;
  int attempt = kFirstEvasionAttempt + (aim == EvasionAim::GreatestClearance ? kAttempts : 0);
  for (const Aim& aim_at : ordered_aims(base)) {
    base.budget.begin_attempt(attempt++);
    if (base.budget.expired(Stage::Search)) return best;
    AttemptContext context = base;
    context.fields = nullptr;
    context.local_goal = aim_at.point;
    context.way = {context.local_goal, 0.0};
    if (!is_followed(context, aim_at.interval)) continue;
    SweptObstacles& swept = context.workspace.evasion;
    sweep_horizon(context, aim_at.interval, swept);
    auto found = search_candidate(context, swept, aim_at.interval, base.config.hold_cap_s, search);
    base.statistics.count(swept);
    if (!found) continue;
    found->outcome = PlanOutcome::Evade;
    found->arrival_s = worth_of(base, found->trajectory);
    found->holds = lasts(found->hold_s, base.config.required_hold(found->clear_s - found->hold_s));
    const bool by_time = aim == EvasionAim::LongestClear;
    if (!by_time && !found->holds) continue;
    const double worth = by_time ? found->clear_s : room_at_end(swept, base.config.intervals, found->trajectory);
    if (best && worth <= best_worth) continue;
    best = std::move(found);
    best_worth = worth;
    if (by_time && lasts(best->hold_s, base.config.hold_cap_s)) return best;
  }
  return best;
}

}  // namespace tern
