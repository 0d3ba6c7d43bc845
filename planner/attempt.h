// One attempt: a duration and a way to go, searched and certified.
#pragma once

#include <optional>
#include <vector>

#include "core/world/budget.h"
#include "core/world/horizon.h"
#include "planner/hold.h"
#include "planner/look_ahead.h"
#include "planner/plan_workspace.h"
#include "planner/planner.h"
#include "planner/safety/checker.h"
#include "planner/search/semantic_a_star.h"

namespace tern {

/// A certified trajectory and what it is worth.
struct Candidate {
  PlanOutcome outcome = PlanOutcome::NoPlan;
  TimedSpline trajectory;
  double clear_s = 0.0;    ///< from t_s until the end point is no longer clear, or as far as was looked
  double hold_s = 0.0;     ///< of that, after the end
  bool holds = false;      ///< hold_s reaches the requirement
  double arrival_s = 0.0;  ///< estimate of the time from t_s to the goal, and what regions cost on it (worth_of)
  PlanCost cost;
  std::vector<CertificatePlane> certificate;

  /// Holding comes first, then the arrival.
  [[nodiscard]] bool better_than(const Candidate& other) const {
    if (holds != other.holds) return holds;
    return arrival_s < other.arrival_s;
  }
};

/// What all attempts of one request share.
struct AttemptContext {
  const HorizonRequest& request;
  const PlannerConfig& config;
  const std::vector<PlanningObstacle>& obstacles;
  const SemanticFields* fields = nullptr;  ///< null: no semantics
  Limits plan_limits;                      ///< v_max reduced to velocity_share
  WayToGo way;                             ///< to the goal, for ranking
  Vec3 local_goal;                         ///< s_g^temp
  Budget& budget;
  PlanObserver* observer;
  PlanStatistics& statistics;
  PlanWorkspace& workspace;
  Limits pace;               ///< the same, paced() over the way to the local goal: what arrivals are estimated by
  LookAhead look;            ///< no plan looks past its followed_until
  double goal_radius = 0.0;  ///< how far from the start the local goal may lie: near for who is slow (LocalAim), m
  HoldDemand hold = {};
  double step_s = 0.0;  ///< planned_duration() to the local goal
};

/// Of holds, s: coarser than Δt where Δt is short, so that a hold costs few hulls.
inline constexpr double kHoldStep = 0.1;

/// Adds the times of a hold of hold_s after the last of `times`, s, a step apart.
void append_hold(std::vector<double>& times, double step, double hold_s);

/// Δt of J intervals that last duration_s together, rounded up to a microsecond and not below 20 ms, where rounding of
/// accelerations q/Δt² would eat the tolerances. Nothing: it would exceed kLongestInterval.
std::optional<Duration> interval_of(double duration_s, int intervals);

/// Whether obstacles are known to the end of a hold of hold_s after J intervals.
bool is_followed(const AttemptContext& context, Duration interval, double hold_s);

/// The obstacles of the horizon t_s … t_s + J Δt and of a hold of hold_s after it.
void sweep_horizon(const AttemptContext& context, Duration interval, double hold_s, SweptObstacles& swept);

/// Searches at this Δt. Nothing: no leaf that the checker passes.
/// @param hold_required_s  what the leaf's end should hold
std::optional<Candidate> search_candidate(const AttemptContext& context, SweptObstacles& obstacles, Duration interval,
                                          double hold_required_s, const SearchConfig& config);

/// A candidate if the checker passes the control points.
/// @param hold_required_s  what its end must hold to count as holding
std::optional<Candidate> certify(const AttemptContext& context, SweptObstacles& obstacles, Duration interval,
                                 const Points& control_points, PlanOutcome outcome, double hold_required_s);

/// When the goal would be reached if the trajectory were flown for a while and the rest time-optimally, per axis: the
/// mean over two such whiles. Comparing ends instead would favour short plans, because every plan brakes at its end and
/// hardly one is flown so far.
/// @param from    the time on the trajectory that counts as 0
/// @param step_s  the least time to the local goal: the whiles are no shorter than a share of it, s
double arrival_estimate(const WayToGo& way, const TimedSpline& trajectory, UTime from, const Limits& limits,
                        double step_s);

/// The arrival estimate from t_s on, plus the exposure cost over the same whiles and ahead (SemanticGuide), as if those
/// metres were flown at v_max, s: the same exchange of metres for metres as in the search. The mean distance stays out:
/// it has no measure of its own that seconds could be given for (flights of paper_repel took 0.3 s longer with it).
double worth_of(const AttemptContext& context, const TimedSpline& trajectory);

}  // namespace tern
