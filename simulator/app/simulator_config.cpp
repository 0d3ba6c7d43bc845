#include "simulator/app/simulator_config.h"

#include <sstream>

namespace tern {
namespace {

/// Of what happens again and again, Hz: periods stay far from the end of time.
constexpr double kLeastRate = 1e-3;

/// The words of a text that spaces or commas separate.
std::vector<std::string> words_of(std::string text) {
  for (char& c : text) {
    if (c == ',') c = ' ';
  }
  std::istringstream stream(text);
  std::vector<std::string> words;
  for (std::string word; stream >> word;) words.push_back(word);
  return words;
}

SensorConfig read_sensor(ConfigSection section, std::uint64_t seed) {
  const std::string mode = section.choice("mode", "truth", {"truth", "noisy"});
  SensorConfig sensor;
  sensor.seed = seed;
  if (mode == "noisy") {
    sensor = perception_only(seed);
    sensor.range_m = section.number("range_m", sensor.range_m, Range::at_least(0.0, 1e5));
    sensor.sigma_m = Vec3::Constant(section.number("sigma_m", sensor.sigma_m.x(), Range::at_least(0.0, 100.0)));
    sensor.latency_s = section.number("latency_s", sensor.latency_s, Range::at_least(0.0, 2.0));
    sensor.dropout = section.number("dropout", sensor.dropout, Range::at_least(0.0, 1.0));
    sensor.track_ids = section.flag("ids", sensor.track_ids);
  }
  sensor.rate_hz = section.number("rate_hz", sensor.rate_hz, Range::at_least(kLeastRate, 100.0));
  section.finish();
  return sensor;
}

}  // namespace

SimulatorConfig read_simulator_config(ConfigSection section, std::uint64_t seed) {
  SimulatorConfig config;
  config.declare = section.flag("declare", config.declare);
  const std::string needed = section.text("wait_for", "tern-predictor, tern-mapper, tern-planner");
  config.wait_for = needed == "none" ? std::vector<std::string>{} : words_of(needed);
  config.wait = Duration::from_seconds(section.number("wait_s", config.wait.seconds(), Range::positive(3600.0)));
  config.max_clock_skew = Duration::from_seconds(
      section.number("max_clock_skew_s", config.max_clock_skew.seconds(), Range::positive(10.0)));
  config.send_goal = section.flag("send_goal", config.send_goal);
  config.min_flight_s = section.number("min_flight_s", config.min_flight_s, Range::at_least(0.0, 1e5));
  config.sensor = read_sensor(section.section("sensor"), seed);
  section.finish();
  return config;
}

ExecutorConfig read_executor_config(ConfigSection section) {
  ExecutorConfig config;
  config.rate_hz = section.number("rate_hz", config.rate_hz, Range::at_least(kLeastRate, 100.0));
  config.lead = Duration::from_seconds(section.number("lead_s", config.lead.seconds(), Range::at_least(0.01, 2.0)));
  section.finish();
  return config;
}

}  // namespace tern
