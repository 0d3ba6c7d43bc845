// Parameters of an autopilot that decide what happens when something is lost, and what Tern asks of them.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "mavlink/autopilot.h"

namespace tern::mavlink {

struct RequiredParameter {
  const char* name;
  double low, high;    ///< allowed, both included
  double recommended;  ///< what docs/autopilot.md says
  bool integer;        ///< by its type in PX4, where an integer travels bytewise
  const char* why;     ///< "the aircraft flies home at another height when setpoints cease"
};

/// The table of docs/autopilot.md. Empty for firmware of which nothing is known.
std::vector<RequiredParameter> required_parameters(Firmware firmware);

/// What is wrong, in words with name, value, limit and reason: "COM_OBL_RC_ACT is 0, not within [4, 5]: …". Those that
/// were not read are named. Empty: nothing is wrong.
std::string parameter_faults(const std::vector<RequiredParameter>& required,
                             const std::map<std::string, double>& values);

}  // namespace tern::mavlink
