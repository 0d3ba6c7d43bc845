// A recorded flight as the auditor and the report need it: all messages of interest, decoded and put in order.
#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/world/flight_result.h"
#include "core/world/goal.h"
#include "core/world/health.h"
#include "core/world/horizon.h"
#include "core/world/observation.h"
#include "core/world/region.h"
#include "core/world/track.h"
#include "core/world/vehicle_status.h"
#include "core/world/voxel_map.h"
#include "flight_log/flight_log.h"
#include "tools/audit/cubic.h"

namespace tern::audit {

/// A true obstacle over time.
struct ObstacleHistory {
  struct Sample {
    UTime at;
    Vec3 p, v;          ///< W, m and m/s
    Vec3 half_extents;  ///< m
  };
  std::vector<Sample> samples;  ///< times strictly ascending
  bool moves = false;
};

/// What its owner promised of an obstacle: its centre within curve ± alpha (m, per axis) for as long as the curve
/// lasts.
struct DeclaredPiece {
  Curve curve;
  Vec3 alpha;
};

/// What a log holds of one flight. Times are the vehicle's clock.
///
/// A log may hold more than one: a simulator that starts anew brings another world, whose obstacles, vehicle and time
/// have nothing to do with those before. The flight is the first one that asked for a horizon; the others are named.
struct FlightRecord {
  std::string path;
  LogContents contents;
  std::vector<std::string> other_flights;  ///< in words: whose messages were left out

  /// What the vehicle flew: VEHICLE_TRUTH, or where nobody knows the truth, UAV_STATE. Times strictly ascending, as
  /// below.
  std::vector<UavState> states;
  std::vector<UavState> estimates, setpoints;     ///< UAV_STATE, SETPOINT
  std::vector<VehicleStatus> statuses;            ///< VEHICLE_STATUS
  std::map<std::int64_t, ObstacleHistory> truth;  ///< by obstacle
  /// What was declared of each mover, by obstacle: the newest word at each time, without overlap, in order.
  std::map<std::int64_t, std::vector<DeclaredPiece>> declared;
  std::vector<ObservationSet> observations;  ///< OBSTACLE_OBSERVATIONS, of all sensors, by time
  std::vector<HorizonRequest> requests;      ///< in the log's order, as all below
  std::vector<Plan> plans;
  std::vector<PlanTiming> timings;
  std::vector<Goal> goals;                          ///< each that differs from the one before
  std::set<MessageName> goal_names;                 ///< of all, repetitions included
  std::set<std::uint64_t> configuration_hashes;     ///< of all that were published
  std::map<MessageName, TrackSet> predictions;      ///< complete sets by the name that plans call them
  std::int64_t incomplete_predictions = 0;          ///< sets of which a batch is missing
  std::int64_t truth_left_out = 0;                  ///< most obstacles that a truth message says it left out
  std::map<std::uint64_t, VoxelMap> maps;           ///< complete ones, by version
  std::vector<FlightResult> results;                ///< each that differs from the one before; its first message
  std::vector<ConfigurationReport> configurations;  ///< the last of each process
  std::vector<Region> regions;                      ///< the scenario's; filled by whoever can read configurations
  std::map<std::string, std::string> class_labels;  ///< what its classes are: "attractive", "repulsive", …

  /// Messages of a channel that were sent but cannot be read: lost by their numbers, or refused.
  [[nodiscard]] std::int64_t unread(const std::string& channel) const;
  /// The request of this name, to which a plan answers. @return nullptr if it is not in the log
  [[nodiscard]] const HorizonRequest* request(const MessageName& name) const;
  /// When the flight began: the first request's time, else the first state's. An autopilot is told to hold until world
  /// time begins: there it is the first request after the goal to go to.
  [[nodiscard]] UTime zero() const;
  /// Until when it is judged: the last state's time.
  [[nodiscard]] UTime end() const;
  [[nodiscard]] double seconds(UTime t) const { return (t - zero()).seconds(); }
};

/// Reads a log (a file and its parts, or the folder of flight.lcm). @return an Error when it cannot be opened.
Result<FlightRecord> read_flight(const std::string& path);

}  // namespace tern::audit
