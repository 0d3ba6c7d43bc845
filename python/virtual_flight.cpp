#include "python/virtual_flight.h"

#include <algorithm>
#include <map>
#include <tuple>
#include <utility>

#include "campaign/virtual_system.h"
#include "core/base/digest.h"
#include "core/world/body.h"
#include "messages/batching.h"
#include "messages/channels.h"
#include "monitor/app/subscribe_flight.h"
#include "planner/app/config_reader.h"
#include "planner/kept_field.h"
#include "planner/planner_build.h"
#include "runtime/batches.h"
#include "runtime/bus.h"
#include "runtime/config.h"
#include "runtime/node.h"
#include "runtime/process.h"
#include "runtime/scenario_file.h"

namespace tern::python {
namespace {

/// The longest flight of any scenario, virtual time.
constexpr Duration kMaxFlight{3600LL * 1'000'000};
/// Worlds of so many weights are kept: those that were used last.
constexpr std::size_t kWorldsKept = 8;

}  // namespace

/// The planner's place in the flight: it receives what a planner receives, and sends the caller's answers.
class SteppedPlanner final : public Node {
 public:
  SteppedPlanner(Bus& bus, const PlannerConfig& config, std::uint64_t configuration_hash)
      : bus_(bus), config_(config), configuration_hash_(configuration_hash) {
    bus.subscribe(channels::kPredictions, [this](const TrackSet& batch) { receive(batch); });
    bus.subscribe(channels::kSemanticMap, [this](const MapChunk& chunk) { receive(chunk); });
    bus.subscribe(channels::kGoal, [this](const Goal& goal) {
      if (!goal_ || goal.id >= goal_->id) goal_ = goal;
    });
    bus.subscribe(channels::kHorizonRequest, [this](const HorizonRequest& request) {
      open_ = request;
      asked_at_ = bus_.clock().now();
    });
  }

  [[nodiscard]] UTime next_wakeup() const override { return answer_ ? due_ : kNever; }
  void step(UTime now) override {
    if (!answer_ || now < due_) return;
    bus_.publish(channels::kPlan, *answer_);
    answer_.reset();
  }
  [[nodiscard]] NodeHealth health() const override {
    if (!predictions_) return {ProcessState::Waiting, "predictions"};
    if (!map_) return {ProcessState::Waiting, "a semantic map"};
    if (!goal_) return {ProcessState::Waiting, "a goal"};
    return {ProcessState::Ready, ""};
  }

  [[nodiscard]] const std::optional<HorizonRequest>& open() const { return open_; }
  void drop() { open_.reset(); }
  [[nodiscard]] const PlannerConfig& config() const { return config_; }

  void answer(Plan plan) {
    plan.inputs.configuration_hash = configuration_hash_;
    plan.inputs.planner_build = planner_build();
    answer_ = std::move(plan);
    due_ = asked_at_ + VirtualFlight::kAnswerLatency;
    open_.reset();
  }

  PreparedWorld world(const VirtualFlight::Weights& weights) {
    Fields& fields = fields_of(weights);
    PlanningWorld world;
    world.predictions = predictions_;
    if (map_) {
      if (!fields.map || fields.map->version != map_->version) {
        fields.map = std::make_shared<const MapProducts>(*map_, fields.config);
      }
      world.map = fields.map;
    }
    if (goal_ && goal_->mode != GoalMode::Go) {
      world.goal = std::make_shared<const GoalProducts>(GoalProducts{*goal_, {}, nullptr, {}});
    } else if (goal_ && map_ && predictions_) {
      world.goal = fields.goal = goal_of(fields);
    }
    return {std::move(world), fields.config, open_->start.p};
  }

 private:
  /// The products of one pair of weights.
  struct Fields {
    PlannerConfig config;
    std::shared_ptr<const MapProducts> map;
    std::shared_ptr<const GoalProducts> goal;
    KeptField kept = {};  // of goal
  };

  void receive(const TrackSet& batch) {
    auto set = batches_.add(batch);
    if (!set) return;
    TrackSet whole = join_batches(std::move(*set));
    statics_.add(whole);
    predictions_ = std::make_shared<const PredictionProducts>(std::move(whole));
  }
  void receive(const MapChunk& chunk) {
    if (assembler_.add(chunk).value_or(false)) map_ = assembler_.take();
  }

  Fields& fields_of(const VirtualFlight::Weights& weights) {
    const std::pair key(weights.attractive, weights.repulsive);
    const auto known = std::ranges::find(fields_, key, &std::pair<std::pair<double, double>, Fields>::first);
    if (known != fields_.end()) {
      std::rotate(known, known + 1, fields_.end());
      return fields_.back().second;
    }
    if (fields_.size() == kWorldsKept) fields_.erase(fields_.begin());
    Fields made;
    made.config = config_;
    made.config.lambda_attractive = weights.attractive;
    made.config.lambda_repulsive = weights.repulsive;
    return fields_.emplace_back(key, std::move(made)).second;
  }

