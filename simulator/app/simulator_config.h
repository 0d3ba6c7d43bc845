// The section `simulator:` of a scenario file (docs/reference/keys.md lists the keys).
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "runtime/config.h"
#include "simulator/app/start_gate.h"
#include "simulator/inertial/tags.h"
#include "simulator/inertial/track_simulator.h"
#include "simulator/sensors/depth_sensor.h"
#include "simulator/sensors/sensor.h"
#include "simulator/vehicle/quadrotor_vehicle.h"

namespace tern {

/// An entry of `simulator.vio.dark`: the stereo camera delivers black pictures at world times in [from_s, to_s).
struct DarkSpan {
  double from_s = 0.0, to_s = 1e5;
};

/// The section `simulator.vio`: IMU, cameras and what they see. Only with `estimation: vio`.
struct VioConfig {
  NavigationSetup navigation;
  LandmarkSpec landmarks;
  TrackSpec tracks;
  std::vector<VisualTag> tags;
  std::vector<DarkSpan> dark;
};

/// The process that estimates the vehicle's state with `estimation: vio`.
inline constexpr const char* kEstimatorProcess = "tern-estimator";

struct SimulatorConfig {
  bool declare = true;  ///< publish DECLARED_MOTIONS; false: perception only
  /// Processes that world time waits for.
  std::vector<std::string> wait_for = {"tern-executor", "tern-predictor", "tern-mapper", "tern-planner"};
  Duration wait{15'000'000};                ///< time to wait for them, > 0; after it the flight has failed
  Duration max_clock_skew = kMaxClockSkew;  ///< allowed difference of their clocks from the vehicle's, > 0
  bool send_goal = true;      ///< publish the scenario's goal; false: the flight waits for a GOAL of another process
  std::string goals_from;     ///< the process that sends the goals, as tern-mission does; "": none of its own
  double min_flight_s = 0.0;  ///< earliest arrival, world time, s, ≥ 0: for a vehicle that guards a place
  SensorConfig sensor;
  /// The vehicle's sensors; they replace `sensor`. A DepthSensorConfig is a camera or a lidar.
  std::vector<std::variant<SensorConfig, DepthSensorConfig>> sensors;
  std::optional<double> ground_z;            ///< W, m; nullopt: cameras and lidars see no ground
  std::uint64_t seed = 1;                    ///< of the sensors' noise
  std::optional<QuadrotorFlight> quadrotor;  ///< nullopt: the perfect vehicle, or an external one
  bool external = false;                     ///< other processes fly the vehicle and publish its state
  std::optional<VioConfig> vio;  ///< the vehicle flies on the estimate of tern-estimator; nullopt: by the model's own
};

/// Reads the section and refuses unknown keys. `seed` seeds the sensor's noise. @throws ConfigError.
SimulatorConfig read_simulator_config(ConfigSection section, std::uint64_t seed);

}  // namespace tern
