#include "planner/schedule.h"

#include <algorithm>

#include "planner/problem/tuning.h"

namespace tern {
namespace {

/// Returns the duration that is searched thoroughly; nullopt: all are searched, with Effort::Reduced. A wide box before
/// the local goal holds up the shorter searches: all of their nodes lie in front of it.
std::optional<int> thorough_duration(const Surroundings& near) {
  if (time_at_rest_s(near.request) <= kMaxWaitAtRest) return std::nullopt;
  const auto durations = std::ssize(near.config.duration_scales);
  const auto turn = static_cast<int>(near.request.id % (durations + 1));
  return turn == 0 ? std::nullopt : std::optional(turn - 1);
}

/// The full assurance first, then the reduced ones.
std::vector<Trial> schedule_among_estimates(const Surroundings& near) {
  std::vector<Trial> trials;
  if (!near.start.relaxed) trials.push_back(Trial{});
  const std::vector<Assurance> all = reduced_assurances(near.hold.side_step_s);
  const std::optional<int> thorough = thorough_duration(near);
  bool is_first = true;
  for (const Assurance& assurance : all) {
    const bool equals_full = assurance.level == 0 && assurance.sure_for.seconds() >= near.hold.predicted_s;
    if (equals_full) continue;
    Trial trial{Aim::Goal, thorough ? Effort::Thorough : Effort::Reduced, Phase::Evasion, assurance, thorough};
    trial.wait_s = kMaxWaitAtRest * (1.0 - confidence_of(assurance, near.set_confidence));
    trial.needs_clear_start = &assurance != &all.back();
    trial.certifies_committed = true;
    trial.is_first_reduced = is_first;
    trials.push_back(trial);
    is_first = false;
  }
  trials.push_back({Aim::Stop, Effort::OfStops, Phase::Evasion, all.back()});
  return trials;
}

}  // namespace

bool is_among_estimates(Task task, const Surroundings& near) { return task == Task::Fly && near.hold.has_estimated; }

std::vector<Trial> schedule(Task task, const Surroundings& near) {
  if (is_among_estimates(task, near)) return schedule_among_estimates(near);
  std::vector<Trial> trials;
  if (near.start.relaxed) trials.push_back({Aim::Room, Effort::OfStops, Phase::Room});
  if (task == Task::Fly || task == Task::Brake) trials.push_back(Trial{});
  if (task == Task::Fly && is_at_rest(near.request)) trials.insert(trials.end(), kSmallerSteps, Trial{Aim::Step});
  trials.push_back({Aim::Stop, Effort::OfStops, Phase::Evasion});
  return trials;
}

SearchConfig effort_of(Effort effort, SearchConfig search) {
  switch (effort) {
    case Effort::Full: break;
    case Effort::Reduced:
      search.max_expansions = std::min(search.max_expansions, kReducedExpansions);
      search.hold_expansions = std::min(search.hold_expansions, kReducedHoldExpansions);
      break;
    case Effort::Thorough: search.hold_expansions = std::min(search.hold_expansions, kReducedHoldExpansions); break;
    case Effort::OfStops: search.max_expansions = kStopExpansions; break;
  }
  return search;
}

}  // namespace tern
