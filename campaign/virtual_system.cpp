#include "campaign/virtual_system.h"

#include <cstdlib>
#include <stdexcept>
#include <utility>

#include "estimator/app/estimator_node.h"
#include "executor/app/executor_node.h"
#include "mission/app/load_mission.h"
#include "mission/app/mission_node.h"
#include "planner/app/blocked_goal.h"
#include "planner/app/config_reader.h"
#include "planner/app/planner_node.h"
#include "predictor/app/predictor_config.h"
#include "predictor/app/predictor_node.h"
#include "runtime/config.h"
#include "runtime/process.h"
#include "runtime/scenario_file.h"
#include "runtime/timed_scenario.h"
#include "semantic_mapper/app/load_map.h"
#include "semantic_mapper/app/mapper_config.h"
#include "semantic_mapper/app/mapper_node.h"
#include "simulator/app/make_vehicle.h"
#include "simulator/app/simulator_config.h"
#include "simulator/app/simulator_node.h"

namespace tern {
namespace {

constexpr const char* kMissionProcess = "tern-mission";

}  // namespace

const char* to_string(Charge charge) { return charge == Charge::Cpu ? "cpu" : "counts"; }

struct VirtualSystem::Parts {
  Charge charge;
  Scenario scenario;
  ExecutorConfig executor;
  PredictorConfig predictor;
  EstimatorNodeConfig estimator;  ///< read if the vehicle flies on an estimate
  MapperConfig mapper;
  LoadedMap map;
  PlannerConfig planner;
  mission::MissionConfig mission;
  std::string goals_from;
  std::string effective_yaml;  ///< of the whole file

  Parts(ConfigDocument& document, Charge charge_)
      : charge(charge_),
        scenario(read_scenario(document)),
        executor(document.root().section("executor").read<ExecutorConfig>()),
        predictor(read_predictor_config(document.root().section("predictor"))),
        mapper(read_mapper_config(document)),
        map(load_map(scenario, mapper, std::getenv("TERN_DATA"))),
        planner(read_planner_config(document.root().section("planner"), scenario.semantics)),
        mission(mission::read_mission_config(document.root().section("mission"))) {}
};

VirtualSystem::VirtualSystem(const std::string& scenario_file, const std::vector<std::string>& overrides, Charge charge,
                             UTime begin, const std::optional<Key>& master)
    : runner_(begin) {
  runner_.use_key(master);
  ConfigDocument document = ConfigDocument::load(scenario_file, overrides);
  parts_ = std::make_unique<Parts>(document, charge);
  const Scenario& scenario = parts_->scenario;
  const SimulatorConfig config = read_simulator_config(document.root().section("simulator"), scenario.seed);
  parts_->goals_from = config.goals_from;
  const bool estimates = config.vio.has_value();
  if (estimates) parts_->estimator = document.root().section("estimator").read<EstimatorNodeConfig>();
  parts_->effective_yaml = document.effective();
  World world = flyable_world_of(scenario, config);
  simulator_ = static_cast<SimulatorNode*>(&runner_.start("tern-simulator", [&](Bus& bus) {
    auto vehicle = make_vehicle(scenario, config, bus.clock().now());
    return std::make_unique<SimulatorNode>(bus, scenario, std::move(world), std::move(vehicle), config);
  }));
  for (const char* process : {"tern-executor", "tern-predictor", "tern-mapper", "tern-planner"}) start(process);
  if (estimates) start("tern-estimator");
  if (config.goals_from == kMissionProcess) start(kMissionProcess);
}

VirtualSystem::~VirtualSystem() = default;

const Scenario& VirtualSystem::scenario() const { return parts_->scenario; }

Scenario VirtualSystem::timed_scenario() const { return timed(parts_->scenario, parts_->goals_from); }

void VirtualSystem::stop(const std::string& process) {
  if (process == "tern-simulator") throw std::invalid_argument("VirtualSystem: a flight is its simulator");
  runner_.stop(process);
}

void VirtualSystem::start(const std::string& process) {
  const auto make = [&](Bus& bus) -> std::unique_ptr<Node> {
    if (process == "tern-executor") return std::make_unique<ExecutorNode>(bus, parts_->scenario.uav, parts_->executor);
    if (process == "tern-predictor") return std::make_unique<PredictorNode>(bus, parts_->predictor);
    if (process == "tern-mapper") {
      const std::optional<Box> fenced = fenced_by_uploads(parts_->scenario, parts_->mapper);
      return std::make_unique<MapperNode>(bus, parts_->map.map, live_setup(parts_->scenario, parts_->mapper), fenced,
                                          warnings_of(parts_->map.remarks));
    }
    if (process == "tern-estimator") {
      return std::make_unique<EstimatorNode>(bus, parts_->estimator, parts_->scenario.uav.start);
    }
    if (process == kMissionProcess) {
      mission::MissionSetup setup;
      setup.mission = mission::load_mission(parts_->scenario, parts_->mission);
      setup.site = mission::site_of(parts_->scenario, parts_->mission.progress);
      setup.uav = parts_->scenario.uav;
      setup.config = parts_->mission.progress;
      setup.fence_uploads = parts_->mission.fence_uploads;
      return std::make_unique<mission::MissionNode>(bus, std::move(setup));
    }
    if (process != "tern-planner") throw std::invalid_argument("VirtualSystem: no process " + process);
    PlannerExecution execution;
    execution.threaded = false;
    execution.charge_cpu = parts_->charge == Charge::Cpu;
    return std::make_unique<PlannerNode>(bus, parts_->scenario.uav, parts_->planner,
                                         configuration_hash(parts_->effective_yaml), execution,
                                         named_places(parts_->scenario));
  };
  const Node& node = runner_.start(process, make, parts_->effective_yaml);
  if (process == "tern-executor") executor_ = static_cast<const ExecutorNode*>(&node);
}

}  // namespace tern
