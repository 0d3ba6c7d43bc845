// The problem of one duration, as search, optimizer and checker share it (paper §2): what a trajectory must keep to.
#pragma once

#include "core/splines/hull_basis.h"
#include "core/world/vehicle.h"

namespace tern {

/// From the start to rest in J intervals of Δt, within the limits, within S and the flight box.
struct HorizonProblem {
  MotionSample start;
  int intervals = 6;                        ///< J
  Duration interval{200'000};               ///< Δt
  Limits limits;                            ///< the vehicle's: what is certified
  Limits plan_limits;                       ///< v_max reduced to the share that plans may use
  double sphere_radius = 4.0;               ///< S is centred at the start, m
  Box centre_box;                           ///< where the vehicle's centre may be: the flight box shrunk by the body, W
  double clearance = 0.0;                   ///< radius of a spherical body, m
  HullBasis hull_basis = HullBasis::Minvo;  ///< whose hulls stand for the curve in search and optimizer

  [[nodiscard]] double interval_s() const { return interval.seconds(); }
};

}  // namespace tern
