// The message VEHICLE_STATUS: whether the vehicle follows its setpoints, and its condition.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "core/base/time.h"
#include "core/base/types.h"
#include "core/wire/header.h"

namespace tern {

/// The health that the vehicle's state estimator reports.
enum class EstimatorHealth : std::uint8_t {
  Good = 0,
  Degraded = 1,  ///< UAV_STATE continues, with the stated `position_sigma`
  Lost = 2,      ///< UAV_STATE is not reliable
};
inline constexpr int kEstimatorHealths = 3;

/// The mode of a vehicle without tracking error: it is always at its setpoint.
inline constexpr std::string_view kPerfectMode = "perfect";

/// VEHICLE_STATUS: the vehicle as the simulator or the autopilot bridge knows it. The executor requests plans only
/// while `following` is true.
struct VehicleStatus {
  Header header;
  UTime at;  ///< vehicle's clock
  bool armed = false;
  bool following = false;  ///< the vehicle is armed and tracks SETPOINT
  bool landed = false;
  std::string mode;               ///< the autopilot's own name of its mode: "OFFBOARD", "POSCTL"; may be empty
  std::string why_not;            ///< in words why the vehicle does not follow; empty exactly if it follows
  std::optional<double> battery;  ///< remaining charge, [0, 1]; nullopt: unknown
  EstimatorHealth estimator = EstimatorHealth::Good;
  /// Standard deviation of UAV_STATE's position per axis of W, m, ≥ 0; 0: unknown.
  Vec3 position_sigma = Vec3::Zero();
  /// Number of position jumps of UAV_STATE since the vehicle's process started (the estimator reset itself), ≥ 0.
  std::int64_t resets = 0;
};

}  // namespace tern
