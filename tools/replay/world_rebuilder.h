// From the names in a plan to the request, world and configuration that it was made from.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/base/result.h"
#include "core/world/scenario.h"
#include "planner/planning_world.h"
#include "planner/problem/planner_config.h"
#include "planner/static_tracks.h"
#include "tools/replay/recorded_inputs.h"

namespace tern {

/// All that plan() is given, but for the budget.
struct PlanProblem {
  HorizonRequest request;
  PlanningWorld world;
  PlannerConfig config;
};

/// Settings in place of those of the log.
struct OtherSettings {
  std::string file;                   ///< a scenario file whose `planner:` (and `semantics:`, if it has one) holds; ""
  std::vector<std::string> settings;  ///< "planner.search.samples_xy=5": over the file's, or over the log's own
  [[nodiscard]] bool empty() const { return file.empty() && settings.empty(); }
  /// @throws ConfigError for a setting that has no effect in a replay. Planned with are `planner` and, of `semantics`,
  /// enabled, lambda_attractive, lambda_repulsive, lambdas and cost. All else stands in the recorded messages.
  void check() const;
};

/// Prediction sets are given one after the other; a plan can be rebuilt from when its set was given until the next is.
/// What takes long (fields of maps, distances to goals) is made once and kept.
class WorldRebuilder {
 public:
  /// @param inputs  outlives this object
  WorldRebuilder(const RecordedInputs& inputs, OtherSettings other);

  /// The next complete set of any predictor, in the log's order: static tracks are remembered as planners do.
  void add(TrackSet set);

  /// @return an Error that names what the log does not hold.
  Result<PlanProblem> problem_of(const Plan& plan);

 private:
  struct Configuration {
    PlannerConfig config;
    UavSpec uav;
    std::map<std::uint64_t, std::shared_ptr<const MapProducts>> maps;
  };
  struct Field {
    GoalFieldKey key;
    std::shared_ptr<const MapProducts> map;  ///< of one configuration, whose weights the field knows
    Vec3 start;
    std::shared_ptr<const GoalField> field;
  };
  Result<Configuration*> configuration_of(std::uint64_t hash);
  Result<std::shared_ptr<const MapProducts>> map_of(std::uint64_t version, Configuration& configuration);
  Result<std::shared_ptr<const GoalProducts>> goal_of(const PlanInputs& names, Configuration& configuration);
  std::shared_ptr<const GoalField> field_of(const GoalFieldKey& key, const Vec3& start,
                                            const std::shared_ptr<const MapProducts>& map,
                                            const std::vector<Box>& statics);

  const RecordedInputs& inputs_;
  OtherSettings other_;
  std::map<std::uint64_t, Configuration> configurations_;  ///< by hash
  std::vector<Field> fields_;                              ///< the newest last
  std::shared_ptr<const PredictionProducts> predictions_;
  std::map<std::pair<std::int64_t, std::int64_t>, StaticTracks> memories_;  ///< by epoch and first set
  /// Those that plans name, by digest; nullopt: not met yet.
  std::map<std::uint64_t, std::optional<std::vector<Box>>> statics_;
};

}  // namespace tern
