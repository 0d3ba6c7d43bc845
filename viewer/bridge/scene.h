// The present state of a flight: the newest message of each kind.
#pragma once

#include <bitset>
#include <map>
#include <optional>
#include <string>

#include "core/wire/health.h"
#include "core/world/body_distance.h"
#include "core/world/flight_result.h"
#include "core/world/goal.h"
#include "core/world/horizon.h"
#include "core/world/inertial.h"
#include "core/world/observation.h"
#include "core/world/plan_heading.h"
#include "core/world/search_view.h"
#include "core/world/sighting.h"
#include "core/world/track.h"
#include "core/world/vehicle.h"
#include "viewer/bridge/board.h"
#include "viewer/bridge/flight_events.h"
#include "viewer/bridge/flight_history.h"
#include "viewer/bridge/seen_cells.h"
#include "viewer/bridge/track_ages.h"
#include "viewer/bridge/voxel_faces.h"
#include "viewer/bridge/world_time.h"

namespace tern {

/// A process, its last heartbeat and its configuration.
struct ObservedProcess {
  Heartbeat heartbeat;
  UTime received;
  std::optional<ConfigurationReport> configuration;
};

/// Greatest number of processes, since a hostile sender may invent names.
inline constexpr std::size_t kMaxProcesses = 64;
/// Greatest number of sensors whose detections are shown.
inline constexpr std::size_t kMaxSensors = 16;

/// The map as drawn, with its label counts.
struct DrawnMap {
  VoxelSurface surface;
  VoxelGrid grid;
  std::uint64_t version = 0;
  std::vector<std::string> class_names;
  std::array<std::int64_t, kVoxelLabels> voxels{};  ///< by label
};

/// Takes validated messages, complete sets and whole maps, and records which topics changed.
class Scene {
 public:
  /// Number of requests that are remembered, since an answer may come when its request is no longer the newest.
  static constexpr std::size_t kRememberedRequests = 16;

  /// The past of the flight, filled by the scene.
  struct Memory {
    FlightHistory history;
    FlightEvents events;
    WorldTime world_time;
    TrackAges ages;
    /// Returns the flight's time 0: the start of world time, or the time of the first state until that is known.
    [[nodiscard]] UTime zero() const { return world_time.zero().value_or(history.begin()); }
  };
  /// @param memory  receives every message too; may be null
  /// @param pace  seconds of flight per second of the system's clock, (0, 1]
  explicit Scene(Memory* memory = nullptr, double pace = 1.0) : memory_(memory), pace_(pace) {}

  /// A new sender epoch means another vehicle and another flight: goals that were sent before it began are dropped.
  void receive(const UavState& message);
  /// Takes VEHICLE_TRUTH: clearances are those of the vehicle as it really is, where that is known.
  void receive_truth(const UavState& message);
  void receive(const ObstacleTruth& complete_set);
  void receive(const ObservationSet& message);
  void receive(const SightingSet& message);
  void receive(TrackSet complete_set);
  void receive(const HorizonRequest& message);
  void receive(const Plan& message);
  void receive(const PlanHeading& message);
  void receive(const PlanTiming& message);
  void receive(const Odometry& message);
  void receive(const FeatureFrame& message);
  void receive(const SearchView& message);
  void receive(const Goal& message);
  void receive(const FlightResult& message);
  void receive(const Heartbeat& message, UTime now);
  void receive(const ConfigurationReport& message);
  void receive(const VoxelMap& map);
  /// Clears everything except the map, for a jump in a log.
  void clear();

