// The contract between executor and planner: one request, one answer (DESIGN: the plan, time, replay).
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "core/base/types.h"
#include "core/geometry/plane.h"
#include "core/world/header.h"
#include "core/world/message_limits.h"
#include "core/world/vehicle.h"

namespace tern {

/// HORIZON_REQUEST: plan from the state on the committed trajectory at t_s.
struct HorizonRequest {
  Header header;
  std::int64_t id = 0;    ///< > 0, ascending per executor
  UTime t_s;              ///< when the plan shall begin, vehicle's clock
  UTime deadline;         ///< an answer after this is late; ≤ t_s − 5 ms
  TimedSpline committed;  ///< in force at t_s; ends at rest
  MotionSample start;     ///< the committed trajectory's state at t_s
  Limits limits;
  Body body;
  Box flight_box;  ///< the whole body stays inside, W
  /// The tube: what the vehicle's true position may be off the commanded one per axis while it flies the plan, m, ≥ 0.
  /// The planner keeps the body clear by it.
  Vec3 tube = Vec3::Zero();
};

enum class PlanOutcome : std::uint8_t { Optimized = 0, SearchOnly = 1, KeepCommitted = 2, Evade = 3, NoPlan = 4 };
inline constexpr int kPlanOutcomes = 5;

enum class PlanReason : std::uint8_t {
  None = 0,              ///< nothing to excuse
  Infeasible = 1,        ///< no certified trajectory was found
  OutOfTime = 2,         ///< the budget ended first
  StartInCollision = 3,  ///< the start lies inside an obstacle's hull
  GoalBlocked = 4,       ///< no path around static obstacles
  StaleWorld = 5,        ///< predictions, map or goal missing or too old
  SolverFailure = 6,     ///< the optimizer gave no usable iterate
  WorsePlan = 7,         ///< the new plan is worse than the committed trajectory
  AtGoal = 8,            ///< at rest at the goal, or asked to hold: nothing to do
};
inline constexpr int kPlanReasons = 9;

/// PLAN_TIMING's times are of these steps, and a budget's questions are counted by them.
enum class Stage : std::uint8_t {
  Fallback = 0,    ///< surroundings; what is committed, checked again; any step of no other stage
  LocalGoal = 1,   ///< the way to the goal, the local goal; as a question: whether another duration or step begins
  BroadPhase = 2,  ///< what may meet the vehicle in each interval; hulls are made when they are first asked for
  Search = 3,
  Optimization = 4,
  Check = 5,  ///< the checker, with the certificate's planes
};
inline constexpr int kStages = 6;

/// What an attempt of a plan is for. Phases have a budget each: evasion is needed just when the durations have spent
/// theirs in vain.
enum class Phase : std::uint8_t {
  Durations = 0,  ///< to the local goal
  Evasion = 1,    ///< to the local goal, less sure than promised; to the stop that stays clear longest
  Room = 2,       ///< out of a hull, to where there is most room
};
inline constexpr int kPhases = 3;
/// The most attempts of a phase.
inline constexpr int kMaxAttempts = 100;

/// Where a budget cut a loop: what a replay needs instead of a clock.
struct BudgetCut {
  Phase phase = Phase::Durations;
  std::int32_t attempt = 0;  ///< which one of its phase, 0 … kMaxAttempts − 1
  Stage stage = Stage::Fallback;
  std::int64_t count = 0;  ///< how often the loop had asked when the budget was found spent
};

/// One plane of a certificate: separates obstacle `track` from part `part` of `parts` of interval `interval`.
struct CertificatePlane {
  std::int64_t track = 0;  ///< track id; −1 − k: the k-th box of the map's occupied voxels
  std::int16_t interval = 0;
  std::int8_t part = 0;   ///< 0 … parts − 1
  std::int8_t parts = 1;  ///< 1, 2 or 4
  Plane plane;            ///< W; the vehicle's points at n·q + d ≤ −max(radius, kPlaneMargin)
};

/// What a plan is worth: each term as it entered the choice.
struct PlanCost {
  double distance_to_goal = 0.0;  ///< of the end to the local goal, m
  double jerk = 0.0;              ///< Eq. 4: Σ_j ‖jerk_j‖², m²/s⁶
  double attraction = 0.0;        ///< λ_att·C_att as used
  double repulsion = 0.0;         ///< λ_rep·C_rep as used
  double total = 0.0;
};

/// The names of what the distances to the goal were made from, besides the goal's position. They are prepared beside
/// the planning, so they may rest on an older map or older static tracks than the plan.
struct GoalFieldInputs {
  std::uint64_t map_version = 0;       ///< whose boxes are in it; 0: there were no distances
  std::int64_t statics_epoch_us = 0;   ///< the predictor whose static tracks are in it; 0: none was heard
  std::int64_t statics_first_set = 0;  ///< the first of its sets that were heard: each adds its static tracks
  std::uint64_t statics = 0;           ///< digest of the static tracks' boxes, by track id
  MessageName vehicle;  ///< the request whose body, flight box and start it was made for; none: the configured vehicle
};

/// The names of what a plan was made from.
struct PlanInputs {
  MessageName request, goal, predictions;
  std::int64_t prediction_set = 0;
  std::int32_t left_out = 0;      ///< tracks that the predictions say they left out: the plan knows nothing of them
  std::uint64_t map_version = 0;  ///< digest of the map; 0: none
  std::uint64_t configuration_hash = 0;
  std::uint64_t planner_build = 0;  ///< digest of what plan() was compiled from
  GoalFieldInputs goal_field;
};

/// PLAN: answers exactly one request. Nothing in it depends on the clock.
struct Plan {
  Header header;
  std::int64_t request_id = 0;
  PlanOutcome outcome = PlanOutcome::NoPlan;
  PlanReason reason = PlanReason::None;
  TimedSpline trajectory;  ///< starts at t_s unless KeepCommitted (then the committed one); meaningless for NoPlan
  Duration hold;           ///< how long after its end the end point stays clear of every predicted mover, ≤ the cap
  /// What the trajectory is certified at: the boxes of estimated tracks with their α at `level`, times `alpha_scale`.
  /// What is declared or static counts with all of its α. `confidence` is that of each such track to stay within its
  /// box; 1 where nothing is estimated. It is 0 below the last level (a scaled α has no number) and for NoPlan.
  double confidence = 0.0;
  int level = 0;             ///< into kConfidenceLevels; 0: what the predictions promise
  double alpha_scale = 1.0;  ///< [0, 1]; below 1 only at the last level
  /// How long after t_s α grows, [0, kMaxSpan]: what is later counts with the α of then. `confidence` speaks of this
  /// time alone (0 where there is none); kMaxSpan: of all.
  Duration sure_for = kMaxSpan;
  bool relaxed = false;            ///< the start lay inside a hull and α was scaled to the largest clear value
  Vec3 local_goal = Vec3::Zero();  ///< W
  double sphere_radius = 0.0;      ///< r, m
  PlanCost cost;
  PlanInputs inputs;
  std::vector<CertificatePlane> certificate;
  std::vector<BudgetCut> cuts;
  /// Of an answer that the watchdog gave: how many had come to stand by then. It sent the last of them, or, of none,
  /// one of its own. nullopt: the planner was done.
  std::optional<std::int64_t> standing;
};

/// PLAN_TIMING: what one answer cost.
struct PlanTiming {
  Header header;
  std::int64_t request_id = 0;
  double total_ms = 0.0;          ///< wall time from the request's arrival to the answer
  double first_answer_ms = 0.0;   ///< until the first certified trajectory
  double cpu_ms = 0.0;            ///< thread CPU time of the worker
  double stage_ms[kStages] = {};  ///< wall time by Stage
  std::int64_t expansions = 0;    ///< search nodes expanded
  std::int64_t hulls = 0;         ///< hulls made by CGAL
  /// How pairs of obstacle and interval (or a part of it) were settled, by the first of these that could.
  std::int64_t pairs_by_index = 0;    ///< out of the vehicle's reach
  std::int64_t pairs_by_box = 0;      ///< bounding boxes are disjoint
  std::int64_t pairs_by_instant = 0;  ///< they touch at one of five instants
  std::int64_t pairs_by_cache = 0;    ///< separated along the direction that separated that obstacle last
  std::int64_t pairs_by_plane = 0;    ///< fast separation
  std::int64_t pairs_by_lp = 0;       ///< handed to GLPK
  std::int64_t solver_calls = 0;      ///< of the optimizer: how often a problem was solved
  std::int64_t solver_iterations = 0;
  std::int64_t peak_rss_kb = 0;
  bool from_watchdog = false;  ///< the receiving thread answered because the worker had not
};

}  // namespace tern
