// Why a vehicle cannot be flown now, in words for the log and for VEHICLE_STATUS. Every function returns "" if nothing
// is wrong.
#pragma once

#include <optional>
#include <string>

#include "core/scenario/scenario.h"
#include "mavlink/autopilot.h"
#include "mavlink/bridge_config.h"
#include "mavlink/tilt_ramp.h"

namespace tern::mavlink {

/// No messages of the autopilot.
std::string link_fault(const Autopilot& autopilot, UTime now);
/// The autopilot's clock runs at another rate, as in a simulation that is too slow.
std::string clock_fault(const Autopilot& autopilot);
/// The tilt is still limited after a take-off.
std::string tilt_fault(const Autopilot& autopilot, const TiltRamp& ramp, UTime now);
/// The vehicle cannot take off from its place. @param here  its position, W, m
std::string ground_fault(const Vec3& here, const Autopilot& autopilot, const UavSpec& uav, const BridgeConfig& config);
/// The setpoint or the vehicle (positions in W, m) is more than `beyond_m` outside the flight box of the centre.
std::string bound_fault(const Vec3& setpoint, const std::optional<Vec3>& vehicle, const UavSpec& uav, double beyond_m);

/// The autopilot's own reason for a mode that is not the bridge's. @param without_remote  there is no pilot
std::string failsafe_reason(const Autopilot& autopilot, bool without_remote);
/// Why the vehicle has left the following mode, or is in another one before it. Never "".
std::string mode_change_reason(const Autopilot& autopilot, bool without_remote);
std::string other_pilot_reason(const Autopilot& autopilot, bool without_remote);

/// Since when an armed vehicle has not followed.
class FollowRecord {
 public:
  /// @param why  why it does not follow, or ""  @return a line for the log, or ""
  std::string step(bool armed, const std::string& why, UTime now);
  /// Returns " (for 3 s)" if the vehicle has not followed for 1 s or more.
  [[nodiscard]] std::string for_how_long(UTime now) const;

 private:
  bool has_followed_ = false;       ///< since the vehicle was armed
  std::optional<UTime> not_since_;  ///< if has_followed_
};

}  // namespace tern::mavlink
