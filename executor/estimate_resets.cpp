#include "executor/estimate_resets.h"

#include <utility>

namespace tern {

std::optional<Vec3> EstimateResets::add(const UavState& state, UTime at) {
  const std::optional<UavState> before = std::exchange(before_, state);
  const std::optional<Jump> jump = std::exchange(newest_jump_, std::nullopt);
  const bool is_next = before && state.at > before->at && state.at - before->at <= kMaxStateGap;
  Vec3 by = Vec3::Zero();
  if (is_next) {
    const double dt = (state.at - before->at).seconds();
    by = state.motion.p - before->motion.p - 0.5 * dt * (before->motion.v + state.motion.v);
  }
  if (jump && (jump->by + by).cwiseAbs().maxCoeff() < kMinJump) return std::nullopt;  // it was an outlier
  if (jump) unmatched_jump_ = jump;
  if (by.cwiseAbs().maxCoeff() >= kMinJump) newest_jump_ = {at, by};
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
