// How a position fix corrects the filter.
#pragma once

#include <optional>

#include "core/base/time.h"
#include "core/world/inertial.h"
#include "estimator/filter/msckf.h"

namespace tern {

/// Residuals of a fix and their derivatives by all errors of the filter, whitened.
struct FixRows {
  Eigen::MatrixXd H;
  Eigen::VectorXd r;
};
/// nullopt if the fix is older than all poses.
/// @pre fix.at ≤ filter_at
std::optional<FixRows> fix_rows(const Msckf& filter, UTime filter_at, const PositionFix& fix);

enum class FixOutcome { Used, TooOld, Contradicts };

/// Corrects the filter by a fix at a time that its clones or its newest state span. Between two poses the path is the
/// cubic through both with their velocities, and the error is interpolated linearly.
///
///     z = p + n:   r = z − p̂ = [−[p̂]×  1] (θ, e_p) + n,      ψ = yaw of R_WB:   r = δψ(θ) + n
///
/// A fix outside of the 99.99 % of the filter's χ² is refused (RefusedFixes).
/// @param filter_at  the time of filter.nav()
/// @pre fix.at ≤ filter_at
FixOutcome use_fix(Msckf& filter, UTime filter_at, const PositionFix& fix);

/// How far a fix lies from the estimate.
struct FixOffset {
  Vec3 position = Vec3::Zero();  ///< W, m
  double yaw = 0.0;              ///< rad; 0 for a fix without yaw
};
/// nullopt if the fix is older than all poses.
/// @pre fix.at ≤ filter_at
std::optional<FixOffset> fix_offset(const Msckf& filter, UTime filter_at, const PositionFix& fix);

/// Counts refused fixes in a row that agree with each other: kBelievedFixes of them are right, and the estimate is
/// wrong. Two agree if their offsets differ by no more than their noise (3 σ) and the drift of the estimate between
/// them. So a source that repeats one fix while the vehicle moves is not believed.
class RefusedFixes {
 public:
  /// @return whether this fix and those before it are to be believed
  bool add(const PositionFix& fix, const FixOffset& offset);
  void clear() { count_ = 0; }

 private:
  int count_ = 0;
  PositionFix first_;
  FixOffset first_offset_;
};
inline constexpr int kBelievedFixes = 10;

/// Widens the filter by the offset of fixes that are believed: the whole path is turned about the vehicle and shifted.
/// use_fix() then takes them.
void widen_by(const FixOffset& offset, Msckf& filter);

}  // namespace tern
