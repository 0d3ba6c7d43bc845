// Channel names (lcmtypes/README.md is the table). A per-vehicle suffix is appended by the bus.
#pragma once

namespace tern::channels {

inline constexpr char kUavState[] = "UAV_STATE";
inline constexpr char kSetpoint[] = "SETPOINT";
inline constexpr char kObstacleObservations[] = "OBSTACLE_OBSERVATIONS";
inline constexpr char kDeclaredMotions[] = "DECLARED_MOTIONS";
inline constexpr char kPredictions[] = "PREDICTIONS";
inline constexpr char kSemanticMap[] = "SEMANTIC_MAP";
inline constexpr char kGoal[] = "GOAL";
inline constexpr char kHorizonRequest[] = "HORIZON_REQUEST";
inline constexpr char kPlan[] = "PLAN";
inline constexpr char kPlanTiming[] = "PLAN_TIMING";
inline constexpr char kSearchView[] = "SEARCH_VIEW";
inline constexpr char kHeartbeat[] = "HEARTBEAT";
inline constexpr char kConfiguration[] = "CONFIGURATION";
inline constexpr char kObstacleTruth[] = "OBSTACLE_TRUTH";
inline constexpr char kFlightResult[] = "FLIGHT_RESULT";

}  // namespace tern::channels
