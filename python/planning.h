// Requests, worlds and answers as the Python module makes them: checked as messages are, and prepared once.
#pragma once

#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "messages/codec.h"
#include "messages/refused_field.h"
#include "planner/planner.h"

namespace tern::python {

/// The vehicle as a request describes it.
struct Vehicle {
  Limits limits;
  Body body;
  Box flight_box = box_around(Vec3::Zero(), Vec3::Constant(1e4));  ///< the body stays inside, W, m
  Vec3 tube = Vec3::Zero();  ///< per axis, how far the vehicle may be from its setpoints, m, ≥ 0
};

/// Checks a value by the rules of its message (messages/codec.h).
/// @throws std::invalid_argument that begins with `what` and names field, value or rule
template <class T>
void require_acceptable(const T& message, const std::string& what) {
  const Bytes bytes = encode(message);
  if (decode<T>(bytes)) return;
  const std::string field = refused_field<T>(bytes);
  throw std::invalid_argument(what + ": " + (field.empty() ? "has a value out of range" : field));
}

/// Returns a request for a plan that leaves `committed` at t_s. It is published 75 ms and due 5 ms before t_s.
/// @throws std::invalid_argument for values that a planner would refuse
HorizonRequest request_of(const Vehicle& vehicle, const TimedSpline& committed, UTime t_s, std::int64_t id);

/// Returns a complete set of tracks, in ascending order of ids.
/// @throws std::invalid_argument for tracks that a planner would refuse, and for an id that occurs twice
TrackSet track_set_of(std::vector<Track> tracks, UTime made_at, double confidence);

/// Checks grid, labels and classes of a map, and sets its version. @throws std::invalid_argument
VoxelMap checked_map(VoxelMap map);

/// Returns the planner's configuration. @param settings  "planner.search.samples_xy=5", as `--set` takes them; of the
/// sections planner and semantics. @throws ConfigError
PlannerConfig planner_config_of(const std::vector<std::string>& settings);

/// The inputs of plan() except request and budget. It does not change, and copies share its parts.
class PreparedWorld {
 public:
  /// Makes the fields of map and goal: about 100 ms, with regions about 300 ms.
  /// @param vehicle  paths to the goal are made for its body, grown by its tube, and its flight box
  /// @param goal, start  W, m; `start` enlarges the region in which paths are sought
  PreparedWorld(const Vehicle& vehicle, const Vec3& goal, const Vec3& start, TrackSet tracks, const VoxelMap& map,
                PlannerConfig config);
  /// Takes parts that are prepared.
  PreparedWorld(PlanningWorld world, PlannerConfig config, const Vec3& start)
      : world_(std::move(world)), config_(std::move(config)), start_(start) {}

  /// Returns this world with other tracks. The goal's field is made anew only if the static tracks differ.
  [[nodiscard]] PreparedWorld with_tracks(TrackSet tracks) const;

  [[nodiscard]] const PlanningWorld& world() const { return world_; }
  [[nodiscard]] const PlannerConfig& config() const { return config_; }
  [[nodiscard]] const Vec3& start() const { return start_; }

 private:
  PlanningWorld world_;
  PlannerConfig config_;
  Vec3 start_;
};

/// A plan with the work that it took.
struct Answer {
  Plan plan;
  std::optional<PlanStatistics> statistics;  ///< nullopt for an answer of the watchdog, and for one from a log
};

/// Plans with the memory of the calling thread. @param cuts  where the budget ended loops; nullopt: nowhere
Answer answer_of(const HorizonRequest& request, const PreparedWorld& world,
                 const std::optional<std::vector<BudgetCut>>& cuts);

}  // namespace tern::python
