// Makes the vehicle of a scenario.
#pragma once

#include <memory>

#include "core/scenario/scenario.h"
#include "simulator/app/simulator_config.h"
#include "simulator/vehicle/vehicle.h"

namespace tern {

/// Makes the vehicle, at rest at scenario.uav.start from `now` on. Its noise comes from the scenario's seed.
std::unique_ptr<Vehicle> make_vehicle(const Scenario& scenario, const SimulatorConfig& config, UTime now);

}  // namespace tern
