#include "simulator/app/simulator_config.h"

#include <algorithm>
#include <sstream>

#include "runtime/class_densities.h"
#include "simulator/app/read_sensors.h"

namespace tern {
namespace {

/// Splits a text at spaces and commas.
std::vector<std::string> split_words(std::string text) {
  for (char& c : text) {
    if (c == ',') c = ' ';
  }
  std::istringstream stream(text);
  std::vector<std::string> words;
  for (std::string word; stream >> word;) words.push_back(word);
  return words;
}

void read_vehicle(ConfigSection& section, SimulatorConfig& config) {
  const std::string vehicle =
      section.choice("vehicle", "perfect", {"perfect", "quadrotor", "external"},
                     "`perfect`: follows its setpoints exactly; `quadrotor`: a body with motors, controller, wind and "
                     "estimator, by the next keys; `external`: an autopilot behind tern-mavlink");
  if (vehicle == "perfect") return;
  if (vehicle == "external") {
    config.external = true;
    for (const char* of_a_model : {"quadrotor", "wind", "estimator"}) section.ignore(of_a_model);
    return;
  }
  QuadrotorFlight flight;
  section.section("quadrotor").read(flight.quadrotor);
  section.section("wind").read(flight.wind);
  section.section("estimator").read(flight.estimator);
  config.quadrotor = flight;
}

VisualTag read_tag(ConfigSection section) {
  VisualTag tag;
  tag.position = section.required_vec3("position", Range::within(WorldObstacle::kMaxCoordinate),
                                       "place of a tag, W, m: a camera that sees it measures the vehicle's position");
  tag.range_m =
      section.number("range_m", tag.range_m, Range::positive(1000.0), "the tag is not recognized from farther away, m");
  tag.sigma_m = section.number("sigma_m", tag.sigma_m, Range::positive(100.0),
                               "standard deviation of the position per axis at the distance d: sigma_m + sigma_per_m "
                               "· d, m");
  tag.sigma_per_m =
      section.number("sigma_per_m", tag.sigma_per_m, Range::at_least(0.0, 10.0), "its part that grows with d");
  section.finish();
  return tag;
}

DarkSpan read_dark(ConfigSection section) {
  DarkSpan dark;
  dark.from_s = section.number("from_s", dark.from_s, Range::at_least(0.0, 1e5),
                               "the stereo camera sees nothing from this world time on, s");
  dark.to_s = section.number("to_s", dark.to_s, Range::positive(1e5), "until this one, s");
  section.finish();
  if (dark.to_s <= dark.from_s) throw section.error("to_s", "must be above from_s");
  return dark;
}

VioConfig read_vio(ConfigSection section) {
  VioConfig vio;
  vio.navigation.max_sigma_m = section.number(
      "max_sigma_m", vio.navigation.max_sigma_m, Range::positive(1000.0),
      "the vehicle does not follow while the position's standard deviation is above this, m: it comes to rest");
  section.section("imu").read(vio.navigation.imu);
  section.section("camera").read(vio.navigation.camera);
  ConfigSection landmarks = section.section("landmarks");
  vio.landmarks.regions = read_class_densities(landmarks.section("regions"), vio.landmarks.regions,
                                               LandmarkSpec::kMaxDensity, "landmarks per m² in regions of this class");
  landmarks.read(vio.landmarks);
  section.section("tracks").read(vio.tracks);
  for (const ConfigSection& entry : section.list("tags")) vio.tags.push_back(read_tag(entry));
  for (const ConfigSection& entry : section.list("dark")) vio.dark.push_back(read_dark(entry));
  section.finish();
  return vio;
}

/// Reads `estimation`, and with `vio` its section.
void read_estimation(ConfigSection& section, SimulatorConfig& config) {
  const std::string estimation =
      section.choice("estimation", "perfect", {"perfect", "vio"},
                     "`perfect`: the vehicle knows its state, up to the model's `estimator`; `vio`: tern-estimator "
                     "estimates it, by a simulated IMU and stereo camera");
  const bool is_vio = estimation == "vio";
  if (!is_vio && !section.has("vio")) return;
  const VioConfig vio = read_vio(section.section("vio"));  // checked even if it is not used
  if (!is_vio) return;
  config.vio = vio;
  const bool waits =
      std::find(config.wait_for.begin(), config.wait_for.end(), kEstimatorProcess) != config.wait_for.end();
  if (!config.wait_for.empty() && !waits) config.wait_for.emplace_back(kEstimatorProcess);
}

}  // namespace

SimulatorConfig read_simulator_config(ConfigSection section, std::uint64_t seed) {
  SimulatorConfig config;
  config.declare =
      section.flag("declare", config.declare, "publish DECLARED_MOTIONS; false: only the sensor shows the obstacles");
  const std::string needed =
      section.text("wait_for", "tern-executor, tern-predictor, tern-mapper, tern-planner",
                   "processes that must be ready before world time starts, separated by spaces or commas; `none`");
  config.wait_for = needed == "none" ? std::vector<std::string>{} : split_words(needed);
  config.wait = Duration::from_seconds(
      section.number("wait_s", config.wait.seconds(), Range::positive(3600.0),
                     "longest wait for the processes of `wait_for`, s; two rotations of the map are added"));
  config.max_clock_skew = Duration::from_seconds(section.number(
      "max_clock_skew_s", config.max_clock_skew.seconds(), Range::positive(10.0),
      "a process of `wait_for` is not ready if its clock differs by more than this from the vehicle's, s"));
  config.send_goal = section.flag("send_goal", config.send_goal,
                                  "publish the scenario's goal with id 1; false: another process publishes the GOAL");
  config.goals_from =
      section.text("goals_from", config.goals_from,
                   "process that sends the goals, as tern-mission: it is waited for, and the scenario's goal is not "
                   "sent. An arrival counts once it reports Finished; if it reports Failed the flight has not reached "
                   "its goal in time. Without `timeout_s` it alone decides that");
  if (!config.goals_from.empty()) {
    config.send_goal = false;
    config.wait_for.push_back(config.goals_from);
  }
  config.min_flight_s = section.number("min_flight_s", config.min_flight_s, Range::at_least(0.0, 1e5),
                                       "earliest arrival, world time, s: for a vehicle that guards its place");
  read_sensors(section, config, seed);
  read_vehicle(section, config);
  read_estimation(section, config);
  section.finish();
  if (config.vio && !config.quadrotor) {
    throw section.error("estimation", "vio needs a body that an IMU can measure: set simulator.vehicle=quadrotor");
  }
  return config;
}

}  // namespace tern
