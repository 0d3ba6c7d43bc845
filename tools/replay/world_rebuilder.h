// Rebuilds the inputs of a plan from the names that the plan carries.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/base/result.h"
#include "core/scenario/scenario.h"
#include "planner/planning_world.h"
#include "planner/problem/planner_config.h"
#include "planner/static_tracks.h"
#include "tools/replay/recorded_inputs.h"

namespace tern {

/// The arguments of plan(), except the budget.
struct PlanProblem {
  HorizonRequest request;
  PlanningWorld world;
  PlannerConfig config;
  HeadingLimits heading;  ///< for its PLAN_HEADING
};

/// Settings that replace those of the log.
struct OtherSettings {
  std::string file;  ///< a scenario file whose `planner:` section (and `semantics:`, if present) applies; may be empty
  std::vector<std::string>
      settings;  ///< "planner.search.samples_xy=5": overrides the file, or the log's settings if no file is given
  [[nodiscard]] bool empty() const { return file.empty() && settings.empty(); }
  /// Effective settings are those of `planner`, and of `semantics`: enabled, lambda_attractive, lambda_repulsive,
  /// lambdas and cost. Everything else is part of the recorded messages.
  /// @throws ConfigError for a setting that has no effect in a replay
  void check() const;
};

/// Receives the prediction sets one after the other. A plan can be rebuilt between its own set and the next one. Map
/// fields and cost-to-go take long; they are computed once and cached.
class WorldRebuilder {
 public:
  /// @param inputs  outlives this object
  WorldRebuilder(const RecordedInputs& inputs, OtherSettings other);

  /// Adds the next complete set of any predictor, in the log's order. Static tracks are remembered as planners do.
  void add(TrackSet set);

  /// Returns the inputs of a plan. @return an Error that names the inputs that the log lacks, or has in a form that
  /// this version cannot read. @throws ConfigError for other settings that the planner refuses
  ///
  /// A plan names no frames of OBSTACLE_SIGHTINGS. Its field of unseen movers is made from those that the log has
  /// before its request. In a live flight, a frame that came within a millisecond of the request may be on the other
  /// side.
  Result<PlanProblem> problem_of(const Plan& plan);

 private:
  struct Configuration {
    PlannerConfig config;
    UavSpec uav;
    std::map<std::uint64_t, std::shared_ptr<const MapProducts>> maps;
  };
  struct Field {
    GoalFieldKey key;
    std::shared_ptr<const MapProducts> map;  ///< of one configuration: the field depends on its weights
    Vec3 start;
    std::shared_ptr<const GoalField> field;
  };
  Result<Configuration*> configuration_of(std::uint64_t hash);
  Result<std::shared_ptr<const MapProducts>> map_of(std::uint64_t version, Configuration& configuration);
  /// The LANDMARK_DENSITIES that a goal field names; null: it has those of the labels.
  [[nodiscard]] const LandmarkDensities* densities_of(const GoalFieldInputs& names) const;
  [[nodiscard]] std::uint64_t tracks_of(const GoalFieldInputs& names) const;
  Result<std::shared_ptr<const GoalProducts>> goal_of(const PlanInputs& names, Configuration& configuration);
  std::shared_ptr<const UnseenKnowledge> unseen_of(const Plan& plan, const Configuration& configuration);
  std::shared_ptr<const GoalField> field_of(const GoalFieldKey& key, const Vec3& start,
                                            const std::shared_ptr<const MapProducts>& map,
                                            const PathObstacles& statics);

  const RecordedInputs& inputs_;
  OtherSettings other_;
  std::map<std::uint64_t, Configuration> configurations_;  ///< by hash
  std::map<std::uint64_t, std::string> unreadable_;        ///< by hash: why this version cannot read it; empty: it can
  std::vector<Field> fields_;                              ///< the newest last
  std::shared_ptr<const PredictionProducts> predictions_;
  std::map<std::pair<std::int64_t, std::int64_t>, StaticTracks> memories_;  ///< by sender epoch and first set
  std::optional<UnseenWatch> watch_;                                        ///< with the frames before next_frame_
  std::size_t next_frame_ = 0;
  /// The static tracks that plans name, by digest; nullopt: not seen yet.
  std::map<std::uint64_t, std::optional<PathObstacles>> statics_;
};

}  // namespace tern
