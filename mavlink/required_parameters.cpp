#include "mavlink/required_parameters.h"

#include <fmt/format.h>

namespace tern::mavlink {

std::vector<RequiredParameter> required_parameters(Firmware firmware) {
  switch (firmware) {
    case Firmware::Px4:
      return {{"COM_OBL_RC_ACT", 4, 5, 4, true, "without setpoints it would return and climb; 4 lands, 5 holds"},
              {"COM_OF_LOSS_T", 0.2, 1.0, 0.5, false, "so long it flies on blindly when setpoints cease, s"}};
    case Firmware::ArduPilot:
      return {{"GUID_TIMEOUT", 0.2, 1.0, 0.5, false, "so long it flies on blindly when setpoints cease, s"},
              {"FS_GCS_ENABLE", 5, 5, 5, false, "without this link it would fly on or fly home; 5 lands"}};
    case Firmware::Other: return {};
  }
  return {};
}

std::string parameter_faults(const std::vector<RequiredParameter>& required,
                             const std::map<std::string, double>& values) {
  std::string faults;
  for (const RequiredParameter& r : required) {
    const auto found = values.find(r.name);
    std::string fault;
    if (found == values.end()) {
      fault = fmt::format("{} was not read", r.name);
    } else if (!(found->second >= r.low && found->second <= r.high)) {
      fault = fmt::format("{} is {:g}, not within [{:g}, {:g}]: {}", r.name, found->second, r.low, r.high, r.why);
    }
    if (!fault.empty()) faults += (faults.empty() ? "" : "; ") + fault;
  }
  return faults;
}

}  // namespace tern::mavlink
