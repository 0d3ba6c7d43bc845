// Autopilot parameters that decide what happens after a loss of messages and what can be flown, and the values that
// Tern requires.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "core/world/scenario.h"
#include "mavlink/autopilot.h"

namespace tern::mavlink {

struct RequiredParameter {
  const char* name;
  double low, high;    ///< allowed range, both included; high may be infinite
  double recommended;  ///< the value of docs/reference/autopilot.md
  bool integer;        ///< an integer in PX4, where it is sent bytewise in a float
  const char* why;     ///< reason, as in "the aircraft flies home at another height when setpoints cease"
  int bits = 0;        ///< bits of an integer that must be set
  /// Not every firmware version has it under this name: its absence is no fault.
  bool may_be_absent = false;
  const char* also_called = nullptr;  ///< its name in other versions: one of the two is enough

  [[nodiscard]] bool allows(double value) const;
};

/// Returns the table of docs/reference/autopilot.md: the behaviour after a loss, and lower bounds for the autopilot's
/// own limits, from what is planned for `uav`. Empty for an unknown firmware.
/// @param system  the autopilot's system id, which the bridge uses as well
/// @param without_remote  there is neither a remote control nor a ground station
/// @param external_vision  the estimator uses the ODOMETRY that the bridge sends
std::vector<RequiredParameter> required_parameters(Firmware firmware, const UavSpec& uav, std::uint8_t system,
                                                   bool without_remote, bool external_vision);

/// Returns the faults with name, value, limit and reason: "COM_OBL_RC_ACT is 0, not within [4, 5]: …". Parameters that
/// were not read are named. Empty: there is no fault.
/// @param all_asked  all were requested often enough that a missing one is absent
std::string parameter_faults(const std::vector<RequiredParameter>& required,
                             const std::map<std::string, double>& values, bool all_asked);

}  // namespace tern::mavlink
