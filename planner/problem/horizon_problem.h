// The problem of one duration (paper §2), shared by search, optimizer and checker.
#pragma once

#include "core/splines/hull_basis.h"
#include "core/world/vehicle.h"

namespace tern {

/// From the start to rest in J intervals of Δt, within the limits, within the sphere S and within the flight box.
struct HorizonProblem {
  MotionSample start;
  int intervals = 6;                        ///< J
  Duration interval{200'000};               ///< Δt
  Limits limits;                            ///< the vehicle's limits, which the checker certifies
  Limits plan_limits;                       ///< the same with v_max reduced to velocity_share, for search and optimizer
  double sphere_radius = 4.0;               ///< radius of S, which is centred at the start, m
  Box centre_box;                           ///< allowed positions of the centre: the flight box shrunk by the body, W
  double clearance = 0.0;                   ///< radius of a spherical body, m
  HullBasis hull_basis = HullBasis::Minvo;  ///< its hull points represent the curve in search and optimizer

  [[nodiscard]] double interval_s() const { return interval.seconds(); }
};

}  // namespace tern
