#include "planner/evasion.h"

#include <algorithm>
#include <limits>
#include <tuple>
#include <utility>
#include <vector>

#include "core/world/flyable.h"
#include "planner/duration.h"
#include "planner/plan_workspace.h"
#include "planner/preference.h"
#include "planner/problem/tuning.h"

namespace tern {
namespace {

constexpr std::size_t kFacesAndCorners = 14;

/// Faces, corners and edges of a cube, in this order, as unit vectors.
const std::vector<Vec3>& directions() {
  static const std::vector<Vec3> all = [] {
    std::vector<Vec3> made;
    for (const int axes : {1, 3, 2}) {
      for (int k = 0; k < 27; ++k) {
        const Eigen::Vector3i direction(k / 9 - 1, k / 3 % 3 - 1, k % 3 - 1);
        if (direction.squaredNorm() == axes) made.push_back(direction.cast<double>().normalized());
      }
    }
    return made;
  }();
  return all;
}

/// A stop to try.
struct Stop {
  Vec3 point = Vec3::Zero();
  Duration interval;      ///< Δt of the way there
  double way_s = 0.0;     ///< J Δt
  bool is_quick = false;  ///< the quick pace, which the search may not reach
  double clear_s = 0.0;   ///< forecast time until the way there, or the rest there, first touches an obstacle's box, s
};

/// Returns the distances of stops, m; for Room only the far ones.
std::vector<double> distances(const Surroundings& near, Aim aim) {
  const double r = near.config.sphere_radius_m;
  std::vector<double> all;
  for (const double share : kStopShares) all.push_back(share * r);
  if (aim == Aim::Room) return all;
  for (const double widths : kStopWidths) {
    const double distance = widths * near.hold.width;
    if (distance > 0.0 && distance < kMaxWidthShare * r) all.push_back(distance);
  }
  return all;
}

/// Sweeps all obstacles in the sphere for duration_s, at most kMaxForecast.
const SweptObstacles& sweep_forecast(const Surroundings& near, double duration_s, PlanWorkspace& memory) {
  std::vector<double>& times = memory.times;
  times.assign(1, 0.0);
  append_hold(times, kForecastStep, std::min(duration_s, kMaxForecast));
  const Box region = box_around(near.request.start.p, Vec3::Constant(near.config.sphere_radius_m));
  SweptObstacles& swept = memory.forecast;
  swept.assign(near.obstacles, near.request.body, near.request.t_s, times, region);
  return swept;
}

/// Returns when on_smooth_way() to the stop first enters an obstacle's box, sampled once per step of the forecast.
double forecast(const SweptObstacles& swept, const MotionSample& start, const Stop& stop) {
  for (int k = 0; k < swept.intervals(); ++k) {
    const double middle = 0.5 * (swept.time(k) + swept.time(k + 1));
    const double s = std::min(1.0, middle / stop.way_s);
    const Vec3 p = on_smooth_way(start, stop.point, stop.way_s, s);
    for (const SweptObstacles::Neighbour& neighbour : swept.neighbours(k)) {
      if (neighbour.box.contains(p)) return swept.time(k);
    }
  }
  return swept.time(swept.intervals());
}

/// Orders by the longer forecast, then the slow pace, then the shorter way.
bool is_tried_before(const Stop& a, const Stop& b) {
  return std::make_tuple(-a.clear_s, a.is_quick, a.way_s) < std::make_tuple(-b.clear_s, b.is_quick, b.way_s);
}

/// Returns the stop at a point. @return nullopt if it is outside the flight box, or its Δt is too long
std::optional<Stop> stop_at(const Surroundings& near, const Box& box, const Vec3& point, double pace) {
  if (!box.contains(point)) return std::nullopt;
  const double least = min_duration(near.request.start, point, near.pace_limits);
  const auto interval = interval_of(pace * least, near.config.intervals);
  if (!interval) return std::nullopt;
  return Stop{point, *interval, interval->seconds() * near.config.intervals, pace < kStopScale, 0.0};
}

/// Returns the best kMaxStops stops within the flight box, the best forecast first.
std::vector<Stop> ordered_stops(const Surroundings& near, Aim aim, PlanWorkspace& memory) {
  std::vector<Stop> stops;
  double longest = 0.0;
  const std::size_t ways = aim == Aim::Room ? kFacesAndCorners : directions().size();
  for (const double distance : distances(near, aim)) {
    for (std::size_t k = 0; k < ways; ++k) {
      for (const double pace : kStopPaces) {
        const auto stop = stop_at(near, near.room, near.request.start.p + directions()[k] * distance, pace);
        if (!stop || (stop->is_quick && near.hold.has_estimated)) continue;
        longest = std::max(longest, stop->way_s);
        stops.push_back(*stop);
      }
    }
  }
  const SweptObstacles& swept =
      sweep_forecast(near, std::max(longest + near.hold.cap_s, near.hold.predicted_s), memory);
  for (Stop& stop : stops) stop.clear_s = forecast(swept, near.request.start, stop);
  std::stable_sort(stops.begin(), stops.end(), is_tried_before);
  if (stops.size() > kMaxStops) stops.resize(kMaxStops);
  return stops;
}

/// Returns the distance from the end point to the nearest obstacle's box in the first interval after the end, m.
double room_at_end(const SweptObstacles& swept, int intervals, const TimedSpline& trajectory) {
  const Vec3 end = trajectory.control_points.col(trajectory.control_points.cols() - 1);
  double room = std::numeric_limits<double>::infinity();
  for (const SweptObstacles::Neighbour& neighbour : swept.neighbours(intervals)) {
    room = std::min(room, neighbour.box.exteriorDistance(end));
  }
  return room;
}

}  // namespace

std::optional<Candidate> find_evasion(const Surroundings& near, const Course& course, const Trial& trial,
                                      PlanTools& tools) {
  const SearchConfig search = effort_of(trial.effort, near.config.search);
  const bool seeks_room = trial.aim == Aim::Room;
  std::optional<Candidate> best;
  for (const Stop& stop : ordered_stops(near, trial.aim, tools.memory)) {
    if (!tools.budget.begin_attempt(trial.phase) || tools.budget.expired(Stage::Search)) return best;
    const Course there{{stop.point, 0.0, stop.way_s}, {stop.point, 0.0}, course.step_s, course.pace, nullptr};
    const double look_s = near.hold.cap_of_stop(stop.way_s);
    if (!is_followed(near, stop.interval, look_s)) continue;
    const Attempt attempt{near, there, horizon_problem(near, stop.interval), look_s, look_s};
    SeparationCache& swept = sweep_horizon(attempt, tools.memory.times, tools.memory.evasion);
    auto found = search_candidate(attempt, search, swept, tools);
    tools.log.statistics.count(swept);
    if (!found) continue;
    found->outcome = PlanOutcome::Evade;
    evaluate(near, course, *found);
    found->holds = lasts(found->hold_s, near.hold.required(stop.way_s));
    if (seeks_room && !found->holds) continue;
    if (seeks_room) found->room = room_at_end(swept.obstacles(), near.config.intervals, found->trajectory);
    if (best && !is_better_stop(*found, *best, trial.aim)) continue;
    best = std::move(found);
    if (!seeks_room && lasts(best->hold_s, look_s)) return best;
  }
  return best;
}

}  // namespace tern
