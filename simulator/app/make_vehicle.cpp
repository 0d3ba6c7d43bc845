#include "simulator/app/make_vehicle.h"

#include "simulator/vehicle/external_vehicle.h"
#include "simulator/vehicle/perfect_vehicle.h"
#include "simulator/vehicle/quadrotor_vehicle.h"

namespace tern {

std::unique_ptr<Vehicle> make_vehicle(const Scenario& scenario, const SimulatorConfig& config, UTime now) {
  if (config.external) return std::make_unique<ExternalVehicle>(scenario.uav, now);
  if (!config.quadrotor) return std::make_unique<PerfectVehicle>(scenario.uav, now);
  std::optional<NavigationSetup> navigation;
  if (config.vio) navigation = config.vio->navigation;
  return std::make_unique<QuadrotorVehicle>(scenario.uav, *config.quadrotor, scenario.seed, now, navigation);
}

}  // namespace tern
