// Compares what a scenario asks of its sensor and its vehicle with what these can do.
#pragma once

#include <string>
#include <vector>

#include "core/scenario/scenario.h"
#include "planner/problem/planner_config.h"
#include "predictor/app/predictor_config.h"
#include "simulator/app/simulator_config.h"

namespace tern {

/// Returns the reason why most requests would be answered STALE_WORLD, with both ages; "" if the world is fresh enough.
///
/// Without declared motions the newest input of a request is a frame, of the sensor whose frames are freshest. It is
/// latency_s old when it arrives. On average half a period of the sensor and half of the predictor pass until a request
/// uses it. Declared motions are always fresh.
std::string late_sensor(const SimulatorConfig& simulator, const PredictorConfig& predictor,
                        const PlannerConfig& planner);

/// Returns a warning for each limit of uav.limits that needs more thrust than `simulator.quadrotor` has. With
/// uav.dynamics that is thrust_max, otherwise the largest acceleration of the box ±a_max, with gravity.
std::vector<std::string> excess_thrust(const Limits& limits, const SimulatorConfig& simulator);

}  // namespace tern
