// The tilt limit of a PX4 after take-off: for some seconds it follows no plan that tilts.
#pragma once

#include <optional>

#include "core/base/time.h"

namespace tern::mavlink {

/// Knows when a PX4 can tilt as far as its parameters allow. Through its take-off ramp (MPC_TKO_RAMP_T) the limit is
/// MPC_TILTMAX_LND. Then it rises by kRate to MPC_TILTMAX_AIR (MulticopterPositionControl). With PX4's defaults that is
/// 5.9 s after the vehicle has left the ground. The ramp begins before that, so this bound is never too early.
///
/// A vehicle that is in the air when first seen counts as past its ramp.
class TiltRamp {
 public:
  static constexpr double kRate = 11.4;  ///< degrees/s: a little less than PX4's 0.2 rad/s

  /// Adds what the autopilot reports. @param landed  nullopt: not reported yet  @param at  ascending
  void add(std::optional<bool> landed, UTime at);
  /// How long the tilt stays limited. Zero on the ground and after the ramp.
  /// @param ramp_s  MPC_TKO_RAMP_T, s  @param rise_deg  MPC_TILTMAX_AIR − MPC_TILTMAX_LND
  [[nodiscard]] Duration remaining(double ramp_s, double rise_deg, UTime now) const;

 private:
  bool was_landed_ = false;
  std::optional<UTime> lifted_;
};

}  // namespace tern::mavlink
