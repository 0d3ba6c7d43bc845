// The velocity that flies a vehicle along its setpoints, as DimOS's drivers take it.
#pragma once

#include <cstdint>
#include <optional>

#include "core/world/vehicle.h"
#include "ros_messages/types.h"

namespace tern::dimos {

/// The direction of a positive `linear.y` of a Twist, as the driver takes it.
enum class Lateral : std::uint8_t {
  Left,   ///< as ROS defines
  Right,  ///< as DimOS's MAVLink drone has it
};

struct FollowingGains {
  double position_per_s = 1.0;  ///< m/s of velocity per m of error
  double yaw_per_s = 1.0;       ///< rad/s per rad
  double lead_s = 0.2;          ///< the vehicle's lag behind velocities, s
  double far_m = 1.0;           ///< a setpoint farther from the vehicle is not flown
  Lateral lateral = Lateral::Left;
};

/// Returns, in the axes of the body B (x forward, z up, level),
///
///     linear = R_BW · (v_s + lead · a_s + k_p · (p_s − p)),   angular.z = k_yaw · (ψ_s − ψ) in (−π, π]
///
/// where p is the vehicle's position moved on to the setpoint's time at its velocity, and a_s the setpoint's
/// acceleration.
/// @return nullopt if |p_s − p| > far_m
std::optional<ros::Twist> velocity_command(const UavState& setpoint, const UavState& vehicle,
                                           const FollowingGains& gains);

}  // namespace tern::dimos
