#include "runtime/roles.h"

namespace tern {
namespace {

using namespace channels;

template <class... T>
std::vector<std::string_view> names_of(const Channel<T>&... channel) {
  return {channel.name...};
}

std::vector<std::string_view> all_owned() {
  std::vector<std::string_view> names;
  for_each_channel([&names](const auto& channel) {
    if (channel.owner) names.push_back(channel.name);
  });
  return names;
}

}  // namespace

const char* to_string(Role role) {
  switch (role) {
    case Role::Vehicle: return "vehicle";
    case Role::Predictor: return "predictor";
    case Role::Planner: return "planner";
    case Role::Mapper: return "mapper";
    case Role::Operator: return "operator";
    case Role::Observer: return "observer";
    case Role::Executor: return "executor";
  }
  return "unknown";
}

std::optional<Role> role_named(std::string_view name) {
  for (const Role role : kRoles) {
    if (name == to_string(role)) return role;
  }
  return std::nullopt;
}

std::optional<Role> role_of(std::string_view channel) {
  std::optional<Role> role;
  visit_channel(channel, [&role](const auto& known) { role = known.owner; });
  return role;
}

const std::vector<ProcessRole>& process_roles() {
  static const std::vector<ProcessRole> processes = {
      {"tern-simulator", Role::Vehicle,
       names_of(kUavState, kSetpoint, kVehicleStatus, kObstacleObservations, kDeclaredMotions, kHorizonRequest, kPlan,
                kObstacleTruth, kVehicleTruth, kFlightResult, kGoal, kSemanticMap, kObstacleSightings, kImu,
                kFeatureTracks, kPositionFix, kOdometry)},
      {"tern-executor", Role::Executor,
       names_of(kUavState, kVehicleStatus, kGoal, kSpeedLimit, kPlan, kPlanHeading, kHorizonRequest, kSetpoint)},
      {"tern-mavlink", Role::Vehicle,
       names_of(kUavState, kSetpoint, kVehicleStatus, kVehicleTruth, kHorizonRequest, kPlan, kFlightResult, kGoal,
                kOdometry)},
      {"tern-autopilot-sim", Role::Observer, {}},
      {"tern-ros2", Role::Vehicle,
       names_of(kUavState, kSetpoint, kVehicleStatus, kObstacleObservations, kPointCloud, kMapFile, kGoal,
                kHorizonRequest, kPlan, kPredictions, kSemanticMap, kObstacleTruth)},
      {"tern-dimos", Role::Vehicle,
       names_of(kUavState, kSetpoint, kVehicleStatus, kObstacleObservations, kPointCloud, kGoal, kHorizonRequest, kPlan,
                kPredictions, kSemanticMap, kObstacleTruth)},
      {"tern-predictor", Role::Predictor,
       names_of(kObstacleObservations, kObstacleSightings, kDeclaredMotions, kUavState, kOdometry, kPoseError,
                kPredictions, kTrackBounds)},
      {"tern-planner", Role::Planner,
       names_of(kHorizonRequest, kPoseError, kPredictions, kSemanticMap, kGoal, kObstacleSightings, kFeatureTracks,
                kOdometry, kPlan, kPlanHeading, kPlanTiming, kPlanUnseen, kLandmarkDensities, kSearchView)},
      {"tern-detector", Role::Vehicle, names_of(kDepthImage, kPointCloud, kSemanticMap, kObstacleSightings)},
      {"tern-estimator", Role::Vehicle, names_of(kImu, kFeatureTracks, kPositionFix, kPredictions, kOdometry)},
      {"tern-features", Role::Vehicle, names_of(kImu, kFeatureTracks)},
      {"tern-mapper", Role::Mapper, names_of(kSemanticMap, kUavState, kPointCloud, kDepthImage, kMapFile, kFences)},
      {"tern-logger", Role::Observer, {}},
      {"tern-monitor", Role::Observer,
       names_of(kUavState, kSetpoint, kVehicleStatus, kGoal, kHorizonRequest, kPlan, kPlanTiming, kPlanUnseen,
                kSemanticMap, kObstacleObservations, kPredictions, kObstacleTruth, kVehicleTruth, kOdometry,
                kFlightResult)},
      {"tern-viewer", Role::Operator, all_owned()},
      {"tern-mission", Role::Operator,
       names_of(kGoal, kSpeedLimit, kFences, kUavState, kVehicleStatus, kSemanticMap, kPredictions)},
  };
  return processes;
}

std::optional<Role> role_of_process(std::string_view process) {
  for (const ProcessRole& entry : process_roles()) {
    if (entry.process == process) return entry.role;
  }
  return std::nullopt;
}

}  // namespace tern