  /// Makes the field of distances again if goal, map, static tracks or the vehicle's box are new.
  std::shared_ptr<const GoalProducts> goal_of(Fields& fields) const {
    const GoalFieldKey key{goal_->position,   fields.map->version,
                           statics_.digest(), body_box(grown(open_->body, open_->tube)),
                           open_->flight_box, way_speed(*fields.map, open_->limits)};
    if (fields.goal && fields.goal->field && serves(fields.kept, key, statics_.boxes())) {
      return std::make_shared<const GoalProducts>(
          GoalProducts{*goal_, fields.goal->key, fields.goal->field, fields.goal->made_from});
    }
    const GoalFieldInputs from{fields.map->version, statics_.epoch_us(), statics_.first_set(), statics_.digest(),
                               open_->header.name};
    fields.kept = make_kept_field(key, fields.map, statics_.boxes(), open_->start.p);
    return std::make_shared<const GoalProducts>(GoalProducts{*goal_, fields.kept.key, fields.kept.field, from});
  }

  Bus& bus_;
  PlannerConfig config_;
  std::uint64_t configuration_hash_;
  BatchCollector<TrackSet> batches_;
  MapAssembler assembler_;
  StaticTracks statics_;
  std::shared_ptr<const PredictionProducts> predictions_;
  std::optional<VoxelMap> map_;
  std::optional<Goal> goal_;
  std::optional<HorizonRequest> open_;
  UTime asked_at_, due_;
  std::optional<Plan> answer_;                                        ///< that is not due yet
  std::vector<std::pair<std::pair<double, double>, Fields>> fields_;  ///< by weights, the last used one last
};

VirtualFlight::VirtualFlight(const std::string& scenario_file, const std::vector<std::string>& settings)
    : system_(std::make_unique<VirtualSystem>(scenario_file, settings)) {
  ConfigDocument document = ConfigDocument::load(scenario_file, settings);
  const Scenario scenario = read_scenario(document);
  const PlannerConfig config = read_planner_config(document.root().section("planner"), scenario.semantics);
  const std::string yaml = document.effective();
  system_->stop("tern-planner");
  planner_ = static_cast<SteppedPlanner*>(&system_->runner().start(
      "tern-planner", [&](Bus& bus) { return std::make_unique<SteppedPlanner>(bus, config, configuration_hash(yaml)); },
      yaml));
  watch_ = std::make_unique<FlightWatch>(system_->timed_scenario(), system_->runner().now());
  subscribe_flight(system_->runner().observer(), *watch_);
}

// The bus calls the watch: it ends first.
VirtualFlight::~VirtualFlight() { system_.reset(); }

bool VirtualFlight::advance() {
  if (ending_) return false;
  planner_->drop();
  VirtualRunner& runner = system_->runner();
  const auto stops = [&] { return planner_->open() || (ending_ = watch_->ending(runner.now())); };
  const RunResult run = runner.run(runner.now() + kMaxFlight, stops);
  if (run.end == RunEnd::Finished && !ending_) ending_ = {FlightOutcome::Failed, run.process + " ended"};
  if (run.end == RunEnd::Time) ending_ = {FlightOutcome::Failed, "no end within an hour"};
  return !ending_;
}

const HorizonRequest& VirtualFlight::request() const {
  if (!planner_->open()) throw std::logic_error("no request is open; the flight waits for advance(), or has ended");
  return *planner_->open();
}

VirtualFlight::Weights VirtualFlight::weights() const {
  return {planner_->config().lambda_attractive, planner_->config().lambda_repulsive};
}

PreparedWorld VirtualFlight::world(const Weights& weights) {
  (void)request();
  if (!(weights.attractive >= 0.0 && weights.repulsive >= 0.0)) {
    throw std::invalid_argument("weights: λ must be 0 or more");
  }
  return planner_->world(weights);
}

void VirtualFlight::answer(const Plan& plan) {
  if (plan.request_id != request().id) {
    throw std::invalid_argument("the answer is to request " + std::to_string(plan.request_id) + ", and request " +
                                std::to_string(request().id) + " is open");
  }
  planner_->answer(plan);
}

UTime VirtualFlight::now() const { return system_->runner().now(); }

std::optional<FlightResult> VirtualFlight::result() const {
  return ending_ ? watch_->summary(*ending_).result : std::nullopt;
}

}  // namespace tern::python
