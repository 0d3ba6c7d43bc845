// VEHICLE_STATUS: whether the vehicle follows SETPOINT, and how it is.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "core/base/time.h"
#include "core/base/types.h"
#include "core/world/header.h"

namespace tern {

/// What the vehicle's state estimator says of itself.
enum class EstimatorHealth : std::uint8_t {
  Good = 0,
  Degraded = 1,  ///< UAV_STATE goes on, with the sigma that is said
  Lost = 2,      ///< UAV_STATE cannot be believed
};
inline constexpr int kEstimatorHealths = 3;

/// The mode of a vehicle that is where its setpoints say. Every other one that names its mode has errors of tracking.
inline constexpr std::string_view kPerfectMode = "perfect";

/// The vehicle as the one who flies it (simulator, autopilot bridge) knows it. The executor asks for plans only while
/// it is following.
struct VehicleStatus {
  Header header;
  UTime at;  ///< vehicle's clock
  bool armed = false;
  bool following = false;  ///< it is armed and flies SETPOINT; false: somebody else flies, or nobody
  bool landed = false;
  std::string mode;               ///< the autopilot's own word: "OFFBOARD", "POSCTL"; may be empty
  std::string why_not;            ///< why it does not follow, in words; empty exactly when it is following
  std::optional<double> battery;  ///< what is left, [0, 1]; nullopt: unknown
  EstimatorHealth estimator = EstimatorHealth::Good;
  /// Standard deviation of UAV_STATE's position per axis of W, m, ≥ 0. 0: none is known.
  Vec3 position_sigma = Vec3::Zero();
  /// How often UAV_STATE's position has jumped (the estimator reset itself), ≥ 0, since the vehicle's process started.
  std::int64_t resets = 0;
};

}  // namespace tern
