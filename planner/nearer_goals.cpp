#include "planner/nearer_goals.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "planner/plan_workspace.h"
#include "planner/problem/tuning.h"
#include "planner/refinement.h"

namespace tern {
namespace {

/// Returns whether unseen movers stay away from a smooth way to the local goal until it is reached.
bool seems_clear(const Surroundings& near, const LocalGoal& local, double way_s) {
  if (!near.unseen->field) return false;
  const UnseenField& field = *near.unseen->field;
  const MotionSample& start = near.request.start;
  const double latency_s = (near.request.t_s - near.unseen->at).seconds();
  const double radius = upright_radius(near.request.body);
  for (int k = 0; k <= kNearerSamples; ++k) {
    const double s = static_cast<double>(k) / kNearerSamples;
    const Vec3 p = on_smooth_way(start, local.goal, way_s, s);
    if (field.distance(p.head<2>()) - field.max_speed() * (s * way_s + latency_s) <= radius) return false;
  }
  return true;
}

/// Searches the first duration by which the local goal is reached. @return the optimized candidate
std::optional<Candidate> shortest_to(const Surroundings& near, const Course& there, const Trial& trial,
                                     PlanTools& tools) {
  const PlannerConfig& config = near.config;
  const SearchConfig search =
      scaled(effort_of(Effort::Reduced, config.search), there.local.radius, there.local.planned_s);
  const std::size_t scales = std::min<std::size_t>(config.duration_scales.size(), kNearerDurations);
  for (std::size_t k = 0; k < scales; ++k) {
    if (!tools.budget.begin_attempt(trial.phase == Phase::Durations ? Phase::Evasion : trial.phase) ||
        tools.budget.expired(Stage::Search)) {
      return std::nullopt;
    }
    const auto attempt = attempt_of(near, there, config.duration_scales[k] * there.local.planned_s);
    if (!attempt) return std::nullopt;
    tools.log.enter(Stage::BroadPhase);
    SeparationCache& swept = sweep_horizon(*attempt, tools.memory.times, tools.memory.horizon);
    auto leaf = search_candidate(*attempt, search, swept, tools);
    if (leaf) leaf = refined(*attempt, std::move(*leaf), swept, tools);
    tools.log.statistics.count(swept);
    if (leaf) return leaf;
  }
  return std::nullopt;
}

bool is_passively_safe(const std::optional<Candidate>& candidate) {
  return candidate && candidate->contact_s == kNoContact;
}

}  // namespace

void try_nearer_goals(const Surroundings& near, const Course& course, const std::function<Course(double)>& along,
                      const Trial& trial, Incumbent& incumbent, PlanTools& tools) {
  if (near.unseen == nullptr || is_passively_safe(incumbent.best())) return;
  int tries = 0;
  double radius = std::min(course.local.radius, (course.local.goal - near.request.start.p).norm());
  while ((radius *= kNearerStep) >= kNearestGoal && tries < kNearerTries) {
    const Course there = along(radius);
    const double way_s = near.config.duration_scales.front() * there.local.planned_s;
    if (!seems_clear(near, there.local, way_s)) continue;
    ++tries;
    auto found = shortest_to(near, there, trial, tools);
    if (!found) continue;
    const double progress = found->progress;
    evaluate(near, course, *found);
    found->progress = progress;
    incumbent.offer(std::move(*found));
    if (is_passively_safe(incumbent.best()) && incumbent.best()->progress >= kMinSettledProgress) return;
  }
}

}  // namespace tern
