#include "executor/vehicle_inputs.h"

#include <fmt/format.h>

namespace tern {

void VehicleInputs::Input::add(UTime stated, UTime came) {
  at = at ? std::max(*at, stated) : stated;
  received = received ? std::max(*received, came) : came;
}

std::string VehicleInputs::Input::trouble(UTime now) const {
  if (!at) return "silent so far";
  if (now - *received > kMaxAge) return fmt::format("silent for {:.1f} s", (now - *received).seconds());
  return fmt::format("{:.1f} s old", (now - *at).seconds());
}

std::optional<std::pair<std::string, std::string>> VehicleInputs::trouble(UTime now) const {
  if (!state_.usable(now)) return std::pair<std::string, std::string>("UAV_STATE", state_.trouble(now));
  if (!status_.usable(now)) return std::pair<std::string, std::string>("VEHICLE_STATUS", status_.trouble(now));
  return std::nullopt;
}

}  // namespace tern
