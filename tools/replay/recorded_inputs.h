// Reads the planners' answers of a log and their inputs.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/wire/health.h"
#include "core/world/goal.h"
#include "core/world/horizon.h"
#include "core/world/landmark_densities.h"
#include "core/world/plan_heading.h"
#include "core/world/sighting.h"
#include "core/world/track.h"
#include "core/world/voxel_map.h"
#include "flight_log/flight_log.h"

namespace tern {

/// An answer of a planner.
struct RecordedPlan {
  Plan plan;
  std::int64_t received_us = 0;        ///< by the logger, µs since the Unix epoch
  std::optional<PlanTiming> timing;    ///< its measured cost; nullopt if the log has none
  std::optional<PlanHeading> heading;  ///< nullopt if the log has none
};

/// The inputs that plans name, except prediction sets: those are many and are read by read_prediction_sets().
struct RecordedInputs {
  std::vector<RecordedPlan> plans;  ///< in the log's order
  std::map<MessageName, HorizonRequest> requests;
  std::map<MessageName, Goal> goals;
  std::map<std::uint64_t, VoxelMap> maps;                       ///< complete ones, by version
  std::map<std::uint64_t, LandmarkDensities> densities;         ///< by the `statics` that names them
  std::map<std::uint64_t, ConfigurationReport> configurations;  ///< one of each hash
  std::map<std::int64_t, std::string> platforms;                ///< by the sender epoch of any process
  // Only if a planner had `planner.unseen: passive`:
  std::vector<SightingSet> frames;                   ///< of OBSTACLE_SIGHTINGS, without sightings, in the log's order
  std::map<MessageName, std::size_t> frames_before;  ///< how many of them are logged before each request
  LogContents log;
};

/// @param path  a log (all its parts are read) or a flight's folder. @return an Error if it cannot be opened
Result<RecordedInputs> read_recorded_inputs(const std::string& path, const std::string& suffix = "");

/// Calls `use` with each complete prediction set, of any predictor, in the order of completion.
/// @return the log's contents as far as predictions are concerned
Result<LogContents> read_prediction_sets(const std::string& path, const std::string& suffix,
                                         const std::function<void(TrackSet)>& use);

}  // namespace tern
