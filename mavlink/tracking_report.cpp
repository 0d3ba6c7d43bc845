#include "mavlink/tracking_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace tern::mavlink {
namespace {

/// A lag of this size is logged, s. With a good feed-forward it is 0.01 to 0.02 s.
constexpr double kLag = 0.1;

}  // namespace

void TrackingReport::add(const UavState& state, const MotionSample& commanded, const std::optional<LoopGains>& gains) {
  if (state.at <= at_) return;
  lag_.add(std::min((state.at - at_).seconds(), 0.1), commanded.p, commanded.v, state.motion.p);
  at_ = state.at;
  if (gains) identification_.add(state.at, state.motion.p, state.motion.v, *gains);
}

std::string TrackingReport::lag_line(double drag_per_s) const {
  const double lag_s = lag_.seconds().value_or(0.0);
  if (std::abs(lag_s) < kLag) return {};
  return fmt::format("the vehicle is {:.2f} s {} its setpoints: mavlink.drag_per_s is {:g}, too {} for its drag",
                     std::abs(lag_s), lag_s > 0 ? "behind" : "ahead of", drag_per_s, lag_s > 0 ? "small" : "large");
}

std::string TrackingReport::measured_line() const {
  const auto is = measured();
  if (!is) return {};
  return fmt::format(
      "measured in {:.0f} s of motion: drag {:.2f} ± {:.2f} 1/s, acceleration {:.2f} s late and {:.2f} of the "
      "commanded. For the next flight: --set mavlink.drag_per_s={:.2f} --set mavlink.lead_s={:.2f}",
      is->moved_s, is->drag_per_s, is->drag_sigma, is->lag_s, is->share, std::max(is->drag_per_s, 0.0), is->lag_s);
}

}  // namespace tern::mavlink
