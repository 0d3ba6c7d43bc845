#include "tools/replay/world_rebuilder.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <string_view>

#include "core/world/body.h"
#include "planner/app/config_reader.h"
#include "planner/kept_field.h"
#include "runtime/config.h"
#include "runtime/scenario_file.h"

namespace tern {
namespace {

/// Number of cached cost-to-go fields: a plan names the newest one or the one before.
constexpr std::size_t kFieldsKept = 4;

std::string text(const MessageName& name) {
  return fmt::format("{} of sender {}", name.sequence, name.sender_epoch_us);
}

/// The settings that plan() reads; the rest of a scenario reaches it in messages.
constexpr std::string_view kPlannedWith[] = {
    "planner",           "semantics.enabled", "semantics.lambda_attractive", "semantics.lambda_repulsive",
    "semantics.lambdas", "semantics.cost"};

/// Returns true if a key is this one, or below it.
bool is_within(std::string_view key, std::string_view above) {
  return key.starts_with(above) && (key.size() == above.size() || key[above.size()] == '.');
}

/// The mark at the end of a configuration that was too long to report (reported_yaml).
bool is_cut(const std::string& yaml) { return yaml.find("\n# cut here: ") != std::string::npos; }

/// A configuration of the log, with changed settings.
struct OwnSettings {
  Scenario scenario;
  PlannerConfig config;
};

/// @param with_planner  false: the planner's section is not read @throws ConfigError
OwnSettings read_own(const std::string& yaml, const std::vector<std::string>& settings, bool with_planner) {
  auto document = ConfigDocument::parse(yaml, "the log's configuration", settings);
  OwnSettings own{read_scenario(document), {}};
  if (with_planner) own.config = read_planner_config(document.root().section("planner"), own.scenario.semantics);
  return own;
}

/// Returns why this version cannot read a configuration of the log; empty if it can.
std::string why_unreadable(const std::string& yaml, bool with_planner) {
  try {
    (void)read_own(yaml, {}, with_planner);
  } catch (const ConfigError& error) {
    return error.what();
  }
  return "";
}

}  // namespace

void OtherSettings::check() const {
  for (const std::string& setting : settings) {
    const std::string_view key = std::string_view(setting).substr(0, setting.find('='));
    const bool planned_with = std::any_of(std::begin(kPlannedWith), std::end(kPlannedWith),
                                          [key](std::string_view above) { return is_within(key, above); });
    if (planned_with) continue;
    throw ConfigError(
        fmt::format("--set {}: has no effect on a replay, which repeats recorded requests; it "
                    "takes {}",
                    setting, fmt::join(kPlannedWith, ", ")));
  }
}

WorldRebuilder::WorldRebuilder(const RecordedInputs& inputs, OtherSettings other)
    : inputs_(inputs), other_(std::move(other)) {
  for (const RecordedPlan& recorded : inputs.plans) {
    const GoalFieldInputs& names = recorded.plan.inputs.goal_field;
    if (names.map_version == 0) continue;
    statics_.emplace(tracks_of(names), std::nullopt);
    if (names.statics_epoch_us != 0) memories_[{names.statics_epoch_us, names.statics_first_set}];
  }
  statics_[StaticTracks().digest()].emplace();
}

void WorldRebuilder::add(TrackSet set) {
  for (auto& [key, memory] : memories_) {
    const auto [epoch_us, first_set] = key;
    if (epoch_us != set.header.name.sender_epoch_us || set.batch.set < first_set) continue;
    if (!memory.add(set)) continue;
    const auto named = statics_.find(memory.digest());
    if (named != statics_.end()) named->second = memory.obstacles();
  }
  predictions_ = std::make_shared<const PredictionProducts>(std::move(set));
}

Result<WorldRebuilder::Configuration*> WorldRebuilder::configuration_of(std::uint64_t hash) {
  const auto known = configurations_.find(hash);
  if (known != configurations_.end()) return &known->second;
  const auto report = inputs_.configurations.find(hash);
  if (report == inputs_.configurations.end()) return fail(fmt::format("configuration {:016x}", hash));
  if (is_cut(report->second.yaml)) return fail(fmt::format("the complete configuration {:016x}", hash));
  const bool own = other_.file.empty();
  const auto [read, is_new] = unreadable_.try_emplace(hash);
  if (is_new) read->second = why_unreadable(report->second.yaml, own);
  if (!read->second.empty()) {
    return fail(fmt::format("configuration {:016x} in a form that this version reads ({})", hash, read->second));
  }
  Configuration made;
  const auto [scenario, config] =
      read_own(report->second.yaml, own ? other_.settings : std::vector<std::string>(), own);
  made.uav = scenario.uav;
  if (own) {
    made.config = config;
  } else {
    auto file = ConfigDocument::load(other_.file, other_.settings);
    const Scenario others = read_scenario(file);
    made.config = read_planner_config(file.root().section("planner"),
                                      file.root().has("semantics") ? others.semantics : scenario.semantics);
  }
  return &configurations_.emplace(hash, std::move(made)).first->second;
}

Result<std::shared_ptr<const MapProducts>> WorldRebuilder::map_of(std::uint64_t version, Configuration& configuration) {
  const auto known = configuration.maps.find(version);
  if (known != configuration.maps.end()) return known->second;
  const auto map = inputs_.maps.find(version);
  if (map == inputs_.maps.end()) return fail(fmt::format("map {:016x}", version));
  auto products = std::make_shared<const MapProducts>(map->second, configuration.config);
  configuration.maps.emplace(version, products);
  return products;
}

std::shared_ptr<const GoalField> WorldRebuilder::field_of(const GoalFieldKey& key, const Vec3& start,
                                                          const std::shared_ptr<const MapProducts>& map,
                                                          const PathObstacles& statics) {
  for (const Field& known : fields_) {
    if (known.key == key && known.map == map && known.start == start) return known.field;
  }
  if (fields_.size() == kFieldsKept) fields_.erase(fields_.begin());
  auto field = make_kept_field(key, map, statics, start).field;
  fields_.push_back({key, map, start, field});
  return field;
}

const LandmarkDensities* WorldRebuilder::densities_of(const GoalFieldInputs& names) const {
  const auto known = inputs_.densities.find(names.statics);
  return known == inputs_.densities.end() ? nullptr : &known->second;
}

std::uint64_t WorldRebuilder::tracks_of(const GoalFieldInputs& names) const {
  const LandmarkDensities* densities = densities_of(names);
  return densities == nullptr ? names.statics : densities->tracks;
}

Result<std::shared_ptr<const GoalProducts>> WorldRebuilder::goal_of(const PlanInputs& names,
                                                                    Configuration& configuration) {
  const GoalFieldInputs& from = names.goal_field;
  const auto goal = inputs_.goals.find(names.goal);
  if (goal == inputs_.goals.end()) return fail("goal " + text(names.goal));
  // A plan may name no cost-to-go, or that of an earlier goal: hold and stop do not read it.
  if (goal->second.mode != GoalMode::Go) {
    return std::make_shared<const GoalProducts>(GoalProducts{goal->second, {}, nullptr, from});
  }
  const auto map = map_of(from.map_version, configuration);
  if (!map) return tl::make_unexpected(map.error());
  const LandmarkDensities* densities = densities_of(from);
  const auto statics = statics_.find(tracks_of(from));
  if (statics == statics_.end() || !statics->second) {
    const bool may_learn = configuration.config.error_price.learn_densities && densities == nullptr;
    return fail(fmt::format("static tracks {:016x} of predictor {} from set {} on{}", from.statics,
                            from.statics_epoch_us, from.statics_first_set,
                            may_learn ? ", or the LANDMARK_DENSITIES of that name" : ""));
  }
  GoalFieldKey key{goal->second.position,
                   from.map_version,
                   statics->first,
                   body_box(configuration.uav.body),
                   configuration.uav.flight_box,
                   way_speed(**map, configuration.uav.limits),
                   statics->second->map_margin,
                   {}};
  if (densities != nullptr && configuration.config.error_price.learn_densities) key.densities = densities->densities;
  Vec3 start = configuration.uav.start;
  if (from.vehicle != MessageName{}) {
    const auto request = inputs_.requests.find(from.vehicle);
    if (request == inputs_.requests.end()) return fail("request " + text(from.vehicle) + " (for the path to the goal)");
    key.body = body_box(grown(request->second.body, request->second.tube));
    key.flight_box = request->second.flight_box;
    key.speed = way_speed(**map, request->second.limits);
    start = request->second.start.p;
  }
  auto field = field_of(key, start, *map, *statics->second);
  return std::make_shared<const GoalProducts>(GoalProducts{goal->second, key, std::move(field), from});
}

std::shared_ptr<const UnseenKnowledge> WorldRebuilder::unseen_of(const Plan& plan, const Configuration& configuration) {
  const auto before = inputs_.frames_before.find(plan.inputs.request);
  const std::size_t until = before == inputs_.frames_before.end() ? 0 : before->second;
  if (!watch_ || until < next_frame_) {
    watch_.emplace(configuration.config.unseen_movers, configuration.uav.start);
    next_frame_ = 0;
  }
  for (; next_frame_ < until; ++next_frame_) watch_->add(inputs_.frames[next_frame_]);
  return std::make_shared<const UnseenKnowledge>(watch_->knowledge());
}

Result<PlanProblem> WorldRebuilder::problem_of(const Plan& plan) {
  const PlanInputs& names = plan.inputs;
  PlanProblem problem;
  const auto request = inputs_.requests.find(names.request);
  if (request == inputs_.requests.end()) return fail("request " + text(names.request));
  problem.request = request->second;
  const auto configuration = configuration_of(names.configuration_hash);
  if (!configuration) return tl::make_unexpected(configuration.error());
  problem.config = (*configuration)->config;
  problem.heading = (*configuration)->uav.heading;
  if (names.predictions != MessageName{}) {
    const bool there = predictions_ && predictions_->set.batch.set == names.prediction_set &&
                       predictions_->set.header.name.sender_epoch_us == names.predictions.sender_epoch_us;
    if (!there) {
      return fail(
          fmt::format("prediction set {} of sender {}", names.prediction_set, names.predictions.sender_epoch_us));
    }
    problem.world.predictions = predictions_;
  }
  if (problem.config.unseen == UnseenMode::Passive) {
    problem.world.unseen = unseen_of(plan, **configuration);
  }
  if (names.map_version != 0) {
    auto map = map_of(names.map_version, **configuration);
    if (!map) return tl::make_unexpected(map.error());
    problem.world.map = std::move(*map);
  }
  if (names.goal != MessageName{}) {
    auto goal = goal_of(names, **configuration);
    if (!goal) return tl::make_unexpected(goal.error());
    problem.world.goal = std::move(*goal);
  }
  return problem;
}

}  // namespace tern
