// Parameters of an autopilot that decide what happens when something is lost and what can be flown, and what Tern asks
// of them.
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
  double low, high;    ///< allowed, both included; high may be infinite
  double recommended;  ///< what docs/autopilot.md says
  bool integer;        ///< by its type in PX4, where an integer travels bytewise
  const char* why;     ///< "the aircraft flies home at another height when setpoints cease"
  int bits = 0;        ///< which have to be set among those of an integer
  /// Not every version of the firmware has it, or by that name: where it is absent nothing is wrong.
  bool may_be_absent = false;
  const char* also_called = nullptr;  ///< its name in other versions: one of both is enough

  [[nodiscard]] bool allows(double value) const;
};

/// The table of docs/autopilot.md: what happens when something is lost, and bounds of the autopilot's own that must not
/// be narrower than what is planned for `uav`. Empty for firmware of which nothing is known.
/// @param system  the autopilot's system id, by which the bridge speaks
/// @param without_remote  nobody holds a remote control, and no ground station is there
/// @param external_vision  the estimator lives by the ODOMETRY that it is told
std::vector<RequiredParameter> required_parameters(Firmware firmware, const UavSpec& uav, std::uint8_t system,
                                                   bool without_remote, bool external_vision);

/// What is wrong, in words with name, value, limit and reason: "COM_OBL_RC_ACT is 0, not within [4, 5]: …". Those that
/// were not read are named. Empty: nothing is wrong.
/// @param all_asked  all were asked for so often that who has not answered is absent
std::string parameter_faults(const std::vector<RequiredParameter>& required,
                             const std::map<std::string, double>& values, bool all_asked);

}  // namespace tern::mavlink
