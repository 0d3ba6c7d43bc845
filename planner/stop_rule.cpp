#include "planner/stop_rule.h"

#include <optional>

#include "planner/preference.h"
#include "planner/problem/tuning.h"

namespace tern {
namespace {

using Standing = std::optional<Candidate>;

bool holds(const Standing& candidate) { return candidate && candidate->holds; }

bool settles(const Standing& candidate) { return holds(candidate) && candidate->progress >= kMinSettledProgress; }

bool has_waited(const Trial& next, const Surroundings& near) { return time_at_rest_s(near.request) > next.wait_s; }

}  // namespace

bool is_good_enough(const Incumbent& incumbent, const Trial& next, Task task, const Surroundings& near) {
  const Standing& best = incumbent.best();
  const Standing& committed = incumbent.committed();
  const bool is_full_assurance = is_full(next.assurance);
  const bool has_room = best && best->outcome == PlanOutcome::Evade;
  switch (next.aim) {
    case Aim::Room: return false;
    case Aim::Goal:
      if (is_full_assurance) return has_room;
      if (settles(best) || settles(committed)) return true;
      return next.assurance.scale < 1.0 && (best || committed) && !has_waited(next, near);
    case Aim::Step: return has_room || (best && makes_progress(*best));
    case Aim::Stop:
      if (!is_full_assurance) return best || committed;
      if (holds(best)) return true;
      return holds(committed) && !(task == Task::Stay && committed->meets_declared);
  }
  return false;
}

bool waits(const Incumbent& incumbent, const Trial& next, const Surroundings& near) {
  if (is_full(next.assurance) || next.assurance.scale < 1.0) return false;
  return is_stationary(near.request) && holds(incumbent.committed()) && !has_waited(next, near);
}

bool is_long_enough(const Incumbent& incumbent, const Course& course, const Surroundings& near) {
  const Standing& best = incumbent.best();
  if (!holds(best)) return false;
  if (best->cost.distance_to_goal > kAtLocalGoal * step_scale(course.local.radius)) return false;
  return !is_at_rest(near.request) || makes_progress(*best);
}

}  // namespace tern
