#include "campaign/flight_inputs.h"

#include <fmt/format.h>

#include <cstdlib>
#include <filesystem>
#include <set>

#include "detector/app/detector_node.h"
#include "estimator/app/estimator_node.h"
#include "executor/executor.h"
#include "logger/app/logger_node.h"
#include "mavlink/bridge_config.h"
#include "mavlink/sim/simulated_autopilot.h"
#include "mission/app/mission_config.h"
#include "planner/app/config_reader.h"
#include "predictor/app/predictor_config.h"
#include "runtime/data_folder.h"
#include "runtime/process.h"
#include "runtime/scenario_file.h"
#include "runtime/version.h"
#include "semantic_mapper/app/mapper_config.h"
#include "simulator/app/simulator_config.h"
#include "simulator/app/world_broadcast.h"

namespace tern {
namespace {

namespace fs = std::filesystem;

std::vector<fs::path> scenario_folders() {
  std::error_code error;
  const fs::path programs = fs::read_symlink("/proc/self/exe", error).parent_path();
  return {"scenarios", programs / ".." / ".." / ".." / "scenarios", programs / ".." / "share" / "tern" / "scenarios"};
}

/// Reads the sections of a campaign's processes, as these processes would.
MapperConfig read_sections(ConfigDocument& document, const Scenario& scenario) {
  ConfigSection root = document.root();
  const bool has_estimator = read_simulator_config(root.section("simulator"), scenario.seed).vio.has_value();
  if (has_estimator) (void)root.section("estimator").read<EstimatorNodeConfig>();
  (void)root.section("executor").read<ExecutorConfig>();
  (void)read_predictor_config(root.section("predictor"));
  (void)read_planner_config(root.section("planner"), scenario.semantics);
  (void)mission::read_mission_config(root.section("mission"));
  return read_mapper_config(document);
}

/// Returns overrides that name the mapper's files by absolute paths.
std::vector<std::string> absolute_sources(const MapperConfig& mapper, const std::string& scenario_file) {
  const fs::path data = data_folder(scenario_file, std::getenv("TERN_DATA"));
  std::vector<std::string> overrides;
  for (std::size_t k = 0; k < mapper.sources.size(); ++k) {
    for (const fs::path& folder : {fs::path(scenario_file).parent_path(), data}) {
      std::error_code error;
      const fs::path file = fs::absolute(folder / mapper.sources[k].file, error).lexically_normal();
      if (!fs::is_regular_file(file, error)) continue;
      overrides.push_back(fmt::format("mapper.sources[{}].file={}", k, file.string()));
      break;
    }
  }
  return overrides;
}

}  // namespace

std::vector<std::string> FlightInputs::with_seed(std::uint64_t seed) const {
  std::vector<std::string> all = overrides;
  all.push_back(fmt::format("seed={}", seed));
  return all;
}

Result<std::string> find_scenario(const std::string& wanted) {
  if (fs::is_regular_file(wanted)) return wanted;
  std::set<std::string> names;
  for (const fs::path& folder : scenario_folders()) {
    for (const std::string& file : {wanted + ".yaml", wanted}) {
      if (fs::is_regular_file(folder / file)) return (folder / file).lexically_normal().string();
    }
    std::error_code error;
    for (const auto& entry : fs::directory_iterator(folder, error)) {
      if (entry.path().extension() == ".yaml") names.insert(entry.path().stem().string());
    }
  }
  std::string list;
  for (const std::string& name : names) list += " " + name;
  return fail(fmt::format("no scenario {}; there are:{}", wanted, list.empty() ? " none" : list));
}

void read_every_section(ConfigDocument& document) {
  (void)read_sections(document, read_scenario(document));
  ConfigSection root = document.root();
  (void)read_logger_config(root.section("logger"));
  (void)root.section("detector").read<DetectorConfig>();
  (void)root.section("estimator").read<EstimatorNodeConfig>();
  (void)root.section("mavlink").read<mavlink::BridgeConfig>();
  (void)root.section("autopilot_sim").read<mavlink::SimulatedAutopilotConfig>();
}

CampaignIdentity check_inputs(const FlightInputs& inputs, std::uint64_t seed) {
  // A separate document: the configuration of a campaign is that of the processes that fly in it.
  ConfigDocument all = ConfigDocument::load(inputs.scenario_file, inputs.with_seed(0));
  read_every_section(all);
  ConfigDocument document = ConfigDocument::load(inputs.scenario_file, inputs.with_seed(0));
  Scenario scenario = read_scenario(document);
  (void)read_sections(document, scenario);
  scenario.seed = seed;
  (void)world_of(scenario);
  return {scenario.name, scenario.world.count, to_string(inputs.charge),
          fmt::format("{:016x}", configuration_hash(document.effective())), build_id()};
}

/// Returns a file's path; a relative one is beside the scenario.
std::string beside(const std::string& scenario_file, const std::string& file) {
  return fs::absolute(fs::path(scenario_file).parent_path() / file).lexically_normal().string();
}

std::string spell_out(const FlightInputs& inputs, std::uint64_t seed) {
  std::vector<std::string> overrides = inputs.with_seed(seed);
  ConfigDocument document = ConfigDocument::load(inputs.scenario_file, overrides);
  Scenario scenario = read_scenario(document);
  const MapperConfig mapper = read_sections(document, scenario);
  for (FenceFile& fences : scenario.world.fence_files) fences.file = beside(inputs.scenario_file, fences.file);
  const std::string mission = mission::read_mission_config(document.root().section("mission")).file;
  if (!mission.empty()) overrides.push_back("mission.file=" + beside(inputs.scenario_file, mission));
  const std::vector<std::string> absolute = absolute_sources(mapper, inputs.scenario_file);
  overrides.insert(overrides.end(), absolute.begin(), absolute.end());
  // A document prints only the sections that were read.
  ConfigDocument sections = ConfigDocument::load(inputs.scenario_file, overrides);
  (void)read_sections(sections, scenario);
  return write_scenario(list_obstacles(scenario, world_of(scenario))) + sections.effective();
}

}  // namespace tern
