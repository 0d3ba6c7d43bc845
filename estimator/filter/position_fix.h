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
/// A fix outside of the 99.99 % of the filter's χ² is refused.
/// @param filter_at  the time of filter.nav()
/// @pre fix.at ≤ filter_at
FixOutcome use_fix(Msckf& filter, UTime filter_at, const PositionFix& fix);

}  // namespace tern
