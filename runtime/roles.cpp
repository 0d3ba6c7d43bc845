#include "runtime/roles.h"

#include <algorithm>
#include <array>
#include <utility>

#include "runtime/channels.h"

namespace tern {
namespace {

using namespace channels;

constexpr std::pair<std::string_view, Role> kOwners[] = {
    {kUavState, Role::Vehicle},        {kSetpoint, Role::Vehicle},       {kObstacleObservations, Role::Vehicle},
    {kDeclaredMotions, Role::Vehicle}, {kHorizonRequest, Role::Vehicle}, {kObstacleTruth, Role::Vehicle},
    {kFlightResult, Role::Vehicle},    {kPredictions, Role::Predictor},  {kPlan, Role::Planner},
    {kPlanTiming, Role::Planner},      {kSearchView, Role::Planner},     {kSemanticMap, Role::Mapper},
    {kGoal, Role::Operator},
};

std::vector<std::string_view> all_channels() {
  std::vector<std::string_view> all;
  for (const auto& [channel, role] : kOwners) all.push_back(channel);
  return all;
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
  for (const auto& [name, role] : kOwners) {
    if (name == channel) return role;
  }
  return std::nullopt;
}

const std::vector<Part>& parts() {
  static const std::vector<Part> kParts = {
      {"tern-simulator",
       Role::Vehicle,
       {kUavState, kSetpoint, kObstacleObservations, kDeclaredMotions, kHorizonRequest, kObstacleTruth, kFlightResult,
        kGoal, kPlan}},
      {"tern-predictor", Role::Predictor, {kObstacleObservations, kDeclaredMotions, kUavState, kPredictions}},
      {"tern-planner",
       Role::Planner,
       {kHorizonRequest, kPredictions, kSemanticMap, kGoal, kPlan, kPlanTiming, kSearchView}},
      {"tern-mapper", Role::Mapper, {kSemanticMap}},
      {"tern-logger", Role::Observer, {}},
      {"tern-monitor",
       Role::Observer,
       {kUavState, kSetpoint, kGoal, kHorizonRequest, kPlan, kPlanTiming, kObstacleTruth, kFlightResult}},
      {"tern-viewer", Role::Operator, all_channels()},
  };
  return kParts;
}

std::optional<Role> role_of_process(std::string_view process) {
  for (const Part& part : parts()) {
    if (part.process == process) return part.role;
  }
  return std::nullopt;
}

}  // namespace tern
