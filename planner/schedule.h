// The schedule of one request: what plan() tries, in which order. It is data. See docs/planner/choice.md.
#pragma once

#include <optional>
#include <vector>

#include "planner/assurance.h"
#include "planner/surroundings.h"

namespace tern {

/// The vehicle's task at one request.
///
/// | task    | the vehicle                                                   | its course                         |
/// |---------|---------------------------------------------------------------|------------------------------------|
/// | Stay    | is at rest at its goal, or at rest and told to hold or stop   | along the path, if there is one    |
/// | Brake   | moves, and is told to hold or stop                            | in place                           |
/// | Fly     | is on its way along a path to the goal                        | along the path                     |
/// | Blocked | is on its way to a goal without a path                        | in place                           |
enum class Task { Stay, Brake, Fly, Blocked };

/// The end that a trial seeks.
///
/// | aim  | sought                                                                  | by                       |
/// |------|-------------------------------------------------------------------------|--------------------------|
/// | Room | a stop that holds, as far as possible from every box (relaxed start)    | find_evasion()           |
/// | Goal | the local goal                                                          | try_durations()          |
/// | Step | a local goal nearer by kSmallerStep than that of the trial before       | try_durations()          |
/// | Stop | the stop that stays clear longest                                       | find_evasion()           |
enum class Aim { Room, Goal, Step, Stop };

/// How long a search may be (effort_of). Thorough is that of Full until the first leaf, and that of Reduced from there
/// on.
enum class Effort { Full, Reduced, Thorough, OfStops };

/// One row of the schedule.
struct Trial {
  Aim aim = Aim::Goal;
  Effort effort = Effort::Full;
  Phase phase = Phase::Durations;    ///< the budget that its attempts draw on
  Assurance assurance = {};          ///< of its surroundings.
  std::optional<int> duration = {};  ///< index of the only one that is tried; nullopt: all.
  /// A vehicle that may stay where it is flies at this assurance once it has been at rest for longer than this, s.
  double wait_s = 0.0;
  /// If the start is relaxed at this assurance, the trial is left out.
  bool needs_clear_start = false;
  /// If the committed trajectory is not clear at a larger α, it is certified at this assurance first.
  bool certifies_committed = false;
  /// From this trial on the reason is Infeasible until a search gives another.
  bool is_first_reduced = false;
};

/// Returns whether the task is Fly and at least one mover nearby is estimated.
bool is_among_estimates(Task task, const Surroundings& near);

/// Returns the trials of one request in their order:
///
/// | among estimates                                  | otherwise                                                   |
/// |--------------------------------------------------|-------------------------------------------------------------|
/// | Goal, unless the start is relaxed                | Room, if the start is relaxed                               |
/// | Goal at each of reduced_assurances(), save those | Goal, for Fly and Brake                                     |
/// | that equal the full one                          | Step, kSmallerSteps times, for Fly from rest                |
/// | Stop at the last of them                         | Stop                                                        |
///
/// *Among estimates* means is_among_estimates(). There a vehicle that has been at rest for kMaxWaitAtRest searches
/// thoroughly at the reduced assurances: each request with one duration, which its id chooses. With n durations, every
/// (n + 1)-th request tries all of them, as a vehicle in flight does.
/// @param near  at full assurance
std::vector<Trial> schedule(Task task, const Surroundings& near);

/// Returns the search's configuration with its limits lowered to this effort.
SearchConfig effort_of(Effort effort, SearchConfig search);

}  // namespace tern
