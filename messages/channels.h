// The contract of the bus: which message travels on which channel, who says it, how often. Whoever wants all channels
// walks this table; lcmtypes/README.md explains it.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>
#include <tuple>

#include "core/base/time.h"
#include "core/world/flight_result.h"
#include "core/world/goal.h"
#include "core/world/health.h"
#include "core/world/horizon.h"
#include "core/world/observation.h"
#include "core/world/search_view.h"
#include "core/world/track.h"
#include "core/world/track_bounds.h"
#include "core/world/vehicle.h"
#include "core/world/vehicle_status.h"
#include "core/world/voxel_map.h"

namespace tern {

/// A part in a flight. The numbers are on the wire (trailer.h).
enum class Role : std::uint8_t {
  Vehicle = 1,  ///< tern-simulator, or sensors and autopilot bridge
  Predictor = 2,
  Planner = 3,
  Mapper = 4,
  Operator = 5,  ///< who says goals: tern-viewer, a mission; the vehicle repeats them
  Observer = 6,  ///< tern-monitor, tern-logger, and any other process
  Executor = 7,  ///< tern-executor: what the vehicle shall fly
};

enum class Scope : std::uint8_t {
  Shared,   ///< of the world, whichever vehicles are in it
  Vehicle,  ///< of one vehicle
};

/// A channel, and by T the type of its messages.
template <class T>
struct Channel {
  const char* name;  ///< without a vehicle's suffix
  Scope scope = Scope::Vehicle;
  const char* rate = "";           ///< in words
  bool latched = false;            ///< the newest message is repeated, so that who comes late gets it
  std::optional<Role> owner = {};  ///< the one role that speaks; nullopt: each role, for itself
  std::optional<Duration> silence =
      {};  ///< of the sender that is heard before another one is; nullopt: several may speak
};

namespace channels {

inline constexpr Duration kSilence{1'000'000};
/// The planner calls predictions of this age stale: it cannot wait longer for a predictor that was started anew. Nor
/// can a vehicle in flight for a planner or an executor: plans are short.
inline constexpr Duration kShortSilence{300'000};
inline constexpr auto kAnyone = std::nullopt;
inline constexpr bool kLatched = true, kStream = false;

// clang-format off
inline constexpr Channel<UavState> kUavState{
    "UAV_STATE", Scope::Vehicle, "100 Hz", kStream, Role::Vehicle, kSilence};
inline constexpr Channel<UavState> kSetpoint{
    "SETPOINT", Scope::Vehicle, "100 Hz", kStream, Role::Executor, kShortSilence};
inline constexpr Channel<VehicleStatus> kVehicleStatus{
    "VEHICLE_STATUS", Scope::Vehicle, "10 Hz, and at once when it changes", kLatched, Role::Vehicle, kSilence};
inline constexpr Channel<ObservationSet> kObstacleObservations{
    "OBSTACLE_OBSERVATIONS", Scope::Vehicle, "30 Hz", kStream, Role::Vehicle, kAnyone};
inline constexpr Channel<TrackSet> kDeclaredMotions{
    "DECLARED_MOTIONS", Scope::Shared, "5 Hz", kStream, Role::Vehicle, kSilence};
inline constexpr Channel<TrackSet> kPredictions{
    "PREDICTIONS", Scope::Vehicle, "20 Hz", kStream, Role::Predictor, kShortSilence};
inline constexpr Channel<TrackBounds> kTrackBounds{
    "TRACK_BOUNDS", Scope::Vehicle, "2 Hz", kStream, Role::Predictor, kShortSilence};
inline constexpr Channel<MapChunk> kSemanticMap{
    "SEMANTIC_MAP", Scope::Shared, "≥ 1 Hz, chunks in rotation", kLatched, Role::Mapper, kMapSilence};
inline constexpr Channel<Goal> kGoal{
    "GOAL", Scope::Vehicle, "on demand, repeated at 1 Hz", kLatched, Role::Operator, kAnyone};
inline constexpr Channel<HorizonRequest> kHorizonRequest{
    "HORIZON_REQUEST", Scope::Vehicle, "10–20 Hz", kStream, Role::Executor, kShortSilence};
inline constexpr Channel<Plan> kPlan{
    "PLAN", Scope::Vehicle, "one per request", kStream, Role::Planner, kShortSilence};
inline constexpr Channel<PlanTiming> kPlanTiming{
    "PLAN_TIMING", Scope::Vehicle, "one per request", kStream, Role::Planner, kShortSilence};
inline constexpr Channel<SearchView> kSearchView{
    "SEARCH_VIEW", Scope::Vehicle, "one per request, only with `planner.publish_search`", kStream, Role::Planner,
    kShortSilence};
inline constexpr Channel<Heartbeat> kHeartbeat{
    "HEARTBEAT", Scope::Vehicle, "2 Hz, and at once for a new process", kStream, kAnyone, kAnyone};
inline constexpr Channel<ConfigurationReport> kConfiguration{
    "CONFIGURATION", Scope::Vehicle, "at start, 0.2 Hz", kLatched, kAnyone, kAnyone};
inline constexpr Channel<ObstacleTruth> kObstacleTruth{
    "OBSTACLE_TRUTH", Scope::Shared, "30 Hz", kStream, Role::Vehicle, kSilence};
inline constexpr Channel<UavState> kVehicleTruth{
    "VEHICLE_TRUTH", Scope::Vehicle, "100 Hz", kStream, Role::Vehicle, kSilence};
inline constexpr Channel<FlightResult> kFlightResult{
    "FLIGHT_RESULT", Scope::Vehicle, "at the end", kLatched, Role::Vehicle, kSilence};
// clang-format on

inline constexpr std::tuple kAll{kUavState,
                                 kSetpoint,
                                 kVehicleStatus,
                                 kObstacleObservations,
                                 kDeclaredMotions,
                                 kPredictions,
                                 kTrackBounds,
                                 kSemanticMap,
                                 kGoal,
                                 kHorizonRequest,
                                 kPlan,
                                 kPlanTiming,
                                 kSearchView,
                                 kHeartbeat,
                                 kConfiguration,
                                 kObstacleTruth,
                                 kVehicleTruth,
                                 kFlightResult};

}  // namespace channels

/// Calls visit(channel) for each of Tern's channels, or for each of a tuple of some.
template <class Visit, class Channels = decltype(channels::kAll)>
constexpr void for_each_channel(Visit&& visit, const Channels& all = channels::kAll) {
  std::apply([&visit](const auto&... channel) { (visit(channel), ...); }, all);
}

/// Calls visit(channel) for the one of this name, if it is among them. @return whether it is
/// @param name  without a vehicle's suffix
template <class Visit, class Channels = decltype(channels::kAll)>
bool visit_channel(std::string_view name, Visit&& visit, const Channels& all = channels::kAll) {
  bool found = false;
  const auto look = [&](const auto& channel) {
    if (channel.name != name) return;
    found = true;
    visit(channel);
  };
  for_each_channel(look, all);
  return found;
}

}  // namespace tern
