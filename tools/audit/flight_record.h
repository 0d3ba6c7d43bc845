// A recorded flight: the messages that audit and report need, decoded and sorted.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/scenario/region.h"
#include "core/wire/health.h"
#include "core/world/flight_result.h"
#include "core/world/goal.h"
#include "core/world/horizon.h"
#include "core/world/inertial.h"
#include "core/world/observation.h"
#include "core/world/plan_heading.h"
#include "core/world/sighting.h"
#include "core/world/track.h"
#include "core/world/vehicle_status.h"
#include "core/world/voxel_map.h"
#include "flight_log/flight_log.h"
#include "tools/audit/cubic.h"

namespace tern::audit {

/// The recorded truth of one obstacle.
struct ObstacleHistory {
  struct Sample {
    UTime at;
    Vec3 p, v;          ///< W, m and m/s
    Vec3 half_extents;  ///< m
  };
  std::vector<Sample> samples;  ///< times strictly ascending
  bool moves = false;
};

/// A declared motion: the owner promises that the centre stays within curve ± alpha (m, per axis) while the curve
/// lasts.
struct DeclaredPiece {
  Curve curve;
  Vec3 alpha;
};

/// The messages of one flight. Times are on the vehicle's clock.
///
/// A log may hold several flights, since a restarted simulator begins a new world. The record holds the first flight
/// with a HORIZON_REQUEST; the others are only listed.
struct FlightRecord {
  std::string path;
  LogContents contents;
  std::vector<std::string> other_flights;  ///< in words: flights whose messages were skipped

  /// The flown states: VEHICLE_TRUTH, or UAV_STATE if the log has no VEHICLE_TRUTH. Times strictly ascending, here and
  /// in every list of states below.
  std::vector<UavState> states;
  std::vector<UavState> estimates, setpoints;     ///< UAV_STATE, SETPOINT
  std::vector<VehicleStatus> statuses;            ///< VEHICLE_STATUS
  std::vector<Odometry> odometry;                 ///< ODOMETRY with a valid pose, of a vehicle that estimates its own
  std::map<std::int64_t, ObstacleHistory> truth;  ///< by obstacle
  /// Declared motions by obstacle: at each time the newest declaration; no overlaps, ascending.
  std::map<std::int64_t, std::vector<DeclaredPiece>> declared;
  std::vector<ObservationSet> observations;          ///< OBSTACLE_OBSERVATIONS of all sensors, by time
  std::vector<ObservationSet> sightings;             ///< OBSTACLE_SIGHTINGS, by time: the boxes of the visible parts
  std::vector<HorizonRequest> requests;              ///< in the log's order, like every list below
  std::vector<SightingSet> frames;                   ///< OBSTACLE_SIGHTINGS, without their sightings
  std::map<MessageName, std::size_t> frames_before;  ///< how many of them are logged before each request
  std::vector<Plan> plans;
  std::vector<PlanTiming> timings;
  std::vector<PlanHeading> headings;
  std::vector<Goal> goals;                          ///< without repetitions
  std::set<MessageName> goal_names;                 ///< of all goals, repetitions included
  std::set<std::uint64_t> configuration_hashes;     ///< of every CONFIGURATION
  std::map<MessageName, TrackSet> predictions;      ///< complete sets, by the name that plans give
  std::int64_t incomplete_predictions = 0;          ///< sets with a missing batch
  std::int64_t truth_left_out = 0;                  ///< the most obstacles that any OBSTACLE_TRUTH says it omitted
  std::map<std::uint64_t, VoxelMap> maps;           ///< complete maps, by version
  std::vector<FlightResult> results;                ///< first message of each that differs from its predecessor
  std::vector<ConfigurationReport> configurations;  ///< the last of each process
  std::set<std::string> processes;                  ///< that sent a HEARTBEAT
  std::string logger_trouble;  ///< tern-logger's words about messages that it could not write; may be empty
  std::optional<double> summary_flight_s = {};         ///< by the summary beside the log; filled by load_flight()
  std::string why;                                     ///< as in the summary (monitor/flight_cause.h); by load_flight()
  std::map<std::int64_t, std::string> obstacle_names;  ///< of the scenario; filled by load_flight()
  std::vector<Region> regions;                         ///< of the scenario; filled by load_flight()
  std::map<std::string, std::string> class_labels;     ///< class → "attractive", "repulsive", …

  /// Returns how many messages of a channel were lost (as the sequence numbers show) or refused.
  [[nodiscard]] std::int64_t unread(const std::string& channel) const;
  /// Names a true obstacle: "obstacle 3 'gate'", or "obstacle 3" if the scenario gives it no name.
  [[nodiscard]] std::string name_of(std::int64_t obstacle) const;
  /// Returns the request with this name. @return nullptr if it is not in the log
  [[nodiscard]] const HorizonRequest* request(const MessageName& name) const;
  /// Returns the start of the flight: the time of the first request, or of the first state if there is no request. With
  /// an autopilot, whose first goal is to hold, it is the first request after the first goal to go.
  [[nodiscard]] UTime zero() const;
  /// Returns the end of the judged time: the time of the last state.
  [[nodiscard]] UTime end() const;
  [[nodiscard]] double seconds(UTime t) const { return (t - zero()).seconds(); }
};

/// Reads a log (a file with its further parts, or a flight's folder). @return an Error if it cannot be opened
Result<FlightRecord> read_flight(const std::string& path);

}  // namespace tern::audit
