#include "executor/estimate_resets.h"

#include <utility>

namespace tern {

std::optional<Vec3> EstimateResets::add(const UavState& state, UTime at) {
  const std::optional<UavState> before = std::exchange(before_, state);
  if (!before || state.at <= before->at || state.at - before->at > kMaxStateGap) return std::nullopt;
  const double dt = (state.at - before->at).seconds();
  const Vec3 by = state.motion.p - before->motion.p - 0.5 * dt * (before->motion.v + state.motion.v);
  if (by.cwiseAbs().maxCoeff() < kMinJump) return std::nullopt;
  unmatched_jump_ = {at, by};
  return match();
}

std::optional<Vec3> EstimateResets::add(std::int64_t resets, UTime at) {
  const std::optional<std::int64_t> before = std::exchange(resets_, resets);
  if (!before || resets <= *before) return std::nullopt;
  unmatched_reset_ = at;
  return match();
}

std::optional<Vec3> EstimateResets::match() {
  if (!unmatched_jump_ || !unmatched_reset_) return std::nullopt;
  const Duration apart = unmatched_jump_->at < *unmatched_reset_ ? *unmatched_reset_ - unmatched_jump_->at
                                                                 : unmatched_jump_->at - *unmatched_reset_;
  if (apart > kMatchWindow) return std::nullopt;
  unmatched_reset_.reset();
  return std::exchange(unmatched_jump_, std::nullopt)->by;
}

}  // namespace tern
