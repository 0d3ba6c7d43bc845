// The contract between executor and planner: the messages HORIZON_REQUEST, PLAN and PLAN_TIMING. Each request gets one
// answer.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "core/base/types.h"
#include "core/geometry/plane.h"
#include "core/wire/header.h"
#include "core/wire/message_limits.h"
#include "core/world/vehicle.h"

namespace tern {

/// HORIZON_REQUEST: asks for a plan that starts on the committed trajectory at t_s.
struct HorizonRequest {
  Header header;
  std::int64_t id = 0;    ///< > 0, ascending per executor
  UTime t_s;              ///< start of the plan, vehicle's clock
  UTime deadline;         ///< an answer after this is late; ≤ t_s − kDeadlineLead
  TimedSpline committed;  ///< the trajectory that the vehicle flies at t_s; it ends at rest
  MotionSample start;     ///< state of the committed trajectory at t_s
  Limits limits;
  Body body;
  Box flight_box;  ///< the whole body stays inside, W
  /// The tube: per axis, how far the vehicle may be from its setpoints, m, ≥ 0. The planner adds it to the body.
  Vec3 tube = Vec3::Zero();
};

/// The kind of an answer.
///
/// * Optimized: a new trajectory, optimized.
/// * SearchOnly: a new trajectory as the search found it.
/// * KeepCommitted: the committed trajectory stays.
/// * Evade: a new trajectory to a stop that stays clear.
/// * NoPlan: there is no trajectory; the vehicle flies the committed one to its end.
enum class PlanOutcome : std::uint8_t { Optimized = 0, SearchOnly = 1, KeepCommitted = 2, Evade = 3, NoPlan = 4 };
inline constexpr int kPlanOutcomes = 5;

/// The reason for an outcome.
enum class PlanReason : std::uint8_t {
  None = 0,              ///< no reason is needed
  Infeasible = 1,        ///< no certified trajectory was found
  OutOfTime = 2,         ///< the budget ended before one was found
  StartInCollision = 3,  ///< the start lies inside an obstacle's hull
  GoalBlocked = 4,       ///< static obstacles block every path to the goal
  StaleWorld = 5,        ///< predictions, map or goal are missing or too old
  SolverFailure = 6,     ///< the optimizer returned no usable iterate
  WorsePlan = 7,         ///< the new trajectory is worse than the committed one
  AtGoal = 8,            ///< the vehicle rests at the goal, or was told to hold
};
inline constexpr int kPlanReasons = 9;

/// The steps of planning. PLAN_TIMING has a time for each, and a Budget counts its calls by them.
enum class Stage : std::uint8_t {
  Fallback = 0,  ///< obstacles and start; the check of the committed trajectory; all steps without a stage of their own
  LocalGoal = 1,   ///< path to the goal and local goal. A budget's call asks here whether another duration may begin.
  BroadPhase = 2,  ///< obstacles that the vehicle can meet in each interval
  Search = 3,
  Optimization = 4,
  Check = 5,  ///< the checker and the planes of the certificate
};
inline constexpr int kStages = 6;

/// The purpose of an attempt. Each phase has kMaxAttempts of its own: evasion is needed exactly when the durations have
/// used theirs without success.
enum class Phase : std::uint8_t {
  Durations = 0,  ///< a plan to the local goal at the confidence of the predictions
  Evasion = 1,    ///< a plan at a lower confidence, to a nearer goal for unseen movers, or to the stop that stays clear
                  ///< longest
  Room = 2,       ///< a plan out of a hull, to the place with most room
};
inline constexpr int kPhases = 3;
/// The largest number of attempts of a phase.
inline constexpr int kMaxAttempts = 200;

/// The place where a budget ended a loop. A replay uses it instead of a clock.
struct BudgetCut {
  Phase phase = Phase::Durations;
  std::int32_t attempt = 0;  ///< index in its phase, 0 … kMaxAttempts − 1
  Stage stage = Stage::Fallback;
  std::int64_t count = 0;  ///< earlier calls of Budget::expired() in this attempt and stage
};

/// One plane of a certificate. It separates a track's sweep from part `part` of `parts` of an interval.
struct CertificatePlane {
  std::int64_t track = 0;  ///< track id; −1 − k: the k-th box of the map (box_cover.h)
  std::int16_t interval = 0;
  std::int8_t part = 0;   ///< 0 … parts − 1
  std::int8_t parts = 1;  ///< 1, 2 or 4
  Plane plane;            ///< W; the vehicle's points q have n·q + d ≤ −max(radius, kPlaneMargin)
};

/// The cost of a plan: each term as it was used to choose the plan.
struct PlanCost {
  double distance_to_goal = 0.0;  ///< from the end to the local goal, m
  double jerk = 0.0;              ///< Eq. 4: Σ_j ‖jerk_j‖², m²/s⁶
  double attraction = 0.0;        ///< λ_att·C_att
  double repulsion = 0.0;         ///< λ_rep·C_rep
  double total = 0.0;
};

/// The inputs of the goal field (the cost-to-go), apart from the goal's position. Another thread prepares the field,
/// so its map and its static tracks may be older than those of the plan.
struct GoalFieldInputs {
  std::uint64_t map_version = 0;       ///< the map whose boxes it contains; 0: there was no field
  std::int64_t statics_epoch_us = 0;   ///< epoch of the predictor whose static tracks it contains; 0: none
  std::int64_t statics_first_set = 0;  ///< first set received from this predictor; each set adds its static tracks
  std::uint64_t statics = 0;           ///< digest of the static tracks' boxes, in the order of their ids
  /// The request that gave body, flight box and start. {0, 0}: they are the configured ones.
  MessageName vehicle;
};

/// The inputs of a plan, by name.
struct PlanInputs {
  MessageName request, goal, predictions;
  std::int64_t prediction_set = 0;
  std::int32_t left_out = 0;      ///< tracks missing in the predictions; the plan ignores them
  std::uint64_t map_version = 0;  ///< digest of the map; 0: none
  std::uint64_t configuration_hash = 0;
  std::uint64_t planner_build = 0;  ///< digest of the sources of plan()
  GoalFieldInputs goal_field;
};

/// PLAN: the answer to one request. None of its fields depends on a clock.
struct Plan {
  Header header;
  std::int64_t request_id = 0;
  PlanOutcome outcome = PlanOutcome::NoPlan;
  PlanReason reason = PlanReason::None;
  TimedSpline trajectory;  ///< starts at t_s; for KeepCommitted it is the committed one; meaningless for NoPlan
  Duration hold;           ///< terminal clear time: how long the end point stays clear after the end; capped.
  /// The confidence that an estimated track stays within the box that the certificate uses. That box applies α at
  /// `level`, times `alpha_scale`; declared and static tracks keep all of their α. It is 1 if no track is estimated.
  /// It is 0 for a scaled α, whose confidence is unknown, and for NoPlan.
  double confidence = 0.0;
  int level = 0;             ///< index into kConfidenceLevels; 0: the confidence of the predictions
  double alpha_scale = 1.0;  ///< [0, 1]; below 1 at the last level only
  /// `confidence` holds until t_s + sure_for; later pieces apply at most the α of that time. [0, kMaxSpan]; kMaxSpan
  /// means without limit, and 0 means that no confidence is known.
  Duration sure_for = kMaxSpan;
  bool relaxed = false;            ///< the start lay inside a hull, and α was reduced to the largest clear value
  Vec3 local_goal = Vec3::Zero();  ///< W
  double sphere_radius = 0.0;      ///< r, m
  PlanCost cost;
  PlanInputs inputs;
  std::vector<CertificatePlane> certificate;
  std::vector<BudgetCut> cuts;
  /// Set if the watchdog answered: the number of incumbents so far. The watchdog sent the last of them, or an answer of
  /// its own if there was none. nullopt: the planner had finished.
  std::optional<std::int64_t> standing;
};

/// PLAN_TIMING: the time and work of one answer.
struct PlanTiming {
  Header header;
  std::int64_t request_id = 0;
  double total_ms = 0.0;          ///< wall time from the request's arrival to the answer
  double first_answer_ms = 0.0;   ///< wall time until the first certified trajectory
  double cpu_ms = 0.0;            ///< CPU time of the worker thread
  double stage_ms[kStages] = {};  ///< wall time by Stage
  std::int64_t expansions = 0;    ///< search nodes expanded
  std::int64_t hulls = 0;         ///< convex hulls made by CGAL
  /// Pairs of an obstacle and an interval (or a part of one), counted by the first test that settled them.
  std::int64_t pairs_by_index = 0;    ///< out of the vehicle's reach
  std::int64_t pairs_by_box = 0;      ///< bounding boxes are disjoint
  std::int64_t pairs_by_instant = 0;  ///< they touch at one of five instants
  std::int64_t pairs_by_cache = 0;    ///< separated along the last separating direction of that obstacle
  std::int64_t pairs_by_plane = 0;    ///< settled by the fast separation
  std::int64_t pairs_by_lp = 0;       ///< settled by GLPK
  std::int64_t solver_calls = 0;      ///< problems that the optimizer solved
  std::int64_t solver_iterations = 0;
  std::int64_t peak_rss_kb = 0;
  bool from_watchdog = false;  ///< the receiving thread answered, because the worker had not finished in time
};

}  // namespace tern
