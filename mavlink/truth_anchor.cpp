#include "mavlink/truth_anchor.h"

#include <cmath>

#include "mavlink/autopilot.h"

namespace tern::mavlink {

void TruthAnchor::stand(const std::optional<UavState>& estimate, const std::optional<UavState>& truth) {
  if (estimate && truth) shift_ = estimate->motion.p - truth->motion.p;
}

bool TruthAnchor::see(const std::optional<UavState>& estimate, const std::optional<UavState>& truth) {
  if (shift_ || !truth || !estimate) return false;
  const double later = (truth->at - estimate->at).seconds();
  if (std::abs(later) > kStateAge.seconds()) return false;
  shift_ = estimate->motion.p + estimate->motion.v * later - truth->motion.p;
  return true;
}

std::optional<UavState> TruthAnchor::apply(std::optional<UavState> truth) const {
  if (!truth || !shift_) return std::nullopt;
  truth->motion.p += *shift_;
  return truth;
}

}  // namespace tern::mavlink