  [[nodiscard]] const std::optional<UavState>& state() const { return state_; }
  /// Returns the sender epoch of the vehicle's states; 0 before the first one.
  [[nodiscard]] std::int64_t vehicle_us() const { return state_ ? state_->header.name.sender_epoch_us : 0; }
  [[nodiscard]] const std::optional<ObstacleTruth>& truth() const { return truth_; }
  /// Returns the newest detections of each sensor, by its id.
  [[nodiscard]] const std::map<std::int32_t, ObservationSet>& detections() const { return detections_; }
  /// Returns the names of the obstacles that the scenario lists, by id.
  [[nodiscard]] const std::map<std::int64_t, std::string>& obstacle_names() const { return obstacle_names_; }
  [[nodiscard]] const std::optional<TrackSet>& tracks() const { return tracks_; }
  [[nodiscard]] const std::optional<HorizonRequest>& request() const { return request_; }
  [[nodiscard]] const std::optional<Plan>& plan() const { return plan_; }
  /// Returns the newest heading; nullopt if none was received.
  [[nodiscard]] const std::optional<PlanHeading>& heading() const { return heading_; }
  /// Returns the newest frame of each sensor with a view, by its id.
  [[nodiscard]] const std::map<std::int32_t, SightingSet>& sightings() const { return sightings_; }
  /// Returns where these sensors have seen nothing.
  [[nodiscard]] const SeenCells& seen() const { return seen_; }
  /// Returns the estimator's newest ODOMETRY and FEATURE_TRACKS.
  [[nodiscard]] const std::optional<Odometry>& odometry() const { return odometry_; }
  [[nodiscard]] const std::optional<FeatureFrame>& features() const { return features_; }
  /// Returns the newest VEHICLE_TRUTH.
  [[nodiscard]] const std::optional<UavState>& true_state() const { return true_state_; }
  [[nodiscard]] const std::optional<PlanTiming>& timing() const { return timing_; }
  [[nodiscard]] const std::optional<SearchView>& search() const { return search_; }
  [[nodiscard]] const std::optional<Goal>& goal() const { return goal_; }
  [[nodiscard]] const std::optional<FlightResult>& result() const { return result_; }
  [[nodiscard]] const std::optional<DrawnMap>& map() const { return map_; }
  [[nodiscard]] const std::map<std::string, ObservedProcess>& processes() const { return processes_; }

  /// Returns the referee's distance (core/world/body_distance.h) from the body to the nearest true obstacle, m; nullopt
  /// until both and the body's shape are known.
  [[nodiscard]] std::optional<double> clearance() const;
  /// Returns the same for one true obstacle; nullopt if there is none of that id.
  [[nodiscard]] std::optional<double> clearance_of(std::int64_t id) const;
  /// Returns the distance from the body to the nearest occupied voxel as drawn, m.
  /// @return nullopt until both and the body's shape are known, or if no voxel is occupied
  [[nodiscard]] std::optional<double> map_clearance() const;
  /// Returns the radius of the ball around the body, m; 0 before the first request.
  [[nodiscard]] double body_radius() const;
  /// Returns true if the body centred at p is inside the flight box, or before the first request.
  [[nodiscard]] bool has_room_at(const Vec3& p) const;
  [[nodiscard]] bool has_request() const { return request_.has_value(); }
  /// Returns allowed_ms() by the system's clock, which measures the times in `timing`.
  [[nodiscard]] double allowed_system_ms() const { return allowed_ms() / pace_; }
  /// Returns the time from the request to its deadline for the answer that `timing` describes, ms on the flight's
  /// clock; 0 if unknown.
  [[nodiscard]] double allowed_ms() const;
  /// Returns the time from that request to its answer, ms on the flight's clock; 0 if unknown. At a pace below 1 the
  /// wall time in `timing` is longer.
  [[nodiscard]] double taken_ms() const;
  [[nodiscard]] bool is_late() const { return allowed_ms() > 0.0 && taken_ms() > allowed_ms(); }

  /// Returns true once after each change of the topic.
  bool take_change(Topic topic);
  void mark(Topic topic) { changed_.set(idx(topic)); }

 private:
  void remember_state();
  /// Returns the vehicle's position for clearances, W: as it really is, or as estimated.
  [[nodiscard]] Vec3 position() const;
  void remember(const std::string& table, UTime at, const NumberFields& fields);

  Memory* memory_;
  double pace_;
  std::optional<UavState> state_, true_state_;
  std::optional<BodyDistance> body_;  ///< of the newest request's body
  std::optional<ObstacleTruth> truth_;
  std::map<std::int32_t, ObservationSet> detections_;
  std::map<std::int64_t, std::string> obstacle_names_;
  std::optional<TrackSet> tracks_;
  std::optional<HorizonRequest> request_;
  std::optional<Plan> plan_;
  std::optional<PlanHeading> heading_;
  std::map<std::int32_t, SightingSet> sightings_;
  SeenCells seen_;
  std::optional<Odometry> odometry_;
  std::optional<FeatureFrame> features_;
  std::optional<PlanTiming> timing_;
  std::optional<SearchView> search_;
  std::optional<Goal> goal_;
  std::optional<FlightResult> result_;
  std::optional<DrawnMap> map_;
  std::map<std::string, ObservedProcess> processes_;
  struct RequestTimes {
    UTime at, deadline;
  };
  [[nodiscard]] const RequestTimes* timed_request() const;  ///< of the request that `timing` answers; null: unknown
  std::map<std::int64_t, RequestTimes> request_times_;      ///< of the last requests, by id
  std::bitset<kTopics> changed_;
};

}  // namespace tern
