// Resets of an estimator that does not report them.
#pragma once

#include "core/base/time.h"
#include "core/base/types.h"

namespace tern {

/// Whether an estimator was reset between two positions: p₁ is more than 0.3 m from p₀ + v₀ Δt. After a gap of 0.3 s or
/// more this says nothing, and the answer is false.
/// @param later  Δt, > 0
inline bool estimate_jumps(const Vec3& p0, const Vec3& v0, const Vec3& p1, Duration later) {
  constexpr double kJump = 0.3, kGap = 0.3;  // m, s
  const double dt = later.seconds();
  return dt < kGap && (p1 - p0 - v0 * dt).norm() > kJump;
}

}  // namespace tern
