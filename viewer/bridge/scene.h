// What is known of a flight right now: the newest message of each kind.
#pragma once

#include <bitset>
#include <map>
#include <optional>
#include <string>

#include "core/world/flight_result.h"
#include "core/world/goal.h"
#include "core/world/health.h"
#include "core/world/horizon.h"
#include "core/world/observation.h"
#include "core/world/search_view.h"
#include "core/world/track.h"
#include "core/world/vehicle.h"
#include "viewer/bridge/board.h"
#include "viewer/bridge/flight_events.h"
#include "viewer/bridge/flight_history.h"
#include "viewer/bridge/voxel_faces.h"
#include "viewer/bridge/world_time.h"

namespace tern {

/// A process as it was heard.
struct ObservedProcess {
  Heartbeat heartbeat;
  UTime received;
  std::optional<ConfigurationReport> configuration;
};

/// Names are hostile, too: more processes than this are not remembered.
inline constexpr std::size_t kMaxProcesses = 64;

/// The map as it is drawn, and what is told of it.
struct DrawnMap {
  VoxelSurface surface;
  VoxelGrid grid;
  std::uint64_t version = 0;
  std::vector<std::string> class_names;
  std::array<std::int64_t, kVoxelLabels> voxels{};  ///< by label
};

/// Takes validated messages, complete sets and whole maps. Which topics changed is noted for whoever tells the page.
class Scene {
 public:
  /// An answer may come when its request is no longer the newest: so many are asked about.
  static constexpr std::size_t kRememberedRequests = 16;

  /// What is remembered of the flight.
  struct Memory {
    FlightHistory history;
    FlightEvents events;
    WorldTime world_time;
    /// The flight's time 0: that of the world, and before it is known, that of the first state.
    [[nodiscard]] UTime zero() const { return world_time.zero().value_or(history.begin()); }
  };
  /// @param memory  is told of everything that is heard; may be null
  explicit Scene(Memory* memory = nullptr) : memory_(memory) {}

  /// A state of another vehicle (a new sender epoch) is another flight's: goals that were sent before it began are
  /// forgotten.
  void receive(const UavState& message);
  void receive(const ObstacleTruth& complete_set);
  void receive(TrackSet complete_set);
  void receive(const HorizonRequest& message);
  void receive(const Plan& message);
  void receive(const PlanTiming& message);
  void receive(const SearchView& message);
  void receive(const Goal& message);
  void receive(const FlightResult& message);
  void receive(const Heartbeat& message, UTime now);
  void receive(const ConfigurationReport& message);
  void receive(const VoxelMap& map);
  /// Forgets everything but the map, for a jump in a log.
  void clear();

  [[nodiscard]] const std::optional<UavState>& state() const { return state_; }
  /// The sender epoch of the vehicle's states; 0: none was heard.
  [[nodiscard]] std::int64_t vehicle_us() const { return state_ ? state_->header.name.sender_epoch_us : 0; }
  [[nodiscard]] const std::optional<ObstacleTruth>& truth() const { return truth_; }
  [[nodiscard]] const std::optional<TrackSet>& tracks() const { return tracks_; }
  [[nodiscard]] const std::optional<HorizonRequest>& request() const { return request_; }
  [[nodiscard]] const std::optional<Plan>& plan() const { return plan_; }
  [[nodiscard]] const std::optional<PlanTiming>& timing() const { return timing_; }
  [[nodiscard]] const std::optional<SearchView>& search() const { return search_; }
  [[nodiscard]] const std::optional<Goal>& goal() const { return goal_; }
  [[nodiscard]] const std::optional<FlightResult>& result() const { return result_; }
  [[nodiscard]] const std::optional<DrawnMap>& map() const { return map_; }
  [[nodiscard]] const std::map<std::string, ObservedProcess>& processes() const { return processes_; }

  /// From the body to the nearest true obstacle, m; nullopt before both were heard. A body of vertices counts as the
  /// ball around it.
  [[nodiscard]] std::optional<double> clearance() const;
  /// From the body, taken for a ball as well, to the nearest occupied voxel of the map, m.
  /// @return nullopt before both were heard, or if nothing is occupied.
  [[nodiscard]] std::optional<double> map_clearance() const;
  /// Of the ball around the vehicle's body, m; 0 before a request says it.
  [[nodiscard]] double body_radius() const;
  /// Whether the body is within the flight box when its centre is there; true before a request says both.
  [[nodiscard]] bool has_room_at(const Vec3& p) const;
  /// What the planner was given for the answer that `timing` tells of, ms by the flight's clock; 0: not known.
  [[nodiscard]] double allowed_ms() const;
  /// From that request to that answer, ms by the flight's clock; 0: not known.
  /// At a pace below 1 the wall time that `timing` tells is longer.
  [[nodiscard]] double taken_ms() const;
  [[nodiscard]] bool is_late() const { return allowed_ms() > 0.0 && taken_ms() > allowed_ms(); }

  /// True once per change.
  bool take_change(Topic topic);
  void mark(Topic topic) { changed_.set(idx(topic)); }

 private:
  void remember_state();
  void remember(const std::string& table, UTime at, const NumberFields& fields);

  Memory* memory_;
  std::optional<UavState> state_;
  std::optional<ObstacleTruth> truth_;
  std::optional<TrackSet> tracks_;
  std::optional<HorizonRequest> request_;
  std::optional<Plan> plan_;
  std::optional<PlanTiming> timing_;
  std::optional<SearchView> search_;
  std::optional<Goal> goal_;
  std::optional<FlightResult> result_;
  std::optional<DrawnMap> map_;
  std::map<std::string, ObservedProcess> processes_;
  struct RequestTimes {
    UTime at, deadline;
  };
  [[nodiscard]] const RequestTimes* timed_request() const;  ///< of the request that `timing` answers; null: not known
  std::map<std::int64_t, RequestTimes> request_times_;      ///< of the last requests, by id
  std::bitset<kTopics> changed_;
};

}  // namespace tern
