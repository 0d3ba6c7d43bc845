#include "executor/estimate_resets.h"

#include <utility>

namespace tern {

std::optional<Vec3> EstimateResets::add(const UavState& state, UTime at) {
  const std::optional<UavState> before = std::exchange(before_, state);
  if (!before || state.at <= before->at || state.at - before->at > kSuccessive) return std::nullopt;
  const double dt = (state.at - before->at).seconds();
  const Vec3 by = state.motion.p - before->motion.p - 0.5 * dt * (before->motion.v + state.motion.v);
  if (by.cwiseAbs().maxCoeff() < kLeast) return std::nullopt;
  jump_ = {at, by};
  return together();
}

std::optional<Vec3> EstimateResets::add(std::int64_t resets, UTime at) {
  const std::optional<std::int64_t> before = std::exchange(resets_, resets);
  if (!before || resets <= *before) return std::nullopt;
  told_ = at;
  return together();
}

std::optional<Vec3> EstimateResets::together() {
  if (!jump_ || !told_) return std::nullopt;
  const Duration apart = jump_->at < *told_ ? *told_ - jump_->at : jump_->at - *told_;
  if (apart > kTogether) return std::nullopt;
  told_.reset();
  return std::exchange(jump_, std::nullopt)->by;
}

}  // namespace tern
