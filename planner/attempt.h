// One attempt: a duration and a course, searched and certified.
#pragma once

#include <optional>
#include <vector>

#include "core/world/horizon.h"
#include "planner/course.h"
#include "planner/passive_safety.h"
#include "planner/plan_log.h"
#include "planner/surroundings.h"

namespace tern {

/// A certified trajectory that may become the plan, with the values by which candidates are compared (preference.h).
struct Candidate {
  PlanOutcome outcome = PlanOutcome::NoPlan;
  Assurance assurance;   ///< the assurance that it was certified at
  bool relaxed = false;  ///< StartClearance::relaxed at that assurance
  TimedSpline trajectory;
  double clear_s = 0.0;     ///< from t_s until the end point stops being clear, or to the last time that was tested, s
  double hold_s = 0.0;      ///< the part of clear_s after the end: the terminal clear time, s
  bool holds = false;       ///< hold_s reaches the required hold
  double arrival_s = 0.0;   ///< estimated arrival at the goal after t_s, with exposure (arrival_with_exposure), s
  double progress = 0.0;    ///< share of the distance to the local goal that it covers (progress_share)
  bool approaches = false;  ///< it ends nearer to the local goal than the start, by more than kMinApproach
  bool meets_declared = false;    ///< committed trajectory: a declared or static obstacle ends clear_s
  double contact_s = kNoContact;  ///< when an unseen mover may touch the vehicle first (contact_time), s after t_s
  double room = 0.0;              ///< of an evasion: distance from its end to the nearest obstacle's box, m
  PlanCost cost;
  std::vector<CertificatePlane> certificate;
};

/// The problem of one duration.
struct Attempt {
  const Surroundings& near;
  const Course& course;
  HorizonProblem problem;
  double hold_s = 0.0;           ///< the end point is tested for this long after the end, s
  double hold_required_s = 0.0;  ///< terminal clear time from which on the candidate holds, s
};

/// Sets the values of a candidate that depend on the course: arrival, progress and terms of its cost.
void evaluate(const Surroundings& near, const Course& course, Candidate& candidate);

/// Appends times up to hold_s after the last of `times`, `step` apart, s.
void append_hold(std::vector<double>& times, double step, double hold_s);

/// Returns Δt of J intervals that together last duration_s: rounded up to a microsecond, and at least kMinInterval.
/// @return nullopt if Δt would exceed kMaxIntervalDuration
std::optional<Duration> interval_of(double duration_s, int intervals);

/// Returns the attempt of a duration, with the hold that is usual for it. @return nullopt if Δt would be too long, or
/// obstacles are not followed for as long
std::optional<Attempt> attempt_of(const Surroundings& near, const Course& course, double duration_s);

/// Returns the position at a share of a smooth way (a cubic in time) from `start` to rest at `stop` within way_s.
Vec3 on_smooth_way(const MotionSample& start, const Vec3& stop, double way_s, double share);

/// Assigns to `swept` the obstacles of the horizon t_s … t_s + J Δt and of the hold after it.
/// @param times  scratch memory
/// @return its empty cache
SeparationCache& sweep_horizon(const Attempt& attempt, std::vector<double>& times, SweptHorizon& swept);

/// Runs the search and certifies its leaf. @return nullopt if there is no leaf or the checker rejects it
std::optional<Candidate> search_candidate(const Attempt& attempt, const SearchConfig& config, SeparationCache& swept,
                                          PlanTools& tools);

/// Runs the checker on these control points. @return nullopt if it rejects them
std::optional<Candidate> certify(const Attempt& attempt, const Points& control_points, PlanOutcome outcome,
                                 SeparationCache& swept, PlanLog& log);

}  // namespace tern
