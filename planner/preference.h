// The preference: the only place that compares two candidates. See docs/planner/choice.md.
#pragma once

#include "planner/attempt.h"
#include "planner/schedule.h"

namespace tern {

/// Returns whether the candidate covers more than kMinProgress of the distance to the local goal.
bool makes_progress(const Candidate& candidate);

/// Returns whether a new candidate beats the best one so far. The one that unseen movers may touch later is better;
/// passively safe ones are never touched (passive_safety.h), and all are equal with `planner.unseen: ignore`. Then the
/// one that holds is better. With equal holds the earlier arrival is better. At rest, of two with equal holds, the one
/// that makes progress is better, whatever the estimated arrivals are.
bool is_better(const Candidate& candidate, const Candidate& best, const Surroundings& near);

/// Returns whether a new candidate is worse than the committed trajectory:
///
/// | condition                                                       | only if                                       |
/// |-----------------------------------------------------------------|-----------------------------------------------|
/// | unseen movers may touch it earlier; if later, it is not worse   | planner.unseen: passive                       |
/// | it does not hold but the committed one does, or it arrives      | –                                             |
/// | no earlier with an equal hold                                   |                                               |
/// | it stays clear for a shorter time                               | neither holds; all movers nearby are declared |
/// | the committed trajectory makes progress, the candidate does not | equal holds                                   |
/// | it ends at the same point, but no earlier                       | equal holds, stationary vehicle               |
///
/// Among estimates the arrival decides even if neither holds, because their far future is hardly known. The last rule
/// keeps the departure from being delayed at every request: such a candidate is faster half-way, so its arrival is
/// estimated as earlier.
bool is_worse_than_committed(const Candidate& candidate, const Candidate& committed, const Surroundings& near);

/// Returns whether a new candidate is flown in place of the committed trajectory. It is not worse, or it is an evasion,
/// or it departs from rest.
///
/// A departure has an equal hold and ends nearer to the local goal than the start, by kMinApproach. It arrives at most
/// kMaxArrivalLoss later than staying does, or the vehicle has been at rest for more than kMaxWaitAtRest. Arrivals are
/// counted per axis: a plan that begins gently, or strays on a slow axis, may arrive no earlier than staying does.
bool replaces_committed(const Candidate& candidate, const Candidate& committed, const Surroundings& near);

/// Returns whether an optimized candidate replaces the leaf that it was made from. It holds if the leaf holds, and
/// arrives at most kMaxArrivalLoss later; unseen movers may touch it no earlier. For Δt < kShortInterval arrivals say
/// little; there it must also keep kMinProgressKept of the leaf's approach to the goal.
bool replaces_leaf(const Candidate& optimized, const Candidate& leaf, const Attempt& attempt);

/// Returns whether a stop beats another: for the aim Room if it is farther from every box, else if it stays clear
/// longer.
bool is_better_stop(const Candidate& stop, const Candidate& best, Aim aim);

}  // namespace tern
