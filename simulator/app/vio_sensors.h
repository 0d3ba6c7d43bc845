// The inputs of tern-estimator from the simulated vehicle, and its answer.
#pragma once

#include <optional>
#include <vector>

#include "core/scenario/scenario.h"
#include "core/world/inertial.h"
#include "runtime/bus.h"
#include "simulator/app/simulator_config.h"
#include "simulator/inertial/navigation.h"
#include "simulator/inertial/track_simulator.h"
#include "simulator/worlds/world.h"

namespace tern {

/// Publishes IMU and FEATURE_TRACKS of a vehicle, and passes every ODOMETRY to its navigation. The camera sees the true
/// world from the true pose. Until world zero the world is at rest.
class VioSensors {
 public:
  /// `world` and `navigation` must outlive this.
  VioSensors(Bus& bus, const World& world, const Scenario& scenario, const VioConfig& config, Navigation& navigation);
  /// Publishes the samples and exposures since the last call.
  void publish(std::optional<UTime> world_zero);

 private:
  [[nodiscard]] FeatureFrame look(const StereoExposure& exposure, double world_s);

  Bus& bus_;
  const World& world_;
  StereoSpec camera_;
  TrackSpec tracks_;
  Navigation& navigation_;
  LandmarkField field_;
  TrackSimulator tracker_;
};

}  // namespace tern
