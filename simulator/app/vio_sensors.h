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

/// Publishes IMU, FEATURE_TRACKS and the POSITION_FIX of each seen tag, and passes every ODOMETRY to its navigation.
/// The camera sees the true world from the true pose. Until world zero the world is at rest.
class VioSensors {
 public:
  /// `world` and `navigation` must outlive this.
  VioSensors(Bus& bus, const World& world, const Scenario& scenario, const VioConfig& config, Navigation& navigation);
  /// Publishes the samples and exposures since the last call.
  void publish(std::optional<UTime> world_zero);

 private:
  void look(const StereoExposure& exposure, double world_s);
  [[nodiscard]] FeatureFrame tracked(const CameraFrame& camera, UTime at, const std::vector<Landmark>& landmarks);
  [[nodiscard]] bool is_dark(double world_s) const;

  Bus& bus_;
  const World& world_;
  StereoSpec camera_;
  TrackSpec tracks_;
  std::vector<DarkSpan> dark_;
  Navigation& navigation_;
  LandmarkField field_;
  TrackSimulator tracker_;
  TagSight tags_;
};

}  // namespace tern
