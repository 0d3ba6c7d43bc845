// The section `simulator:` of a scenario file (simulator/README.md lists the keys).
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "runtime/config.h"
#include "simulator/app/start_gate.h"
#include "simulator/sensors/sensor.h"
#include "simulator/vehicle/quadrotor_vehicle.h"

namespace tern {

struct SimulatorConfig {
  bool declare = true;  ///< publish DECLARED_MOTIONS; false: perception only
  /// World time waits for these.
  std::vector<std::string> wait_for = {"tern-executor", "tern-predictor", "tern-mapper", "tern-planner"};
  Duration wait{15'000'000};                ///< for so long, then the flight has failed, > 0
  Duration max_clock_skew = kMaxClockSkew;  ///< of these from the vehicle's, > 0
  bool send_goal = true;      ///< send the scenario's goal; false: the mission waits for a GOAL of someone else
  double min_flight_s = 0.0;  ///< an arrival counts only from this world time on, ≥ 0 (a vehicle that guards a place)
  SensorConfig sensor;
  std::optional<QuadrotorFlight> quadrotor;  ///< nullopt: the perfect vehicle, or an external one
  bool external = false;                     ///< others fly it and say its state
};

/// Reads and finishes the section. `seed` seeds the sensor's noise. @throws ConfigError.
SimulatorConfig read_simulator_config(ConfigSection section, std::uint64_t seed);

}  // namespace tern
