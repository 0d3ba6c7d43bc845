#include "mavlink/tilt_ramp.h"

#include <algorithm>

namespace tern::mavlink {

void TiltRamp::add(std::optional<bool> landed, UTime at) {
  if (!landed) return;
  if (*landed) lifted_.reset();
  if (!*landed && was_landed_) lifted_ = at;
  was_landed_ = *landed;
}

Duration TiltRamp::remaining(double ramp_s, double rise_deg, UTime now) const {
  if (!lifted_) return Duration{};
  constexpr double kLongest = 60.0;  // s, against a parameter that makes no sense
  const double limited_s = std::clamp(std::max(ramp_s, 0.0) + std::max(rise_deg, 0.0) / kRate, 0.0, kLongest);
  return std::max(*lifted_ + Duration::from_seconds(limited_s) - now, Duration{});
}

}  // namespace tern::mavlink
