#include "executor/estimate_resets.h"

#include <utility>

namespace tern {

namespace {

/// Returns how far a state is from where an earlier one leads, W, m; nullopt if too much time lies between them.
std::optional<Vec3> apart(const UavState& from, const UavState& to) {
  if (to.at <= from.at || to.at - from.at > EstimateResets::kMaxStateGap) return std::nullopt;
  const double dt = (to.at - from.at).seconds();
  return to.motion.p - from.motion.p - 0.5 * dt * (from.motion.v + to.motion.v);
}

bool is_jump(const Vec3& by) { return by.cwiseAbs().maxCoeff() >= EstimateResets::kMinJump; }

}  // namespace

std::optional<Vec3> EstimateResets::add(const UavState& state, UTime at) {
  const std::optional<UavState> before = std::exchange(before_, state);
  const std::optional<Jump> jump = std::exchange(newest_jump_, std::nullopt);
  const bool was_steady = std::exchange(is_steady_, true);
  if (jump) {
    const std::optional<Vec3> since = apart(jump->from, state);
    if (since && !is_jump(*since)) return std::nullopt;  // the state in between was an outlier
    unmatched_jump_ = jump;
  }
  const std::optional<Vec3> by = before ? apart(*before, state) : std::nullopt;
  is_steady_ = by && !is_jump(*by);
  if (by && was_steady && !is_steady_) newest_jump_ = {at, *by, *before};
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
