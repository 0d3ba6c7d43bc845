// The channels of the bus: type, sender, rate. Code that handles all channels walks this table.
// docs/reference/messages.md is made from it and from lcmtypes/.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>
#include <tuple>

#include "core/base/time.h"
#include "core/wire/health.h"
#include "core/world/fence_set.h"
#include "core/world/flight_result.h"
#include "core/world/goal.h"
#include "core/world/horizon.h"
#include "core/world/inertial.h"
#include "core/world/landmark_densities.h"
#include "core/world/map_file.h"
#include "core/world/observation.h"
#include "core/world/plan_heading.h"
#include "core/world/plan_unseen.h"
#include "core/world/pose_error.h"
#include "core/world/scan.h"
#include "core/world/search_view.h"
#include "core/world/sighting.h"
#include "core/world/speed_limit.h"
#include "core/world/track.h"
#include "core/world/track_bounds.h"
#include "core/world/vehicle.h"
#include "core/world/vehicle_status.h"
#include "core/world/voxel_map.h"

namespace tern {

/// The role of a process in a flight. The numbers are on the wire (trailer.h).
enum class Role : std::uint8_t {
  Vehicle = 1,  ///< tern-simulator, or sensors and bridges of a vehicle; tern-detector, tern-estimator
  Predictor = 2,
  Planner = 3,
  Mapper = 4,
  Operator = 5,  ///< sends goals: tern-viewer, a mission; the vehicle repeats them
  Observer = 6,  ///< tern-monitor, tern-logger, and any other process
  Executor = 7,  ///< tern-executor: sends the setpoints
};

/// The owner of the messages of a channel.
enum class Scope : std::uint8_t {
  Shared,   ///< the world; all vehicles share the channel
  Vehicle,  ///< one vehicle; its channels may have a suffix
};

/// A channel whose messages have the type T.
template <class T>
struct Channel {
  const char* name;  ///< without a vehicle's suffix
  Scope scope = Scope::Vehicle;
  const char* rate = "";           ///< in words
  bool latched = false;            ///< the newest message is repeated for processes that start late
  std::optional<Role> owner = {};  ///< the only role that may send; nullopt: any.
  /// A sender owns the channel until it has been silent for this long; then another one may take over. nullopt: several
  /// senders may send at the same time.
  std::optional<Duration> silence = {};
};

namespace channels {

inline constexpr Duration kSilence{1'000'000};
/// For senders on which a vehicle in flight depends. Predictions of this age are stale, and plans are short, so a
/// restarted predictor, planner or executor must be accepted by then.
inline constexpr Duration kShortSilence{300'000};
/// MAP_FILE is repeated every 5 s.
inline constexpr Duration kMapFileSilence{6'000'000};
/// FENCES is repeated every second.
inline constexpr Duration kFencesSilence{1'500'000};
inline constexpr auto kAnyone = std::nullopt;
inline constexpr bool kLatched = true, kStream = false;

// clang-format off
/// The state of the vehicle as estimated.
inline constexpr Channel<UavState> kUavState{
    "UAV_STATE", Scope::Vehicle, "100 Hz", kStream, Role::Vehicle, kSilence};
/// The state of the vehicle as commanded: at a fixed rate, and at each knot of the committed trajectory.
inline constexpr Channel<UavState> kSetpoint{
    "SETPOINT", Scope::Vehicle, "100 Hz", kStream, Role::Executor, kShortSilence};
/// Whether the vehicle follows its setpoints and why not; armed, landed, mode, battery, health of the estimator.
inline constexpr Channel<VehicleStatus> kVehicleStatus{
    "VEHICLE_STATUS", Scope::Vehicle, "10 Hz, and at once when it changes", kLatched, Role::Vehicle, kSilence};
/// The detections of one sensor at one time; several sensors may send.
inline constexpr Channel<ObservationSet> kObstacleObservations{
    "OBSTACLE_OBSERVATIONS", Scope::Vehicle, "30 Hz", kStream, Role::Vehicle, kAnyone};
/// One frame of a sensor that knows what hides what: what it saw, and what it looked at; several sensors may send.
inline constexpr Channel<SightingSet> kObstacleSightings{
    "OBSTACLE_SIGHTINGS", Scope::Vehicle, "10–30 Hz per sensor", kStream, Role::Vehicle, kAnyone};
/// Points that a sensor measured, for a live map; several sensors may send.
inline constexpr Channel<CloudScan> kPointCloud{
    "POINT_CLOUD", Scope::Vehicle, "at most 20 Hz", kStream, Role::Vehicle, kAnyone};
/// Distances that a camera measured, for a live map; several cameras may send.
inline constexpr Channel<DepthImage> kDepthImage{
    "DEPTH_IMAGE", Scope::Vehicle, "at most 20 Hz", kStream, Role::Vehicle, kAnyone};
/// A map that another program made, for a live map.
inline constexpr Channel<MapFile> kMapFile{
    "MAP_FILE", Scope::Vehicle, "on demand, repeated every 5 s", kLatched, Role::Vehicle, kMapFileSilence};
/// Motions that the owner of obstacles declares, with α.
inline constexpr Channel<TrackSet> kDeclaredMotions{
    "DECLARED_MOTIONS", Scope::Shared, "5 Hz", kStream, Role::Vehicle, kSilence};
/// Per track a box, cubic pieces, and per piece α with its shares at lower levels of confidence.
inline constexpr Channel<TrackSet> kPredictions{
    "PREDICTIONS", Scope::Vehicle, "20 Hz", kStream, Role::Predictor, kShortSilence};
/// How wrong the vehicle's pose may be, for the set of PREDICTIONS that follows.
inline constexpr Channel<PoseError> kPoseError{
    "POSE_ERROR", Scope::Vehicle, "one per set of PREDICTIONS, only with ODOMETRY", kStream, Role::Predictor,
    kShortSilence};
/// For display: per estimated track, about 1 s ahead, the bounds from which α follows.
inline constexpr Channel<TrackBounds> kTrackBounds{
    "TRACK_BOUNDS", Scope::Vehicle, "2 Hz", kStream, Role::Predictor, kShortSilence};
/// Labels and classes of voxels, run-length coded; a digest names the map.
inline constexpr Channel<MapChunk> kSemanticMap{
    "SEMANTIC_MAP", Scope::Shared, "≥ 1 Hz, chunks in rotation", kLatched, Role::Mapper, kMapSilence};
/// Go, hold or stop, and where; every new goal has a larger id.
inline constexpr Channel<Goal> kGoal{
    "GOAL", Scope::Vehicle, "on demand, repeated at 1 Hz", kLatched, Role::Operator, kAnyone};
/// How fast to fly to a goal; sent before the GOAL whose id it names.
inline constexpr Channel<SpeedLimit> kSpeedLimit{
    "SPEED_LIMIT", Scope::Vehicle, "with a GOAL that has one", kLatched, Role::Operator, kAnyone};
/// The fences that a ground station has uploaded, in addition to those of the scenario.
inline constexpr Channel<FenceSet> kFences{
    "FENCES", Scope::Vehicle, "when they change, repeated at 1 Hz; only with `mission.fence_uploads`", kLatched,
    Role::Operator, kFencesSilence};
/// Asks for a plan from the committed state at t_s, by a deadline, within limits.
inline constexpr Channel<HorizonRequest> kHorizonRequest{
    "HORIZON_REQUEST", Scope::Vehicle, "10–20 Hz", kStream, Role::Executor, kShortSilence};
/// The answer: trajectory, certificate, confidence, hold, cost, and the names of its inputs.
inline constexpr Channel<Plan> kPlan{
    "PLAN", Scope::Vehicle, "one per request", kStream, Role::Planner, kShortSilence};
/// The yaw along the trajectory of a plan.
inline constexpr Channel<PlanHeading> kPlanHeading{
    "PLAN_HEADING", Scope::Vehicle, "one per plan, only with `planner.heading: planned`", kStream, Role::Planner,
    kShortSilence};
/// Time by stage, work and memory of one answer.
inline constexpr Channel<PlanTiming> kPlanTiming{
    "PLAN_TIMING", Scope::Vehicle, "one per request", kStream, Role::Planner, kShortSilence};
/// How long a plan is clear of movers that no sensor has seen.
inline constexpr Channel<PlanUnseen> kPlanUnseen{
    "PLAN_UNSEEN", Scope::Vehicle, "one per plan, only with `planner.unseen: passive`", kStream, Role::Planner,
    kShortSilence};
/// The densities of landmarks that a goal field was made with, where they are not those of the labels.
inline constexpr Channel<LandmarkDensities> kLandmarkDensities{
    "LANDMARK_DENSITIES", Scope::Vehicle, "when they change, repeated at 1 Hz; only if they are learnt", kLatched,
    Role::Planner, kShortSilence};
/// For display: the nodes of the last search.
inline constexpr Channel<SearchView> kSearchView{
    "SEARCH_VIEW", Scope::Vehicle, "one per request, only with `planner.publish_search`", kStream, Role::Planner,
    kShortSilence};
/// The state of a process, what it waits for, counters by channel, echoes of other heartbeats.
inline constexpr Channel<Heartbeat> kHeartbeat{
    "HEARTBEAT", Scope::Vehicle, "2 Hz, and at once for a new process", kStream, kAnyone, kAnyone};
/// The effective configuration of a process as YAML, with its hash.
inline constexpr Channel<ConfigurationReport> kConfiguration{
    "CONFIGURATION", Scope::Vehicle, "at start, 0.2 Hz", kLatched, kAnyone, kAnyone};
/// The obstacles as they really are.
inline constexpr Channel<ObstacleTruth> kObstacleTruth{
    "OBSTACLE_TRUTH", Scope::Shared, "30 Hz", kStream, Role::Vehicle, kSilence};
/// The state of the vehicle as it really is, if it is known.
inline constexpr Channel<UavState> kVehicleTruth{
    "VEHICLE_TRUTH", Scope::Vehicle, "100 Hz", kStream, Role::Vehicle, kSilence};
/// Angular velocity and specific force of the body; several units may send.
inline constexpr Channel<ImuBatch> kImu{
    "IMU", Scope::Vehicle, "50–400 Hz", kStream, Role::Vehicle, kAnyone};
/// The features that a stereo pair tracks; several pairs may send.
inline constexpr Channel<FeatureFrame> kFeatureTracks{
    "FEATURE_TRACKS", Scope::Vehicle, "10–30 Hz", kStream, Role::Vehicle, kAnyone};
/// A position from outside; several sensors may send.
inline constexpr Channel<PositionFix> kPositionFix{
    "POSITION_FIX", Scope::Vehicle, "at most 20 Hz", kStream, Role::Vehicle, kAnyone};
/// Pose, velocity, biases and covariances as a visual-inertial estimator has them.
inline constexpr Channel<Odometry> kOdometry{
    "ODOMETRY", Scope::Vehicle, "one per frame of features", kStream, Role::Vehicle, kShortSilence};
/// The referee's verdict and its measures.
inline constexpr Channel<FlightResult> kFlightResult{
    "FLIGHT_RESULT", Scope::Vehicle, "at the end", kLatched, Role::Vehicle, kSilence};
// clang-format on

inline constexpr std::tuple kAll{kUavState,          kSetpoint,     kVehicleStatus, kObstacleObservations,
                                 kObstacleSightings, kPointCloud,   kDepthImage,    kDeclaredMotions,
                                 kPredictions,       kTrackBounds,  kSemanticMap,   kGoal,
                                 kHorizonRequest,    kPlan,         kPlanHeading,   kPlanTiming,
                                 kPlanUnseen,        kSearchView,   kHeartbeat,     kConfiguration,
                                 kObstacleTruth,     kVehicleTruth, kImu,           kFeatureTracks,
                                 kPositionFix,       kOdometry,     kFlightResult,  kMapFile,
                                 kSpeedLimit,        kFences,       kPoseError,     kLandmarkDensities};

}  // namespace channels

/// Calls visit(channel) for each of Tern's channels, or for each channel of the tuple `all`.
template <class Visit, class Channels = decltype(channels::kAll)>
constexpr void for_each_channel(Visit&& visit, const Channels& all = channels::kAll) {
  std::apply([&visit](const auto&... channel) { (visit(channel), ...); }, all);
}

/// Calls visit(channel) for the channel with this name. @return false if there is none
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
