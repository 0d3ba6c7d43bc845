// One attempt: a duration and where it heads, searched and certified.
#pragma once

#include <optional>
#include <vector>

#include "core/world/horizon.h"
#include "planner/course.h"
#include "planner/plan_log.h"
#include "planner/surroundings.h"

namespace tern {

/// A certified trajectory and what it is worth.
struct Candidate {
  PlanOutcome outcome = PlanOutcome::NoPlan;
  Assurance assurance;   ///< what it is certified at
  bool relaxed = false;  ///< StartClearance::relaxed, there
  TimedSpline trajectory;
  double clear_s = 0.0;  ///< from t_s until the end point is no longer clear, or as far as was looked
  double hold_s = 0.0;   ///< of that, after the end
  bool holds = false;    ///< hold_s reaches the requirement
  double arrival_s =
      0.0;  ///< estimate of the time from t_s to the goal, and what regions cost on it (arrival_with_exposure)
  PlanCost cost;
  std::vector<CertificatePlane> certificate;

  /// Holding comes first, then the arrival.
  [[nodiscard]] bool is_preferred_to(const Candidate& other) const {
    if (holds != other.holds) return holds;
    return arrival_s < other.arrival_s;
  }
};

struct Attempt {
  const Surroundings& near;
  const Course& course;
  HorizonProblem problem;
  double hold_s = 0.0;           ///< how far the hold of its end is followed
  double hold_required_s = 0.0;  ///< what its end must hold to count as holding
};

/// What the candidate is worth on the way to the course's local goal: its arrival, and of its cost what depends on it.
void evaluate(const Surroundings& near, const Course& course, Candidate& candidate);

/// Adds the times of a hold of hold_s after the last of `times`, s, a step apart.
void append_hold(std::vector<double>& times, double step, double hold_s);

/// Δt of J intervals that last duration_s together, rounded up to a microsecond and at least 20 ms. Below that,
/// rounding of accelerations q/Δt² would exceed the tolerances.
/// @return nullopt if it would exceed kMaxIntervalDuration
std::optional<Duration> interval_of(double duration_s, int intervals);

/// The obstacles of the horizon t_s … t_s + J Δt and of the hold after it.
/// @param times  memory
void sweep_horizon(const Attempt& attempt, std::vector<double>& times, SweptObstacles& swept);

/// Searches. @return nullopt if there is no leaf that the checker passes
std::optional<Candidate> search_candidate(const Attempt& attempt, const SearchConfig& config, SweptObstacles& swept,
                                          PlanTools& tools);

/// Checks. @return nullopt if the checker refuses the control points
std::optional<Candidate> certify(const Attempt& attempt, const Points& control_points, PlanOutcome outcome,
                                 SweptObstacles& swept, PlanLog& log);

}  // namespace tern
